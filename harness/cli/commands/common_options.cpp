// SPDX-License-Identifier: Apache-2.0
#include "cli/commands/common_options.hpp"

#include "reports/formats.hpp"

namespace conform::cli {

void add_waivers(CLI::App& app, std::vector<std::string>& into) {
  app.add_option("--waivers", into,
                 "File of accepted failures; repeatable (default: waivers.yaml beside the device profile)")
      ->allow_extra_args(false)
      ->type_name("FILE");
}

void add_reports(CLI::App& app, Reports& into) {
  for (const auto& format : reports::formats()) {
    const std::string name(format.name);
    app.add_option("--" + name, into[name], std::string(format.summary))->type_name("FILE");
  }
}

void add_bundle(CLI::App& app, std::string& file, std::string& key) {
  auto* const bundle =
      app.add_option(
             "--bundle", file,
             "Everything in one archive (.tar.zst) with a digest of each file: reports, capture, suites, profile, description")
          ->type_name("FILE");
  app.add_option("--sign", key, "Sign the bundle with this key (openssl genpkey -algorithm ed25519)")
      ->needs(bundle)
      ->type_name("KEY.pem");
}

}  // namespace conform::cli
