// SPDX-License-Identifier: Apache-2.0
#include "main_usage.hpp"

#include <string>

#include "can/socketcan_interface.hpp"
#include "defects/defect.hpp"
#include "usage/model.hpp"
#include "variants/variant.hpp"

namespace refnode {

using conform::usage::Candidate;

conform::usage::Manual manual() {
  return {
      .program = "canopen-refnode",
      .summary = "CANopen device in software, conformant unless told otherwise",
      .pages = {{"",
                 {{"canopen-refnode --interface vcan0 --node 5", "a device that conforms"},
                  {"canopen-refnode --interface vcan0 --node 5 --defect 1014-lock-missing",
                   "one that does not"},
                  {"canopen-refnode --interface vcan0 --node 5 --eds device.eds", "the twin of your device"},
                  {"canopen-refnode --list-defects", "what can be switched on, and what that violates"}},
                 {{"0", "ended by SIGINT or SIGTERM, or what was asked for is printed"},
                  {"2", "usage, or a description that cannot be used"},
                  {"3", "the interface or the storage could not be used"}},
                 {"canopen-refnode is a CANopen device (CiA 301) on a SocketCAN interface. It conforms by "
                  "default; known defects and legal variants are switched on by their ids, and with a device "
                  "description it is the twin of the device that the file describes.",
                  "SIGUSR1 switches its power off and on: what was not stored by 1010h is lost. SIGINT and "
                  "SIGTERM end it."}}},
      .see_also = {"canopen-conform"}};
}

std::optional<std::vector<Candidate>> known_values(const conform::usage::Place& place) {
  const auto name = conform::usage::name_of(*place.option);
  std::vector<Candidate> out;
  if (name == "--interface") {
    for (const auto& interface : conform::can::can_interfaces()) out.push_back({interface, ""});
  } else if (name == "--defect") {
    for (const auto& row : defects()) out.push_back({std::string(row.id), std::string(row.summary)});
  } else if (name == "--variant") {
    for (const auto& row : variants()) out.push_back({std::string(row.id), std::string(row.summary)});
  } else {
    return std::nullopt;
  }
  return out;
}

}  // namespace refnode
