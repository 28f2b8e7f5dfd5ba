// SPDX-License-Identifier: Apache-2.0
// What a killed run left in its device, as its journal tells.
#pragma once

#include <optional>
#include <string>

#include "base/strong.hpp"
#include "engine/recover.hpp"
#include "journal/reader.hpp"

namespace conform::cli {

/// The entry of 1010h that stores what this command of 1010h or 1011h stored or wanted back: it acts on the
/// memory that outlives a reset. Nothing for other commands.
[[nodiscard]] std::optional<Multiplexer> stored_by(Multiplexer command);

/// By what the device of a run is known, as it was read: "vendor-ID 00005AFEh, product code 00000301h".
[[nodiscard]] std::string device_of(const result::RunResult& run);

/// What is to be put back. `all`: also what the run has put back itself; `store`: and what is to be stored
/// once it is back.
[[nodiscard]] engine::Remains remains_of(const journal::Journal& journal, bool all, bool store);

}  // namespace conform::cli
