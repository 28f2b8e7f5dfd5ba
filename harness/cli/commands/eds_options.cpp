// SPDX-License-Identifier: Apache-2.0
#include "cli/commands/eds_options.hpp"

namespace conform::cli {

void EdsWriters::add_to(CLI::App& app) {
  const auto one_of = [](CLI::Option* option, const std::vector<std::string>& words) {
    option->check(CLI::IsMember(words).description(""))->type_name("FORMAT");
  };
  convert_sub_ = app.add_subcommand(
      "convert", "Write an EDS or DCF as XDD or XDC, or the other way round, and tell what gets lost");
  convert_sub_->add_option("in", convert_.in, "Device description")->required()->type_name("IN");
  convert_sub_->add_option("out", convert_.out, "File to write; - for standard output")
      ->required()
      ->type_name("OUT");
  one_of(convert_sub_->add_option("--to", convert_.to, "Format of OUT (default: by its extension)"),
         {"eds", "dcf", "xdd", "xdc"});
  one_of(convert_sub_->add_option("-f,--format", convert_.format, "Report: text or json"), {"text", "json"});
  convert_sub_->add_flag("--strict", convert_.strict, "Exit with 1 when something gets lost");

  new_sub_ = app.add_subcommand("new", "Write a minimal right description to begin with");
  new_sub_->add_option("out", new_.out, "File to write (default: standard output)")->type_name("OUT");
  one_of(new_sub_->add_option("--to", new_.to, "Format: eds or xdd (default: by the extension of OUT)"),
         {"eds", "xdd"});
  new_sub_
      ->add_option("--profile", new_.profile,
                   "301: communication alone; 401: digital inputs and outputs; 402: servo drive")
      ->check(CLI::IsMember({301, 401, 402}).description(""))
      ->type_name("PROFILE");
  new_sub_->add_option("--vendor-name", new_.vendor_name, "Name of the vendor")->type_name("TEXT");
  new_sub_->add_option("--vendor", new_.vendor, "Vendor-ID (1018h:01)")->type_name("NUMBER");
  new_sub_->add_option("--product-name", new_.product_name, "Name of the product")->type_name("TEXT");
  new_sub_->add_option("--product", new_.product, "Product code (1018h:02)")->type_name("NUMBER");
  new_sub_->add_option("--revision", new_.revision, "Revision number (1018h:03)")->type_name("NUMBER");
  new_sub_->add_option("--rpdos", new_.rpdos, "RPDOs, each with one object mapped (default 0)")
      ->check(CLI::Range(0, 64).description(""))
      ->type_name("COUNT");
  new_sub_->add_option("--tpdos", new_.tpdos, "TPDOs, each with one object mapped (default 0)")
      ->check(CLI::Range(0, 64).description(""))
      ->type_name("COUNT");
  new_sub_->add_option("--date", new_.date, "Date of the file, yyyy-mm-dd (default: today)")
      ->type_name("DATE");
}

std::optional<int> EdsWriters::run() const {
  if (convert_sub_->parsed()) return eds_convert_command(convert_);
  if (new_sub_->parsed()) return eds_new_command(new_);
  return std::nullopt;
}

void EdsOptions::add_to(CLI::App& app) {
  app.require_subcommand(1);
  const auto format = [](CLI::App* sub, std::string& into, const std::vector<std::string>& names,
                         const char* help) {
    sub->add_option("-f,--format", into, help)
        ->check(CLI::IsMember(names).description(""))
        ->type_name("FORMAT");
  };
  add_lint_to(app);
  format(lint_sub_, lint_.format, {"text", "json", "github", "sarif"}, "Output: text, json, github or sarif");
  show_sub_ = app.add_subcommand("show", "Print the object dictionary as a table");
  show_sub_->add_option("file", show_.file, "Device description")->required()->type_name("FILE");
  format(show_sub_, show_.format, {"text", "json"}, "Output: text or json");
  show_sub_->add_option("--html", show_.html, "Write a page for a browser instead, with what lint finds")
      ->type_name("PAGE");
  diff_sub_ =
      app.add_subcommand("diff", "Tell what changed between two files; exits with 1 where they differ");
  diff_sub_->add_option("before", diff_.before, "Device description of before")
      ->required()
      ->type_name("BEFORE");
  diff_sub_->add_option("after", diff_.after, "Device description of after")->required()->type_name("AFTER");
  format(diff_sub_, diff_.format, {"text", "json"}, "Output: text or json");
  diff_sub_->add_flag("--file-info", diff_.file_info,
                      "What only describes the file counts, too: [FileInfo] and [Comments]");
  writers_.add_to(app);
}

void EdsOptions::add_lint_to(CLI::App& app) {
  lint_sub_ = app.add_subcommand(
      "lint",
      "Tell what is wrong in the files; exits with 2 where there are errors, with 3 where only a file cannot be read");
  lint_sub_
      ->add_option("files", lint_.files,
                   "Device descriptions, and folders in which *.eds, *.dcf, *.xdd and *.xdc are looked for")
      ->type_name("FILE");
  lint_sub_->add_flag("--strict", lint_.strict, "Warnings count as errors");
  lint_sub_->add_flag("-v,--verbose", lint_.verbose, "Tell findings that are alike one by one");
  lint_sub_->add_option("--allow", lint_.allow, "Switch a rule off; repeatable")
      ->type_name("RULE")
      ->allow_extra_args(false);
  lint_sub_
      ->add_option("--severity", lint_.severity,
                   "Give a rule another severity, as EDS210=note (error, warning, note); repeatable")
      ->type_name("RULE=SEVERITY")
      ->allow_extra_args(false);
  auto* config =
      lint_sub_
          ->add_option("--config", lint_.config,
                       "Configuration (default: .canopen-conform.yaml beside the description or above)")
          ->type_name("FILE");
  lint_sub_->add_flag("--no-config", lint_.no_config, "Look for no configuration")->excludes(config);
  lint_sub_->add_option("--baseline", lint_.baseline, "Findings that are known, which are not told again")
      ->type_name("FILE");
  lint_sub_->add_flag("--write-baseline", lint_.write_baseline, "Write what is found into the baseline");
  auto* fix = lint_sub_->add_flag(
      "--fix", lint_.fix, "Mend what is mechanical, and show it: counts, numbering, forms of writing");
  lint_sub_->add_flag("--diff,--dry-run", lint_.dry_run, "Show what --fix would change, and change nothing")
      ->excludes(fix);
  lint_sub_->add_flag("--rules", lint_.rules, "Print all rules as Markdown instead");
  lint_sub_
      ->add_option("--rules-uri", lint_.rules_uri,
                   "Where the page of the rules is published, for links in SARIF")
      ->type_name("URI");
  lint_sub_->add_option("--color", lint_.color, "Colours: auto, always or never")
      ->check(CLI::IsMember({"auto", "always", "never"}).description(""))
      ->type_name("WHEN");
}

int EdsOptions::run() const {
  if (const auto code = writers_.run()) return *code;
  if (lint_sub_->parsed()) return eds_lint_command(lint_);
  return show_sub_->parsed() ? eds_show_command(show_) : eds_diff_command(diff_);
}

}  // namespace conform::cli
