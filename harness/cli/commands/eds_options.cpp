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
  new_sub_->add_option("--profile", new_.profile, "301: communication alone; 401: digital inputs and outputs")
      ->check(CLI::IsMember({301, 401}).description(""))
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

}  // namespace conform::cli
