// SPDX-License-Identifier: Apache-2.0
// What a run tells while it goes on. The engine renders nothing and writes no file: consoles, journals and
// captures are made by whoever listens here.
#pragma once

#include <cstddef>
#include <vector>

#include "base/bytes.hpp"
#include "base/strong.hpp"
#include "base/time.hpp"
#include "can/capture.hpp"
#include "result/run_result.hpp"

namespace conform::engine {

/// Called in the thread of the run, between two frames: what takes long here delays the test.
class Observer {
 public:
  Observer() = default;
  Observer(const Observer&) = delete;
  Observer& operator=(const Observer&) = delete;
  virtual ~Observer() = default;

  /// The next frame of the capture.
  virtual void recorded(const can::CapturedFrame& /*frame*/) {}
  /// The bus was silent until now.
  virtual void waited(BusTime /*now*/) {}
  /// The result holds every planned case from here on, as "not run". `to_play`: of each case, whether it is
  /// to be played; the others are left out, do not apply, or watch.
  virtual void planned(const result::RunResult& /*run*/, const std::vector<bool>& /*to_play*/) {}
  virtual void case_begun(const result::RunResult& /*run*/, std::size_t /*index*/) {}  ///< index into cases
  virtual void case_ended(const result::RunResult& /*run*/, std::size_t /*index*/) {}
  /// Before the first frame of a case that may change this entry goes out.
  virtual void changing(Multiplexer /*object*/, const Bytes& /*before*/) {}
  /// Before a command goes out, such as "save": it has an effect instead of a value.
  virtual void commanding(Multiplexer /*object*/) {}
  /// The entry holds `value` again, or all that can be done for it was done.
  virtual void put_back(Multiplexer /*object*/, const Bytes& /*value*/) {}
};

}  // namespace conform::engine
