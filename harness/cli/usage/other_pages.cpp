// SPDX-License-Identifier: Apache-2.0
#include "cli/usage/manual.hpp"

namespace conform::cli {
namespace {

usage::Entry usage_mistake() { return {"2", "usage, or a file that cannot be used"}; }

std::vector<usage::CommandPage> result_pages() {
  return {
      {"report",
       {{"canopen-conform report result.json --html report.html", "another report of a run that is over"},
        {"canopen-conform report run.journal --junit junit.xml",
         "from the journal of a run that was killed"}},
       {{"0, 1, 3", "the exit code of the run"}, usage_mistake()}},
      {"verify",
       {{"canopen-conform verify run.tar.zst", "whether the bundle is still what was sealed"},
        {"canopen-conform verify run.tar.zst --extract evidence", "and what is in it, if it is"}},
       {{"0", "it is as it was sealed"},
        {"1", "it is not, or is not signed by the key"},
        {"2", "usage, or it is no bundle"}}},
      {"waive",
       {{"canopen-conform waive failed.json --requirement OD-1003-06 --reason 'mended in 2.1' --ticket FW-17",
         "a failure that is accepted, in waivers.yaml"},
        {"canopen-conform waive failed.json -r OD-1003-06 --case 'cia301/dictionary/*' --reason 'see the errata' "
         "--file accepted.yaml",
         "only in some cases, in another file"}},
       {{"0", "it is written"}, {"2", "nothing of the run is covered by it, or the file cannot take it"}}},
      {"compare",
       {{"canopen-conform compare old.json new.json", "what is new, gone, or merely different"},
        {"canopen-conform compare old.json new.json --html changes.html",
         "the same as a page, with the evidence"}},
       {{"0", "the same, better, or different only"},
        {"1", "the new one is worse"},
        usage_mistake(),
        {"3", "not worse, as far as it was judged"}}},
      {"judge",
       {{"canopen-conform judge run.pcapng --node 1", "a capture, by all monitors"},
        {"canopen-conform judge candump.log --node 5 --junit junit.xml", "a log of candump, with a report"},
        {"canopen-conform judge run.pcapng --node 1 'monitor/sdo-*'", "by some monitors"}},
       {{"0", "nothing failed"},
        {"1", "at least one requirement failed"},
        {"2", "usage, a capture that cannot be read, nothing selected or nothing applicable"},
        {"3", "no failure, but something was inconclusive"}}},
  };
}

std::vector<usage::CommandPage> description_pages() {
  return {
      {"eds",
       {{"canopen-conform eds lint device.eds", "what is wrong in it, with line and column"},
        {"canopen-conform eds show device.eds", "its object dictionary as a table"}},
       {{"0, 1, 2, 3", "as the page of each command says"}}},
      {"eds lint",
       {{"canopen-conform eds lint device.eds", "what is wrong in it, with line and column"},
        {"canopen-conform eds lint --format sarif descriptions",
         "all descriptions of a folder, for a code scanner"},
        {"canopen-conform eds lint device.eds --dry-run", "what could be mended mechanically"}},
       {{"0", "no errors"},
        {"2", "errors, or usage and configuration"},
        {"3", "no errors, but a file cannot be read or written"}}},
      {"eds show",
       {{"canopen-conform eds show device.eds", "the object dictionary as a table"},
        {"canopen-conform eds show device.eds --html dictionary.html",
         "as a page, with what 'eds lint' finds"}},
       {{"0", "it is shown"}, usage_mistake()}},
      {"eds diff",
       {{"canopen-conform eds diff old.eds new.eds", "what changed between two firmware versions"},
        {"canopen-conform eds diff old.eds new.eds --format json", "the same for a program"}},
       {{"0", "they say the same"}, {"1", "they do not"}, usage_mistake()}},
      {"eds convert",
       {{"canopen-conform eds convert device.eds device.xdd", "an EDS as XDD, and what that cannot say"},
        {"canopen-conform eds convert device.eds - --to xdd", "the same on standard output"}},
       {{"0", "it is converted"}, {"1", "with --strict, something got lost"}, usage_mistake()}},
      {"eds new",
       {{"canopen-conform eds new mine.eds", "a minimal right description to begin with"},
        {"canopen-conform eds new drive.eds --profile 402 --rpdos 2 --tpdos 2",
         "of a servo drive with PDOs"}},
       {{"0", "it is written"}, usage_mistake()}},
  };
}

std::vector<usage::CommandPage> suite_pages() {
  return {
      {"lint",
       {{"canopen-conform lint", "the suites that came with the program"},
        {"canopen-conform lint machine", "own scenarios, requirements and device profiles in a folder"}},
       {{"0", "no mistakes"}, {"2", "mistakes, or usage"}}},
      {"list",
       {{"canopen-conform list", "all scenarios and monitors, with requirements and risk"},
        {"canopen-conform list --requirement OD-1003-06", "what decides a requirement"},
        {"canopen-conform list --cct", "the cases of CiA's tool, and what corresponds"}},
       {{"0", "something is shown"}, {"2", "usage, or nothing is selected"}}},
      {"explain",
       {{"canopen-conform explain OD-1014-06", "a requirement"},
        {"canopen-conform explain 1003-nonzero-write-accepted EDS212", "a defect, and a rule of 'eds lint'"},
        {"canopen-conform explain tiers", "what --allow lets a run send"}},
       {{"0", "it is explained"}, {"2", "usage, or nothing is known about it"}}},
      {"selftest",
       {{"canopen-conform selftest --defect 1003-nonzero-write-accepted -v", "what kills one defect"},
        {"canopen-conform selftest", "every defect against the whole suite"},
        {"canopen-conform selftest --full --html proof.html", "all of the proof, as a page"}},
       {{"0", "every defect is caught, and what else was asked for holds"},
        {"1", "something survives"},
        {"2", "usage"},
        {"3", "a file could not be written"}}},
      {"completion",
       {{"canopen-conform completion bash > ~/.local/share/bash-completion/completions/canopen-conform",
         "for bash, of one user"},
        {"canopen-conform completion zsh > ~/.zfunc/_canopen-conform",
         "for zsh, in a folder that stands in fpath before compinit"},
        {"canopen-conform completion fish > ~/.config/fish/completions/canopen-conform.fish",
         "for fish, of one user"}},
       {{"0", "it is printed"}, {"2", "usage"}},
       {"An installed package has brought them already. The script asks the program, so it stays true when "
        "the program changes: ids of scenarios, requirements, monitors, defects, variants and rules, and the "
        "CAN interfaces of the machine are completed as well."}},
  };
}

}  // namespace

std::vector<usage::CommandPage> other_pages() {
  auto out = result_pages();
  for (auto& page : description_pages()) out.push_back(std::move(page));
  for (auto& page : suite_pages()) out.push_back(std::move(page));
  return out;
}

}  // namespace conform::cli
