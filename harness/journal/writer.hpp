// SPDX-License-Identifier: Apache-2.0
// The journal of a run: one line per event, each appended with one write and never flushed to the medium. A
// process that is killed loses nothing it wrote; only a machine that loses its power may.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/bytes.hpp"
#include "base/strong.hpp"
#include "base/time.hpp"
#include "result/run_result.hpp"

namespace conform::journal {

/// 2: reports by the names of their formats.
inline constexpr int version = 2;

/// Files the run was asked for, as absolute paths.
struct ReportPaths {
  std::string capture{}, candump{};              ///< empty: not asked for
  std::string captures{};                        ///< folder of one capture per cause
  std::map<std::string, std::string> reports{};  ///< the others, by the name of the format: "junit"
  std::string bundle{};                          ///< empty: not asked for
  bool bundle_signed = false;                    ///< and it was to be signed
};

/// The first line: enough to make every report and to find the device again.
struct Header {
  std::string interface;
  std::uint8_t node = 0;
  bool simulated = false;
  std::string profile, eds;   ///< files, as absolute paths
  std::string suites;         ///< folder of the program's suites, as absolute path
  std::int64_t epoch_ns = 0;  ///< UTC of bus time 0
  ReportPaths reports;
};

/// What an entry of the device held before the run changed it.
struct OldValue {
  Multiplexer object;
  Bytes before;
  std::string during;  ///< the case that changed it; empty: an earlier run
};

/// Appends to an open file, which stays the caller's.
class Writer {
 public:
  explicit Writer(int descriptor) : descriptor_(descriptor) {}

  /// `run` holds what is known before the first frame.
  void begin(const Header& header, const result::RunResult& run);
  void planned(const result::RunResult& run);
  void case_begun(std::size_t index, BusTime time);
  void case_ended(std::size_t index, const result::CaseResult& one);
  /// Must be called before the frame that changes the entry goes out.
  void changing(const OldValue& value);
  void commanding(Multiplexer object);
  void put_back(Multiplexer object, const Bytes& value);
  /// Another process has put back what the killed run left, and stored it.
  void recovered();
  /// The run is over; cases that changed since they ended are written again.
  void finished(const result::RunResult& run);
  /// All reports are made: nobody needs to make them from the journal any more.
  void reported();
  /// The process is about to die of this; may be called in a signal handler.
  static void dying(int descriptor, const char* line, std::size_t size);

  /// errno of the first write that failed, 0 while all is well.
  [[nodiscard]] int error() const { return error_; }

 private:
  void append(std::string line);

  int descriptor_;
  int error_ = 0;
  std::vector<std::size_t> written_;  ///< hash of each case as written last
};

}  // namespace conform::journal
