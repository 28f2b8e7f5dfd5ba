// SPDX-License-Identifier: Apache-2.0
#include "steps/sdo_step.hpp"

#include <algorithm>
#include <utility>

#include "base/random.hpp"
#include "base/text.hpp"
#include "device/standard_objects.hpp"
#include "steps/sdo_access.hpp"

namespace conform::steps {
namespace {

using Mode = canopen::SdoDownload::Mode;

constexpr std::size_t longest_pattern = std::size_t{1} << 20U;

/// What a word of `transfer` asks for.
struct Transfer {
  std::string_view word;
  Mode mode = Mode::automatic;
  bool block = false, size_told = true;
};
constexpr Transfer transfers[] = {
    {"automatic"},
    {"expedited", Mode::expedited},
    {"expedited without size", Mode::expedited_unsized},
    {"segmented", Mode::segmented},
    {"segmented without size", Mode::segmented_unsized},
    {"block", Mode::automatic, true},
    {"block without size", Mode::automatic, true, false},
};

const Transfer& transfer_of(std::string_view word) {
  const auto found = std::ranges::find(transfers, word, &Transfer::word);
  return found == std::end(transfers) ? transfers[0] : *found;
}

std::string read_word(const yaml::Field& field, bool upload) {
  std::vector<std::string_view> words;
  for (const auto& each : transfers) {
    if (!upload || each.word == "automatic" || each.word == "block") words.push_back(each.word);
  }
  return field.one_of(words).value_or("");
}

/// A $name, brackets included that YAML's own reader leaves alone.
bool is_name(std::string_view word) { return word.size() > 1 && word.front() == '$'; }

/// For reports: a measurement that an expectation missed is in it.
std::string counts_in_words(const SdoAnswer& answer) {
  const auto& counts = answer.counts;
  std::string out =
      std::to_string(counts.segments) + " segments in " + std::to_string(counts.sub_blocks) + " sub-blocks";
  const auto add = [&out](const auto& number, const char* words) {
    if (number > 0) out += ", " + std::to_string(number) + words;
  };
  if (counts.switched)
    out = "switched to the normal upload, " + std::to_string(counts.segments) + " segments";
  add(counts.retransmitted, " retransmitted");
  add(counts.acks, " acknowledges");
  if (counts.first_ackseq) out += " from ackseq " + std::to_string(*counts.first_ackseq) + " on";
  if (counts.crc_agreed) out += *counts.crc_agreed ? ", CRC agreed" : ", no CRC agreed";
  if (counts.unused) out += ", " + std::to_string(*counts.unused) + " unused bytes";
  add(counts.timeouts, " time-outs");
  add(counts.surplus, " frames after the end");
  return out;
}

}  // namespace

Bytes pattern_bytes(std::size_t size, bool visible) {
  Bytes out(size);
  std::uint64_t state = 0x301;
  for (auto& byte : out) {
    const auto random = next_random(state) >> 32U;
    byte = static_cast<std::uint8_t>(visible ? 0x20U + random % 0x5FU : random & 0xFFU);
  }
  return out;
}

Actual to_actual(const SdoAnswer& answer, const Session& session, Multiplexer object, bool upload) {
  using Kind = SdoAnswer::Kind;
  auto out = outcome_of(answer);
  out.type = device::type_of(session.dictionary(), object);
  out.has_data = upload && answer.kind == Kind::confirmed;
  if (answer.kind == Kind::gave_up) {
    // On purpose: the fault that was asked for.
    out.kind = Actual::Kind::matched;
    out.detail = "the client aborted, and " + std::to_string(answer.counts.surplus) + " more frame" +
                 (answer.counts.surplus == 1 ? "" : "s") + " came";
  }
  const auto& counts = answer.counts;
  if (counts.block && answer.kind == SdoAnswer::Kind::confirmed) out.detail = counts_in_words(answer);
  const auto put = [&out](const char* name, const auto& value) {
    if (value) out.measured[name] = *value;
  };
  out.measured["segments"] = counts.segments;
  put("announced", answer.announced);
  if (upload && answer.kind == SdoAnswer::Kind::confirmed)
    out.measured["size_open"] = answer.size_indicated ? 0 : 1;
  if (!counts.block) return out;
  out.measured["sub_blocks"] = counts.sub_blocks;
  out.measured["retransmitted"] = counts.retransmitted;
  put("crc_agreed", counts.crc_agreed);
  if (upload) {
    out.measured["switched"] = counts.switched ? 1 : 0;
    out.measured["wrong_numbers"] = counts.wrong_numbers;
    out.measured["timeouts"] = counts.timeouts;
    put("crc_ok", counts.crc_ok);
    put("crc", counts.crc);
    put("unused", counts.unused);
    if (counts.timeouts > 0) {
      out.tolerated.push_back("the server stopped within a sub-block until it was acknowledged, " +
                              std::to_string(counts.timeouts) + " times");
    }
  } else {
    out.measured["acks"] = counts.acks;
    put("first_ackseq", counts.first_ackseq);
    put("blksize", counts.blksize);
  }
  return out;
}

Measures measures_of(bool upload, bool block) {
  Measures out{"segments"};
  if (upload) out.insert(out.end(), {"announced", "size_open"});
  if (!block) return out;
  out.insert(out.end(), {"sub_blocks", "retransmitted", "crc_agreed"});
  if (upload) {
    out.insert(out.end(), {"switched", "wrong_numbers", "timeouts", "crc_ok", "crc", "unused"});
  } else {
    out.insert(out.end(), {"acks", "first_ackseq", "blksize"});
  }
  return out;
}

std::optional<FaultPhrase> FaultPhrase::parse(const yaml::Field& field, const NameCheck& names) {
  const auto text = field.text();
  if (!text) return std::nullopt;
  std::vector<std::string> used, words;
  for (const auto word : split(*text, ' ')) {
    if (is_name(word)) used.emplace_back(word.substr(1));
    // Any number will do to see whether the phrase is one; 2 has a place in all of them.
    words.emplace_back(is_name(word) ? "2" : word);
  }
  report_unknown_names(used, field, names);
  FaultPhrase out;
  out.text_ = *text;
  if (used.size() == 1 && words.size() == 1) return out;
  auto trial = join(words, " ");
  // "swap segments 2 and 2": the second number is known when the scenario runs.
  if (!used.empty() && trial.ends_with("and 2")) trial.replace(trial.size() - 1, 1, "999999");
  if (auto parsed = canopen::SdoFault::parse(trial); !parsed) {
    field.error(used.empty() ? parsed.error().what : "'" + *text + "': " + parsed.error().what,
                parsed.error().hint);
    return std::nullopt;
  }
  return out;
}

Result<canopen::SdoFault> FaultPhrase::resolve(Scope& scope) const {
  std::vector<std::string> words;
  for (const auto word : split(text_, ' ')) {
    if (!is_name(word)) {
      words.emplace_back(word);
      continue;
    }
    const auto* value = scope.find(word.substr(1));
    if (value == nullptr) return fail_scenario("'" + std::string(word) + "' has no value");
    if (value->word) {
      words.push_back(*value->word);
    } else if (value->number) {
      words.push_back(std::to_string(*value->number));
    } else {
      return fail_scenario("'" + std::string(word) + "' is no number");
    }
  }
  auto out = canopen::SdoFault::parse(join(words, " "));
  if (!out) return fail_scenario(out.error().what, out.error().hint);
  return out;
}

void SdoStep::parse_common(yaml::Fields& fields, ParseContext& context) {
  if (const auto object = fields.required("object")) {
    if (auto parsed = parse_object_at(object, context.names)) object_ = *parsed;
  }
  if (const auto timeout = fields.optional("timeout")) timeout_ = parse_time_at(timeout);
  if (const auto crc = fields.optional("crc")) crc_ = crc.boolean().value_or(true);
  if (const auto transfer = fields.optional("transfer")) transfer_ = read_word(transfer, upload_);
  const auto channel = fields.optional("channel");
  if (channel) {
    auto ids = channel.fields("channel");
    Channel out;
    const auto request = ids.required("request");
    const auto response = ids.required("response");
    if (request) out.request = parse_expression_at(request, context.names).value_or(Expression());
    if (response) out.response = parse_expression_at(response, context.names).value_or(Expression());
    channel_ = out;
  }
  const auto fault = fields.optional("fault");
  if (fault) {
    for (const auto& item : fault.items_or_one()) {
      if (auto phrase = FaultPhrase::parse(item, context.names)) faults_.push_back(*phrase);
    }
  }
  if (const auto wait = fields.optional("wait")) {
    wait_ = parse_time_at(wait);
    if (!fault) wait.error("'wait' is the time to listen after a fault", "add fault:, or write timeout:");
  }
  if (const auto save = fields.optional("save")) {
    save_ = save.text().value_or("");
    context.know(save_);
  }
}

std::optional<SdoStep> SdoStep::parse_upload(const yaml::Field& value, ParseContext& context) {
  SdoStep out;
  if (!value.node()->is_mapping()) {
    auto object = parse_object_at(value, context.names);
    if (!object) return std::nullopt;
    out.object_ = *object;
    return out;
  }
  auto fields = value.fields("upload");
  out.parse_common(fields, context);
  const bool block = transfer_of(out.transfer_).block;
  const auto of_block = [&](std::string_view key, Expression& target) {
    const auto field = fields.optional(key);
    if (!field) return;
    if (!block) field.error("'" + std::string(key) + "' belongs to a block transfer", "add transfer: block");
    target = parse_expression_at(field, context.names).value_or(Expression());
  };
  of_block("blksize", out.blksize_);
  of_block("pst", out.pst_);
  return fields.has("object") ? std::optional(std::move(out)) : std::nullopt;
}

void SdoStep::parse_content(yaml::Fields& fields, ParseContext& context) {
  const auto content = fields.exactly_one_of({"value", "bytes", "text", "pattern"});
  if (!content) return;
  if (fields.has("value")) {
    value_ = parse_expression_at(content, context.names).value_or(Expression());
  } else if (fields.has("bytes")) {
    bytes_ = content.bytes();
  } else if (const auto text = content.text(); text && fields.has("text")) {
    bytes_ = Bytes(text->begin(), text->end());
  } else if (text) {
    auto size = trim(*text);
    for (const std::string_view unit : {" bytes", " byte"}) {
      if (!size.ends_with(unit)) continue;
      size = trim(size.substr(0, size.size() - unit.size()));
      auto parsed = Expression::parse(size);
      if (!parsed) {
        content.error(parsed.error().what, parsed.error().hint);
      } else {
        report_unknown_names(parsed->names(), content, context.names);
        pattern_ = *parsed;
      }
      return;
    }
    content.error("'" + *text + "' is no length", "write pattern: 100 bytes");
  }
}

std::optional<SdoStep> SdoStep::parse_download(const yaml::Field& value, ParseContext& context) {
  SdoStep out;
  out.upload_ = false;
  auto fields = value.fields("download");
  out.parse_content(fields, context);
  out.parse_common(fields, context);
  if (const auto size = fields.optional("size"))
    out.size_ = parse_expression_at(size, context.names).value_or(Expression());
  if (const auto as = fields.optional("as")) {
    if (const auto name = as.text()) {
      out.as_ = canopen::parse_data_type(*name);
      if (!out.as_)
        as.error("unknown data type '" + *name + "'", "UNSIGNED8, INTEGER32, VISIBLE_STRING, ...");
    }
  }
  const bool content = out.bytes_ || !out.value_.empty() || !out.pattern_.empty();
  return fields.has("object") && content ? std::optional(std::move(out)) : std::nullopt;
}

std::optional<canopen::DataType> SdoStep::type_of(const Session& session, Multiplexer object) const {
  if (as_) return as_;
  return device::type_of(session.dictionary(), object);
}

Result<Bytes> SdoStep::encode(Session& session, Multiplexer object) const {
  if (bytes_) return *bytes_;
  const auto type = type_of(session, object);
  if (!pattern_.empty()) {
    const auto size = pattern_.number(session);
    if (!size) return std::unexpected(size.error());
    if (*size > longest_pattern) return fail_scenario("a pattern of more than 1 MiB");
    return pattern_bytes(static_cast<std::size_t>(*size), type == canopen::DataType::visible_string);
  }
  auto value = value_.evaluate(session);
  if (!value) return std::unexpected(value.error());
  if (value->bytes && !as_) return *value->bytes;
  if (value->word) return Bytes(value->word->begin(), value->word->end());
  if (!value->number) return fail("'" + value_.text() + "' is not a number");
  if (!type) {
    return fail_scenario("the type of " + to_string(object) + " is not known",
                         "add as: UNSIGNED16, or write bytes:");
  }
  const auto size = canopen::size_bytes(*type);
  if (!size) return fail_scenario(to_string(object) + " has no fixed length", "write bytes: or text:");
  // Values outside the type are the author's slip; '~' makes the only legal exception (sign extension).
  const auto mask = *size >= 8 ? ~std::uint64_t{0} : (std::uint64_t{1} << (8 * *size)) - 1;
  const auto above = *value->number & ~mask;
  if (above != 0 && above != ~mask) {
    return fail_scenario(value->text() + " does not fit " + std::string(canopen::to_string(*type)));
  }
  return to_le(*value->number, *size);
}

Need SdoStep::need() const {
  if (channel_) return {Tier::motion, "use other SDO channels than the default one"};
  const bool shortens = std::ranges::any_of(faults_, [](const auto& fault) {
    return fault.text().starts_with("short") || fault.text().starts_with('$');
  });
  if (upload_) return shortens ? Need{Tier::config, "send broken SDO requests"} : Need{};
  const auto object = object_.literal();
  return object ? need_of_download(*object) : Need{Tier::config, "write to the device"};
}

std::string SdoStep::words(Session& session) const {
  const auto object = object_.resolve(session);
  std::string out = (upload_ ? "upload " : "download ") + (object ? to_string(*object) : object_.text());
  if (!upload_) {
    out += " = ";
    const auto data = object ? encode(session, *object) : fail("");
    if (!pattern_.empty()) {
      const auto size = pattern_.number(session);
      out += "pattern of " + (size ? std::to_string(*size) : pattern_.text()) + " bytes";
    } else if (bytes_ && bytes_->empty()) {
      out += "(no bytes)";
    } else if (!data) {
      out += value_.text();
    } else if (const auto type = bytes_ ? std::nullopt : type_of(session, *object)) {
      out += canopen::print(*type, *data);
    } else {
      out += hex_bytes(*data);
    }
  }
  if (transfer_.starts_with("block")) out += " by " + transfer_;
  if (channel_) {
    const auto request = channel_->request.number(session);
    out += " on " +
           (request ? to_string(CanId(static_cast<std::uint32_t>(*request))) : channel_->request.text());
  }
  for (const auto& fault : faults_) {
    const auto resolved = fault.resolve(session);
    out += ", " + (resolved ? resolved->text : fault.text());
  }
  return out;
}

Result<SdoJob> SdoStep::job(Session& session) const {
  const auto object = object_.resolve(session);
  if (!object) return std::unexpected(object.error());
  SdoJob out;
  auto& request = out.request;
  const auto& transfer = transfer_of(transfer_);
  request.upload = upload_;
  request.object = *object;
  request.block = transfer.block;
  request.mode = transfer.mode;
  request.size_told = transfer.size_told;
  request.crc = crc_;
  if (!upload_) {
    auto data = encode(session, *object);
    if (!data) return std::unexpected(data.error());
    request.data = std::move(*data);
  }
  const auto number = [&session](const Expression& expression, std::uint64_t most,
                                 std::string_view what) -> Result<std::uint64_t> {
    auto value = expression.number(session);
    if (value && *value > most)
      return fail_scenario(std::string(what) + " " + std::to_string(*value) + " is above " +
                           std::to_string(most));
    return value;
  };
  if (!size_.empty()) {
    const auto size = number(size_, 0xFFFF'FFFF, "size");
    if (!size) return std::unexpected(size.error());
    request.announced = static_cast<std::uint32_t>(*size);
  }
  for (const auto& [expression, target, what] :
       {std::tuple(&blksize_, &request.blksize, "blksize"), std::tuple(&pst_, &request.pst, "pst")}) {
    if (expression->empty()) continue;
    const auto value = number(*expression, 255, what);
    if (!value) return std::unexpected(value.error());
    *target = static_cast<std::uint8_t>(*value);
  }
  for (const auto& phrase : faults_) {
    auto fault = phrase.resolve(session);
    if (!fault) return std::unexpected(fault.error());
    request.faults.push_back(std::move(*fault));
  }
  if (channel_) {
    const auto to = number(channel_->request, 0x7FF, "the CAN-ID");
    const auto from = number(channel_->response, 0x7FF, "the CAN-ID");
    if (!to) return std::unexpected(to.error());
    if (!from) return std::unexpected(from.error());
    out.channel =
        SdoChannelIds{CanId(static_cast<std::uint32_t>(*to)), CanId(static_cast<std::uint32_t>(*from))};
  }
  if (timeout_) out.timeout = timeout_->resolve(session.profile());
  if (wait_) out.wait = wait_->resolve(session.profile());
  return out;
}

Channels SdoStep::rests_on() const {
  Channels out;
  if (object_.text() == "1000h:00") out.push_back(channel::device_type);
  if (transfer_of(transfer_).block) {
    out.push_back(upload_ ? channel::block_upload : channel::block_download);
  } else if (!upload_ && (transfer_.starts_with("segmented") || !pattern_.empty())) {
    out.push_back(channel::segmented_download);
  }
  return out;
}

Measures SdoStep::measures() const {
  auto out = measures_of(upload_, transfer_of(transfer_).block);
  if (upload_) out.emplace_back("latency");
  if (!faults_.empty()) out.insert(out.end(), {"surplus", "answers"});
  return out;
}

Actual SdoStep::conclude(Session& session, const SdoJob& job, const SdoAnswer& answer) const {
  const auto object = job.request.object;
  auto out = to_actual(answer, session, object, upload_);
  const bool confirmed = out.kind == Actual::Kind::confirmed;
  // Without a fault nobody has listened: to say 0 would be to say that nothing came.
  if (!faults_.empty()) {
    out.measured["surplus"] = answer.counts.surplus;
    out.measured["answers"] = answer.counts.answers;
  }
  if (upload_) {
    out.unchanged_from = session.before_last_write(object);
  } else if (confirmed) {
    out.detail = "confirmed" + (out.detail.empty() ? "" : ", " + out.detail);
  }
  if (confirmed && upload_) {
    const auto latency = session.capture().frames()[answer.decisive].time - session.window().anchor;
    out.measured["latency"] = static_cast<std::uint64_t>(std::max<Duration::rep>(0, latency.count()));
  }
  if (!save_.empty() && (confirmed || !upload_))
    session.set(save_, Value::of_bytes(upload_ ? out.data : job.request.data));
  return out;
}

}  // namespace conform::steps
