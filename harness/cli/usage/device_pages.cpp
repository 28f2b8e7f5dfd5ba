// SPDX-License-Identifier: Apache-2.0
#include "cli/usage/manual.hpp"

namespace conform::cli {
namespace {

usage::Entry usage_mistake() { return {"2", "usage, or a file with mistakes"}; }
usage::Entry environment_failed() { return {"3", "the bus, the device or a file could not be used"}; }

std::vector<usage::Entry> codes_of_a_run() {
  return {{"0", "everything planned was judged and nothing failed; warnings are allowed"},
          {"1", "at least one requirement failed; with --baseline, at least one that did not fail there"},
          {"2", "usage, a mistake in a scenario or profile, nothing selected or nothing applicable"},
          {"3", "no failure, but the environment failed or something was inconclusive"},
          {"130, 143", "ended by SIGINT, SIGTERM; values are put back and the reports are written"}};
}

}  // namespace

std::vector<usage::CommandPage> device_pages() {
  return {
      {"run",
       {{"canopen-conform run --simulate", "the whole suite against the reference node, without any device"},
        {"canopen-conform run --simulate --defect 1003-nonzero-write-accepted 'cia301/dictionary/1003*'",
         "some scenarios against a mistake that a device could have; exits with 1", 1},
        {"canopen-conform run --interface can0 --node 5 --eds device.eds --html report.html",
         "a device and what its description claims, read only, with a report for people"},
        {"canopen-conform run --simulate --eds device.eds --junit junit.xml",
         "what the description itself gets wrong, with a report for a pipeline"}},
       codes_of_a_run(),
       {"What is not said on the command line comes from the environment, then from the device profile, a "
        "device.yaml of the working folder where no device is named; --show-config tells what comes from where.",
        "Every value that a scenario changes is put back. What a killed run left is put back by "
        "'canopen-conform recover'."}},
      {"recover",
       {{"canopen-conform recover --interface can0 --node 5", "after the latest run there was killed"},
        {"canopen-conform recover run.journal --interface can1",
         "after another one, whose device is on another interface by now"}},
       {{"0", "every value is as it was, or nothing was left to put back"},
        usage_mistake(),
        {"3", "the bus or the device could not be used, or a value could not be put back"}}},
      {"replay",
       {{"canopen-conform replay run.pcapng --case cia301/dictionary/1003-error-history/number-of-errors --simulate",
         "what was sent in a case once more, to the reference node"},
        {"canopen-conform replay run.pcapng --frames 120-180 --interface can0",
         "some frames as Wireshark counts them, to a device"}},
       {{"0", "the answers were the same"},
        {"1", "other answers came"},
        usage_mistake(),
        {"3", "the bus failed, or nothing could be compared"}}},
      {"scan",
       {{"canopen-conform scan --interface can0 --node 5 --output draft.eds",
         "a draft of the description that is missing; nothing is written"},
        {"canopen-conform scan --simulate --compare device.eds",
         "where a device, here the reference node, and its description differ"},
        {"canopen-conform scan --simulate --range 1000h..1FFFh", "the communication parameters alone"}},
       {{"0", "the device was read, and does not differ from the description"},
        {"1", "it differs"},
        usage_mistake(),
        environment_failed()}},
      {"doctor",
       {{"canopen-conform doctor", "all CAN interfaces of this machine, and what to type"},
        {"canopen-conform doctor --interface can0 --ask",
         "who is on a bus: listens, and then asks every node-ID"},
        {"canopen-conform doctor --simulate --ask --listen 500",
         "the same in simulation, to see what it tells"}},
       {{"0", "the bus can be used"}, usage_mistake(), {"3", "it cannot, and why was told"}}},
      {"init",
       {{"canopen-conform init --interface can0 --node 5",
         "a device.yaml to begin with, from a look that only reads"},
        {"canopen-conform init --interface can0 --node 5 --allow config",
         "also resets the device, to measure how long it boots"},
        {"canopen-conform init --simulate --output first.yaml",
         "of the reference node, to see what it tells"}},
       {{"0", "the profile is written"},
        usage_mistake(),
        {"3", "the bus could not be used, or no device answered"}}},
      {"lss-scan",
       {{"canopen-conform lss-scan --interface can0", "the LSS addresses of slaves without node-ID"},
        {"canopen-conform lss-scan --interface can0 --assign 10", "and node-IDs for them, from 10 on"},
        {"canopen-conform lss-scan --simulate 3", "three reference nodes without node-ID"}},
       {{"0", "the bus was looked at, whoever was there"}, usage_mistake(), environment_failed()}},
      {"explore",
       {{"canopen-conform explore --simulate --actions 500 --seed 7",
         "a few random conversations with the reference node, the same on every machine"},
        {"canopen-conform explore --simulate --eds device.eds --for 2s", "with the twin of a description"},
        {"canopen-conform explore --simulate --defect sdo-served-in-stopped --actions 5000 --write found.yaml",
         "what a defect is found by, written as a scenario; exits with 1", 1},
        {"canopen-conform explore --interface can0 --device device.yaml --for 10min",
         "a device that is alone on its bus: it is reset before each conversation, and what was written is put back"}},
       {{"0", "no violated requirement was found"},
        {"1", "one was found; with --prove, a legal variant was blamed"},
        usage_mistake(),
        {"3",
         "the bus or the device was lost, or values could not be put back; with --strict, something else differs from the model"},
        {"130, 143", "ended by SIGINT, SIGTERM"}}},
  };
}

}  // namespace conform::cli
