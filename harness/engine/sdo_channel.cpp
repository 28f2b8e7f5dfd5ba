// SPDX-License-Identifier: Apache-2.0
#include "engine/sdo_channel.hpp"

#include "base/text.hpp"
#include "canopen/abort_code.hpp"
#include "canopen/cob_id.hpp"
#include "canopen/sdo_initiate.hpp"
#include "engine/sdo_runner.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <ranges>
#include <utility>

namespace conform::engine {
namespace {

/// A server that wrongly answers the abort does so within this time, and its answer is then no answer to what
/// follows.
constexpr Duration after_conversation = std::chrono::milliseconds(20);
/// ... of a device that answers quickly and owes no answer: nothing but such a mistake can come.
constexpr Duration after_answer = std::chrono::milliseconds(5);
/// A device may take longer than anybody thought. The silence of an entry is not believed before this, until
/// it has been seen twice (once it may have been a request that fell into the boot time).
constexpr Duration longest_answer = std::chrono::seconds(3);
/// Of a server's program: what takes longer is what an entry needs (1010h).
constexpr Duration longest_cycle = std::chrono::milliseconds(200);
/// ... but a device that often is silent must not cost hours.
constexpr Duration most_patience = std::chrono::seconds(60);
constexpr int times_in_vain = 2;
/// Transfers that a conversation can have left open: that of its first request where a later one was not
/// heard, that of the later one, and one between them.
constexpr std::size_t most_opened = 3;

auto is_response(CanId id) {
  return [id](const can::CapturedFrame& captured) {
    return captured.direction == can::Direction::received && captured.frame.is_data(id);
  };
}

steps::SdoAnswer to_answer(SdoRun& run) {
  using From = canopen::TransferResult::Kind;
  using To = steps::SdoAnswer::Kind;
  auto& result = run.result;
  steps::SdoAnswer out;
  switch (result.kind) {
    case From::confirmed: out.kind = To::confirmed; break;
    case From::aborted: out.kind = To::aborted; break;
    case From::violation: out.kind = To::violation; break;
    case From::silence: out.kind = To::silence; break;
    case From::gave_up: out.kind = To::gave_up; break;
  }
  out.data = std::move(result.data);
  out.size_indicated = result.size_indicated || !result.expedited;
  out.code = result.code;
  out.detail = std::move(result.detail);
  out.remarks = std::move(result.remarks);
  out.decisive = run.decisive;
  out.announced = result.announced_size;
  out.counts = result.counts;
  return out;
}

}  // namespace

SdoChannel::SdoChannel(Recorder& recorder, NodeId node, Duration timeout, Duration quiet)
    : recorder_(recorder), timeout_(timeout), quiet_(quiet) {
  const auto set = canopen::connection_set(node);
  default_ids_ = {set.sdo_request, set.sdo_response};
  lines_[default_ids_];
}

bool SdoChannel::is_default_of_another(const steps::SdoChannelIds& ids) const {
  const auto node = ids.request.value() - 0x600U;
  if (node < 1 || node > 127 || ids == default_ids_) return false;
  return ids.response == canopen::connection_set(NodeId(static_cast<std::uint8_t>(node))).sdo_response;
}

Duration SdoChannel::rest(const steps::SdoChannelIds& ids) const {
  const auto least =
      owes_nothing(ids) ? std::clamp(2 * slowest_, after_answer, after_conversation) : after_conversation;
  // A server that looks for requests once in a while takes as long as the slowest of them, now and then.
  return std::max({least, 2 * latest_, std::min(recently_, longest_cycle)});
}

/// What came last, but for aborts of the client, was an answer, and none that may be of a transfer which the
/// server gave up by itself: then the answer to the request that crossed it is still to come.
bool SdoChannel::owes_nothing(const steps::SdoChannelIds& ids) const {
  constexpr std::uint8_t abort = 0x80;
  const auto is_answer = is_response(ids.response);
  for (const auto& captured : recorder_.capture().frames() | std::views::reverse) {
    const bool aborts = captured.frame.size() > 0 && captured.frame.data[0] == abort;
    if (is_answer(captured)) return !aborts;
    if (captured.frame.is_data(ids.request) && !aborts) return false;
  }
  return true;
}

bool SdoChannel::is_patient(Multiplexer object) const {
  const auto before = mute_.find(object);
  return patience_spent_ < most_patience && (before == mute_.end() || before->second < times_in_vain);
}

void SdoChannel::waited_in_vain(Multiplexer object, Duration time) {
  if (time <= Duration(0)) return;
  patience_spent_ += time;
  ++mute_[object];
}

Result<void> SdoChannel::rest_after_abort() {
  const auto aborted_at = std::exchange(aborted_at_, std::nullopt);
  if (!aborted_at) return {};
  const auto until = *aborted_at + rest(default_ids_);
  return recorder_.now() >= until ? Result<void>() : recorder_.wait_until(until);
}

void SdoChannel::dirty(Line& line, bool late_answers) {
  line.state = late_answers || line.state == State::late_answers ? State::late_answers : State::open;
}

void SdoChannel::note_sent(const can::Frame& frame) {
  const auto [at, first] = sent_by_hand_.try_emplace(CanId(frame.id));
  auto& sent = at->second;
  if (first) sent.begin = recorder_.capture().size();
  if (frame.size() < 4 || !canopen::begins_transfer(frame.data[0])) return;
  const auto object = canopen::sdo_multiplexer(frame.bytes());
  sent.asked.insert(object);
  if (std::ranges::find(sent.entries, object) != sent.entries.end()) return;
  // Segments of a sub-block look like requests, too: the first entries are real, and so may be the last.
  if (sent.entries.size() == most_opened) sent.entries.pop_back();
  sent.entries.push_back(object);
}

std::optional<Multiplexer> SdoChannel::confirmed_last(CanId response, const ByHand& sent,
                                                      std::size_t begin) const {
  std::optional<Multiplexer> out;
  const auto is_answer = is_response(response);
  const auto& frames = recorder_.capture().frames();
  for (std::size_t i = begin; i < frames.size(); ++i) {
    const auto& frame = frames[i].frame;
    if (!is_answer(frames[i]) || frame.size() != 8 || !canopen::has_begun_transfer(frame.data[0])) continue;
    // Segments of a block upload look like answers, too, and name what nobody asked for.
    const auto object = canopen::sdo_multiplexer(frame.bytes());
    if (sent.asked.contains(object)) out = object;
  }
  return out;
}

void SdoChannel::heed_sent_by_hand(const steps::SdoChannelIds& ids, Line& line) {
  auto sent = sent_by_hand_.extract(ids.request);
  if (sent.empty()) return;
  if (line.state == State::idle) line.state = State::open;
  line.by_hand = std::move(sent.mapped());
  auto& entries = line.by_hand.entries;
  const auto confirmed = confirmed_last(ids.response, line.by_hand, line.by_hand.begin);
  if (confirmed && std::ranges::find(entries, *confirmed) == entries.end()) entries.push_back(*confirmed);
}

Result<std::size_t> SdoChannel::give_up(CanId request, Multiplexer object) {
  return recorder_.send(can::data_frame(request, canopen::encode_abort(object, AbortCode(0x0800'0000))));
}

/// Whether the answer in frame `i` is one of the frames that were sent since `begin`, byte for byte.
static bool sends_back(std::span<const can::CapturedFrame> frames, std::size_t i, BusTime begin) {
  const auto answer = frames[i].frame.bytes();
  for (auto j = i; j > 0 && frames[j - 1].time >= begin; --j) {
    const auto& former = frames[j - 1];
    if (former.direction == can::Direction::transmitted && std::ranges::equal(former.frame.bytes(), answer))
      return true;
  }
  return false;
}

Result<void> SdoChannel::make_idle(const steps::SdoChannelIds& ids, Line& line) {
  if (line.state == State::idle) return {};
  const bool late = std::exchange(line.state, State::idle) == State::late_answers;
  // An abort is never answered; after it, answers to what was before must not be taken for answers to what
  // comes. It names the entry of the transfer (7.2.4.3.17), and a server may take it for nothing else: where
  // a request may have been refused, or not have ended the transfer before it, each of them is named.
  const auto by_hand = std::exchange(line.by_hand, {});
  auto entries = by_hand.entries;
  if (entries.empty()) entries.push_back(line.latest.value_or(Multiplexer{Index(0), SubIndex(0)}));
  Result<std::size_t> sent = 0;
  for (const auto entry : entries) {
    sent = give_up(ids.request, entry);
    if (!sent) return std::unexpected(sent.error());
  }
  aborted_at_.reset();
  const auto begin = line.asked_at;
  const auto from = *sent;
  auto waited = recorder_.wait_until(recorder_.now() + (late ? quiet() : rest(ids)));
  // A slow server may have begun a transfer only now.
  const auto begun = waited && late ? confirmed_last(ids.response, by_hand, from) : std::nullopt;
  if (begun) {
    if (auto ended = give_up(ids.request, *begun); !ended) return std::unexpected(ended.error());
    waited = recorder_.wait_until(recorder_.now() + rest(ids));
  }
  if (!waited || !late || !line.stale) return waited;
  // What comes now says how long to wait next time.
  const auto& frames = recorder_.capture().frames();
  const auto is_answer = is_response(ids.response);
  for (auto i = from; i < frames.size(); ++i) {
    if (!is_answer(frames[i]) || frames[i].frame.size() < 4) continue;
    // A server that sends our abort back has not answered the request, however long ago that was.
    if (sends_back(frames, i, begin)) continue;
    if (canopen::sdo_multiplexer(frames[i].frame.bytes()) == *line.stale)
      note_latency(std::min(frames[i].time - begin, longest_answer));
  }
  return waited;
}

Result<void> SdoChannel::make_idle() {
  for (auto& [ids, line] : lines_) {
    heed_sent_by_hand(ids, line);
    if (auto idle = make_idle(ids, line); !idle) return idle;
  }
  return {};
}

Result<std::vector<steps::SdoAnswer>> SdoChannel::run(std::span<const steps::SdoJob> jobs) {
  std::vector<std::unique_ptr<canopen::SdoClient>> clients;
  std::vector<SdoRun> runs;
  std::vector<Line*> lines;
  for (const auto& job : jobs) {
    auto client = canopen::make_sdo_client(job.request);
    if (!client) return std::unexpected(client.error());
    const auto ids = job.channel.value_or(default_ids_);
    auto& line = lines_[ids];
    if (std::ranges::find(lines, &line) != lines.end())
      return fail_scenario("two transfers at the same time on the channel " + to_string(ids.request),
                           "give each a channel of its own");
    lines.push_back(&line);
    SdoRun run;
    run.client = client->get();
    run.object = job.request.object;
    run.request = ids.request;
    run.response = ids.response;
    run.listens_after = !job.request.faults.empty();
    run.stale = line.stale;
    clients.push_back(std::move(*client));
    runs.push_back(std::move(run));
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    heed_sent_by_hand({runs[i].request, runs[i].response}, *lines[i]);
    // Of an abandoned transfer the server must rid itself: to help it would hide that it cannot.
    if (lines[i]->state == State::abandoned) continue;
    if (auto idle = make_idle({runs[i].request, runs[i].response}, *lines[i]); !idle)
      return std::unexpected(idle.error());
  }
  if (auto rested = rest_after_abort(); !rested) return std::unexpected(rested.error());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    // What came late until now says how long an answer may take.
    runs[i].limit = jobs[i].timeout.value_or(timeout());
    if (!jobs[i].timeout && is_patient(runs[i].object)) runs[i].patience = longest_answer;
    runs[i].wait = jobs[i].wait.value_or(quiet());
    lines[i]->latest = runs[i].object;
  }
  if (auto done = run_transfers(recorder_, runs); !done) {
    for (auto* line : lines) dirty(*line, true);
    return std::unexpected(done.error());
  }
  std::vector<steps::SdoAnswer> out;
  std::string misplaced;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    using Kind = canopen::TransferResult::Kind;
    auto& result = runs[i].result;
    auto& line = *lines[i];
    // What a step gives a time of its own is known to be slow: it says nothing about other answers.
    if (!jobs[i].timeout && runs[i].slowest > Duration(0)) {
      note_latency(runs[i].slowest);
      latest_ = runs[i].latest;
    }
    waited_in_vain(runs[i].object, runs[i].waited_in_vain);
    line.state = result.abandoned ? State::abandoned : State::idle;
    if (result.kind == Kind::violation || (result.kind == Kind::silence && !result.abandoned)) {
      dirty(line, true);
      line.stale = runs[i].object;
      line.asked_at = runs[i].asked_at;
    } else if (!result.abandoned) {
      // A server answers in order: what was overdue does not come any more.
      line.stale.reset();
    }
    if (misplaced.empty()) misplaced = result.misplaced;
    out.push_back(to_answer(runs[i]));
    const auto& request = jobs[i].request;
    if (request.upload && !out.back().size_indicated) trim(request.object, out.back().data);
    if (on_value_ && out.back().kind == steps::SdoAnswer::Kind::confirmed)
      on_value_({request.object, request.upload ? out.back().data : request.data, !request.upload,
                 is_default_of_another({runs[i].request, runs[i].response})});
  }
  first_request_ = recorder_.capture().size();
  for (const auto& run : runs) {
    first_request_ = std::min(first_request_, run.first_request.value_or(first_request_));
    last_request_ = &run == runs.data() ? run.last_request : std::max(last_request_, run.last_request);
  }
  if (!misplaced.empty()) return fail_scenario(misplaced);
  return out;
}

/// Of four bytes whose number is left open (s = 0, 7.2.4.3.6) the entry's type says how many are data.
void SdoChannel::trim(Multiplexer object, Bytes& data) const {
  if (!known_size_) return;
  if (const auto known = known_size_(object); known && *known > 0 && *known < data.size())
    data.resize(*known);
}

bool SdoChannel::has_other_client(std::size_t first, std::size_t end) const {
  const auto& frames = recorder_.capture().frames();
  for (auto i = first; i < std::min(end, frames.size()); ++i) {
    const auto& captured = frames[i];
    if (captured.direction != can::Direction::received) continue;
    for (const auto& [ids, line] : lines_) {
      if (captured.frame.is_data(ids.request)) return true;
    }
  }
  return false;
}

Result<steps::SdoAnswer> SdoChannel::run_one(canopen::SdoRequest request, std::optional<Duration> timeout) {
  const steps::SdoJob job{.request = std::move(request), .timeout = timeout};
  auto answers = run({&job, 1});
  if (!answers) return std::unexpected(answers.error());
  return std::move(answers->front());
}

Result<steps::SdoAnswer> SdoChannel::upload(Multiplexer object, std::optional<Duration> timeout) {
  return run_one({.upload = true, .object = object}, timeout);
}

Result<steps::SdoAnswer> SdoChannel::glance(Multiplexer object) {
  auto answer = run_one({.upload = true, .object = object, .enough = enough_to_see}, std::nullopt);
  // A server may answer the abort, wrongly; not into what comes next.
  if (answer && answer->kind == steps::SdoAnswer::Kind::gave_up) note_abort(last_request_);
  return answer;
}

Result<std::optional<std::array<std::uint8_t, 8>>> SdoChannel::ask(
    const std::array<std::uint8_t, 8>& request) {
  using Answer = std::optional<std::array<std::uint8_t, 8>>;
  if (auto idle = make_idle(); !idle) return std::unexpected(idle.error());
  if (auto rested = rest_after_abort(); !rested) return std::unexpected(rested.error());
  auto& line = default_line();
  const auto object = canopen::sdo_multiplexer(request);
  const auto answers = [this, &line, object](const can::CapturedFrame& captured) {
    if (!is_response(default_ids_.response)(captured)) return false;
    const auto bytes = captured.frame.bytes();
    const bool of_another = line.stale && *line.stale != object && bytes.size() >= 4 &&
                            canopen::sdo_multiplexer(bytes) == *line.stale;
    return !of_another;
  };
  auto sent = recorder_.send(can::data_frame(default_ids_.request, request));
  if (!sent) return std::unexpected(sent.error());
  const auto asked_at = recorder_.capture().frames()[*sent].time;
  const auto limit = is_patient(object) ? std::max(longest_answer, timeout()) : timeout();
  auto found = recorder_.find(recorder_.first_effect(*sent), answers, asked_at + limit);
  if (!found) return std::unexpected(found.error());
  line.latest = object;
  Answer out;
  if (*found) {
    const auto& answer = recorder_.capture().frames()[**found];
    out = answer.frame.data;
    note_latency(std::max(Duration(0), answer.time - asked_at));
    line.stale.reset();
    // An abort has closed the channel, and an expedited upload never opened one.
    const bool expedited = ((*out)[0] & 0xE2U) == 0x42U && (request[0] & 0xE0U) == 0x40U;
    if ((*out)[0] != 0x80 && !expedited) dirty(false);
  } else {
    line.stale = object;
    line.asked_at = asked_at;
    waited_in_vain(object, limit - timeout());
    dirty(true);
  }
  // Whoever comes next may send frames without looking at the channel.
  if (auto idle = make_idle(); !idle) return std::unexpected(idle.error());
  return out;
}

Result<std::optional<std::uint64_t>> SdoChannel::held_bytes(Multiplexer object) {
  using Size = std::optional<std::uint64_t>;
  const auto first = ask(canopen::encode_upload_request(object));
  if (!first) return std::unexpected(first.error());
  if (!*first) return Size();
  const auto answer = canopen::decode_upload_response(**first);
  if (!answer) return Size();
  if (answer->expedited) return Size(answer->expedited_size());
  if (answer->size_indicated) return Size(answer->value);
  auto whole = upload(object, std::nullopt);
  if (!whole) return std::unexpected(whole.error());
  return whole->kind == steps::SdoAnswer::Kind::confirmed ? Size(whole->data.size()) : Size();
}

Result<std::optional<std::array<std::uint8_t, 8>>> SdoChannel::try_block_initiate(
    const std::array<std::uint8_t, 8>& request) {
  return ask(request);
}

Result<steps::SdoAnswer> SdoChannel::download(Multiplexer object, Bytes data, canopen::SdoDownload::Mode mode,
                                              std::optional<Duration> timeout) {
  return run_one({.upload = false, .object = object, .data = std::move(data), .mode = mode}, timeout);
}

}  // namespace conform::engine
