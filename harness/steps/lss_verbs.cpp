// SPDX-License-Identifier: Apache-2.0
// The verb `lss`: layer setting services (CiA 305) as procedures. Where the bytes are the point, `talk` is
// the better word.
#include <algorithm>
#include <array>

#include "base/text.hpp"
#include "canopen/cob_id.hpp"
#include "canopen/lss.hpp"
#include "steps/verb_tables.hpp"

namespace conform::steps {
namespace {

using canopen::LssAddress;
using canopen::LssCommand;

/// What scenarios call the parts of the LSS address of the device: 1018h:01 to 04.
constexpr std::array<const char*, canopen::lss_parts> part_names = {"vendor", "product", "revision",
                                                                    "serial"};

/// The first answer behind `from`, in time counted from the frame `from - 1`.
Result<std::optional<std::size_t>> find_answer(Session& session, std::size_t from, Duration within) {
  const auto sent = session.capture().frames()[from - 1].time;
  return session.find_frame(
      from,
      [](const can::CapturedFrame& captured) {
        return captured.direction == can::Direction::received && !captured.frame.error &&
               captured.frame.id == canopen::lss_response_can_id.value();
      },
      sent + within);
}

/// Sends one request; the index behind it, where its answer is looked for.
Result<std::size_t> send(Session& session, const can::Frame& frame) {
  const auto begin = session.capture().size();
  if (auto sent = session.send(frame); !sent) return std::unexpected(sent.error());
  return sent_frame(session, begin).value_or(session.capture().size() - 1) + 1;
}

Actual silence(Duration within) {
  Actual out;
  out.kind = Actual::Kind::silence;
  out.detail = "no LSS answer within " + to_string(within);
  return out;
}

/// The answer to a request, which must repeat its command specifier (or be `due`).
Result<Actual> ask(Session& session, const can::Frame& request, LssCommand due, Duration within) {
  auto from = send(session, request);
  if (!from) return std::unexpected(from.error());
  auto found = find_answer(session, *from, within);
  if (!found) return std::unexpected(found.error());
  if (!*found) return silence(within);
  const auto frame = session.capture().frames()[**found].frame;
  session.consume(**found);
  Actual out;
  out.decisive = *found;
  const auto answer = canopen::decode_lss(frame);
  if (!answer || answer->specifier != static_cast<std::uint8_t>(due)) {
    out.kind = Actual::Kind::mismatched;
    out.detail =
        "due: LSS answer " + hex(static_cast<std::uint8_t>(due), 2) + ", came " + hex_bytes(frame.bytes());
    return out;
  }
  const auto latency = session.capture().frames()[**found].time - session.capture().frames()[*from - 1].time;
  out.measured["latency"] = static_cast<std::uint64_t>(std::max<Duration::rep>(0, latency.count()));
  out.data.assign(frame.bytes().begin(), frame.bytes().end());
  out.data.resize(8);  // that some are missing is another rule's
  return out;
}

/// 1018h of the device; what it does not have counts as 0.
Result<LssAddress> read_address(Session& session) {
  LssAddress out{};
  for (std::uint8_t part = 0; part < canopen::lss_parts; ++part) {
    const Multiplexer entry{Index(0x1018), SubIndex(static_cast<std::uint8_t>(part + 1))};
    auto present = session.is_present(entry, false);
    if (!present) return std::unexpected(present.error());
    if (*present) {
      auto value = session.read(entry);
      if (!value) return std::unexpected(value.error());
      out[part] = static_cast<std::uint32_t>(value->number.value_or(0));
    }
    session.set(part_names[part], Value::of_number(out[part]));
  }
  return out;
}

/// As `lss: address` found it, or found now.
Result<LssAddress> address_of(Session& session) {
  LssAddress out{};
  for (std::uint8_t part = 0; part < canopen::lss_parts; ++part) {
    const auto* known = session.find(part_names[part]);
    if (known == nullptr || !known->number) return read_address(session);
    out[part] = static_cast<std::uint32_t>(*known->number);
  }
  return out;
}

Actual of_bytes(Actual answer, std::size_t from, std::size_t size) {
  if (answer.kind != Actual::Kind::matched) return answer;
  const auto bytes = ByteView(answer.data).subspan(from, size);
  answer.data = Bytes(bytes.begin(), bytes.end());
  answer.has_data = true;
  return answer;
}

/// The words of the verb that take no parameter.
enum class Word : std::uint8_t { address, select, waiting, configuration, store, fastscan };

class Lss final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext& context) {
    auto out = std::make_unique<Lss>();
    if (!value.node()->is_mapping()) {
      const auto word = value.one_of<Word>({{"address", Word::address},
                                            {"select", Word::select},
                                            {"waiting", Word::waiting},
                                            {"configuration", Word::configuration},
                                            {"store", Word::store},
                                            {"fastscan", Word::fastscan}});
      if (!word) return nullptr;
      out->word_ = word;
      if (*word == Word::address || *word == Word::fastscan) out->know_parts(context);
      return out;
    }
    auto fields = value.fields("lss");
    const auto field = fields.exactly_one_of({"node_id", "bit_timing", "inquire", "store"});
    if (!field) return nullptr;
    if (fields.has("store")) {
      if (field.boolean() != true) return nullptr;
      out->word_ = Word::store;
    } else if (fields.has("inquire")) {
      const auto what = field.one_of<LssCommand>({{"vendor", LssCommand::inquire_vendor},
                                                  {"product", LssCommand::inquire_product},
                                                  {"revision", LssCommand::inquire_revision},
                                                  {"serial", LssCommand::inquire_serial},
                                                  {"node-ID", LssCommand::inquire_node_id}});
      if (!what) return nullptr;
      out->command_ = *what;
    } else {
      out->command_ =
          fields.has("node_id") ? LssCommand::configure_node_id : LssCommand::configure_bit_timing;
      const auto number = parse_expression_at(field, context.names);
      if (!number) return nullptr;
      out->number_ = *number;
    }
    if (const auto table = fields.optional("table")) {
      if (auto number = parse_expression_at(table, context.names)) out->table_ = *number;
    }
    if (const auto save = fields.optional("save")) {
      out->save_ = save.text().value_or("");
      context.know(out->save_);
    }
    return out;
  }

  Measures measures() const override { return word_ ? Measures{} : Measures{"latency"}; }
  Need need() const override {
    if (word_ == Word::address) return {};
    const auto of = [](LssCommand command, std::uint8_t first = 0) {
      return need_of(canopen::encode_lss(command, first), NodeId(1));
    };
    if (word_ == Word::store) return of(LssCommand::store);
    if (word_ == Word::fastscan) return of(LssCommand::fastscan);
    return of(LssCommand::switch_global, word_ == Word::configuration ? 1 : 0);
  }
  bool rests_on_time() const override { return word_ != Word::address; }
  std::string words(Session& session) const override {
    if (!word_) {
      const auto name = std::string(canopen::lss_command_name(static_cast<std::uint8_t>(command_)));
      if (number_.empty()) return "LSS " + name;
      const auto number = number_.number(session);
      return "LSS " + name + " " + (number ? std::to_string(*number) : number_.text());
    }
    switch (*word_) {
      case Word::address: return "read the LSS address, 1018h";
      case Word::select: return "LSS switch state selective";
      case Word::waiting: return "LSS switch state global, waiting";
      case Word::configuration: return "LSS switch state global, configuration";
      case Word::store: return "LSS store configuration";
      case Word::fastscan: return "LSS fastscan";
    }
    return {};
  }

  Result<Actual> run(Session& session) const override {
    if (word_ != Word::address) {
      if (auto reached = session.await_state(); !reached) return std::unexpected(reached.error());
    }
    auto out = word_ ? run_word(session, *word_) : run_command(session);
    if (out && out->has_data && !save_.empty()) session.set(save_, Value::of_bytes(out->data));
    return out;
  }

 private:
  void know_parts(ParseContext& context) const {
    for (const auto* name : part_names)
      context.know(word_ == Word::fastscan ? std::string("found_") + name : std::string(name));
  }

  static Result<Actual> run_word(Session& session, Word word) {
    const auto within = session.profile().lss_timeout;
    switch (word) {
      case Word::address: {
        auto address = read_address(session);
        if (!address) return std::unexpected(address.error());
        return Actual{};
      }
      case Word::select: return select(session);
      case Word::waiting: return switch_to(session, 0);
      case Word::configuration: return switch_to(session, 1);
      case Word::store: {
        auto answer = ask(session, canopen::encode_lss(LssCommand::store), LssCommand::store,
                          std::max(within, session.profile().store_timeout));
        if (!answer) return answer;
        return of_bytes(std::move(*answer), 1, 1);
      }
      case Word::fastscan: return scan(session);
    }
    return Actual{};
  }

  Result<Actual> run_command(Session& session) const {
    const auto within = session.profile().lss_timeout;
    if (number_.empty()) {
      auto answer = ask(session, canopen::encode_lss(command_), command_, within);
      if (!answer) return answer;
      return of_bytes(std::move(*answer), 1, command_ == LssCommand::inquire_node_id ? 1 : 4);
    }
    const auto number = number_.number(session);
    if (!number) return std::unexpected(number.error());
    const auto table = table_.empty() ? Result<std::uint64_t>(0) : table_.number(session);
    if (!table) return std::unexpected(table.error());
    if (*number > 0xFF || *table > 0xFF)
      return fail_scenario("'" + number_.text() + "' does not fit into a byte");
    const auto value = static_cast<std::uint8_t>(*number);
    const auto request = command_ == LssCommand::configure_node_id
                             ? canopen::encode_lss(command_, value)
                             : canopen::encode_lss(command_, static_cast<std::uint8_t>(*table), value);
    auto answer = ask(session, request, command_, within);
    if (!answer) return answer;
    if (answer->kind == Actual::Kind::matched)
      answer->detail =
          "error code " + canopen::describe_lss_error(answer->data[0], answer->data[1], answer->data[2]);
    return of_bytes(std::move(*answer), 1, 1);
  }

  /// There is no answer: who wants to know asks for the node-ID.
  static Result<Actual> switch_to(Session& session, std::uint8_t mode) {
    const auto index = session.capture().size();
    auto from = send(session, canopen::encode_lss(LssCommand::switch_global, mode));
    if (!from) return std::unexpected(from.error());
    Actual out;
    out.decisive = sent_frame(session, index);
    return out;
  }

  static Result<Actual> select(Session& session) {
    const auto address = address_of(session);
    if (!address) return std::unexpected(address.error());
    const auto within = session.profile().lss_timeout;
    if (auto sent = send(session, canopen::encode_lss(LssCommand::switch_global)); !sent)
      return std::unexpected(sent.error());
    auto frames = canopen::encode_lss_selection(*address);
    const auto last = frames.back();
    frames.pop_back();
    for (const auto& frame : frames) {
      if (auto sent = send(session, frame); !sent) return std::unexpected(sent.error());
    }
    return ask(session, last, LssCommand::selected, within);
  }

  /// The whole of it. Half of the questions have no answer, so that a quick slave is not waited for the whole
  /// time each; who is not found that way is looked for once more.
  static Result<Actual> scan(Session& session) {
    auto out = scan(session, Patience::as_it_answers);
    if (!out || out->kind != Actual::Kind::silence) return out;
    return scan(session, Patience::whole);
  }

  enum class Patience : std::uint8_t {
    whole,          ///< T_LSS for each answer
    as_it_answers,  ///< for a bit some times as long as the slowest answer took
  };
  /// Every bit of the four numbers, and each number once more at its end.
  static Result<Actual> scan(Session& session, Patience patience) {
    const auto within = session.profile().lss_timeout;
    std::uint64_t slowest = 0;
    canopen::LssScan scan;
    Actual out;
    while (!scan.finished()) {
      const auto question = scan.question();
      const bool quick = patience == Patience::as_it_answers && question.part == question.next &&
                         question.bit_check != canopen::LssFastscan::begin;
      const Duration usual = std::chrono::nanoseconds(4 * slowest) + std::chrono::milliseconds(20);
      auto answer = ask(session, canopen::encode(question), LssCommand::identified,
                        quick ? std::min<Duration>(usual, within) : within);
      if (!answer || answer->kind == Actual::Kind::mismatched) return answer;
      out.decisive = answer->decisive;
      if (const auto took = answer->measured.find("latency"); took != answer->measured.end())
        slowest = std::max(slowest, took->second);
      scan.answered(answer->kind == Actual::Kind::matched);
    }
    for (std::uint8_t part = 0; part < canopen::lss_parts; ++part)
      session.set(std::string("found_") + part_names[part], Value::of_number(scan.address()[part]));
    if (!scan.found()) return silence(within);
    std::string address;
    for (const auto number : scan.address()) address += (address.empty() ? "" : ", ") + hex(number, 8);
    out.detail = "found " + address;
    return out;
  }

  std::optional<Word> word_;
  LssCommand command_ = LssCommand::inquire_node_id;
  Expression number_, table_;
  std::string save_;
};

constexpr Verb table[] = {
    {"lss",
     "Layer setting services (CiA 305). The outcome of configuring and storing is the error code of the answer.",
     "(word): address (1018h:01 to 04 get the names vendor, product, revision, serial), select (switch state selective with that address), waiting, configuration (switch state global), store, fastscan (a whole scan; what it finds gets the names found_vendor, ...)\n"
     "store: true, for the error code to be saved\nnode_id: configure the node-ID\nbit_timing, table: configure an entry of a table of bit rates\ninquire: vendor, product, revision, serial, node-ID\nsave: name that the error code, or what was asked for, gets\nmeasured: latency",
     "- lss: select\n- lss: {node_id: 5}\n  expect: {value: 0}\n- lss: waiting", &Lss::parse},
};

}  // namespace

std::span<const Verb> lss_verbs() { return table; }

}  // namespace conform::steps
