// SPDX-License-Identifier: Apache-2.0
#include "journal/writer.hpp"

#include <unistd.h>

#include <cerrno>
#include <functional>
#include <string_view>

#include "base/text.hpp"
#include "journal/lines.hpp"
#include "result/run_json.hpp"

namespace conform::journal {

using namespace result;  // run_json.hpp

void Writer::append(std::string line) {
  line += '\n';
  std::string_view rest = line;
  while (!rest.empty()) {
    const auto count = ::write(descriptor_, rest.data(), rest.size());
    if (count < 0) {
      if (errno == EINTR) continue;
      if (error_ == 0) error_ = errno;
      return;
    }
    rest.remove_prefix(static_cast<std::size_t>(count));
  }
}

void Writer::begin(const Header& header, const result::RunResult& run) {
  auto reports = Json::object();
  for (const auto& [format, path] : header.reports.reports) reports[format] = text_json(path);
  append(Json{{lines::version, version},
              {"interface", text_json(header.interface)},
              {"node", header.node},
              {"simulated", header.simulated},
              {"profile", text_json(header.profile)},
              {"eds", text_json(header.eds)},
              {"suites", text_json(header.suites)},
              {"epoch", header.epoch_ns},
              {"reports", std::move(reports)},
              {"capture", text_json(header.reports.capture)},
              {"candump", text_json(header.reports.candump)},
              {"captures", text_json(header.reports.captures)},
              {"bundle", text_json(header.reports.bundle)},
              {"bundle_signed", header.reports.bundle_signed},
              {"run", without_cases(run)}}
             .dump());
}

void Writer::planned(const result::RunResult& run) {
  written_.assign(run.cases.size(), 0);
  append(Json{{lines::planned, to_json(run)}}.dump());
}

void Writer::case_begun(std::size_t index, BusTime time) {
  append(Json{{lines::begun, index}, {"time", time.time_since_epoch().count()}}.dump());
}

void Writer::case_ended(std::size_t index, const result::CaseResult& one) {
  auto text = to_json(one).dump();
  if (index < written_.size()) written_[index] = std::hash<std::string>{}(text);
  append(std::string("{\"") + lines::ended + "\":" + std::to_string(index) + ",\"case\":" + text + "}");
}

void Writer::changing(const OldValue& value) {
  append(Json{{lines::changing, to_string(value.object)},
              {"before", hex_text(value.before)},
              {"during", text_json(value.during)}}
             .dump());
}

void Writer::commanding(Multiplexer object) { append(Json{{lines::commanding, to_string(object)}}.dump()); }

void Writer::put_back(Multiplexer object, const Bytes& value) {
  append(Json{{lines::put_back, to_string(object)}, {"value", hex_text(value)}}.dump());
}

void Writer::recovered() { append(Json{{lines::recovered, true}}.dump()); }

void Writer::finished(const result::RunResult& run) {
  for (std::size_t i = 0; i < run.cases.size(); ++i) {
    const auto text = to_json(run.cases[i]).dump();
    if (i < written_.size() && written_[i] == std::hash<std::string>{}(text)) continue;
    append(std::string("{\"") + lines::ended + "\":" + std::to_string(i) + ",\"case\":" + text + "}");
  }
  append(Json{{lines::finished, without_cases(run)}}.dump());
}

void Writer::reported() { append(Json{{lines::reported, true}}.dump()); }

void Writer::dying(int descriptor, const char* line, std::size_t size) {
  if (::write(descriptor, line, size) < 0) return;  // there is nobody left to tell
}

}  // namespace conform::journal
