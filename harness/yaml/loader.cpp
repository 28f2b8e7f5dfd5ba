// SPDX-License-Identifier: Apache-2.0
#include "yaml/loader.hpp"

#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/files.hpp"
#include "base/in_parallel.hpp"
#include "base/text.hpp"
#include "yaml/careful_reader.hpp"
#include "yaml/quick_reader.hpp"
#include "yaml/text_check.hpp"

namespace conform::yaml {
namespace {

void refuse_directives(const Source& source, Diagnostics& diagnostics) {
  for (int number = 1; number <= source.line_count(); ++number) {
    const auto line = source.line(number);
    const auto first = line.find_first_not_of(' ');
    if (first == std::string_view::npos || line[first] == '#') continue;
    if (line[first] != '%') return;
    diagnostics.error({.line = number, .column = 1}, code_points(line), "directives (%) are not allowed",
                      "remove the line");
  }
}

}  // namespace

std::optional<Node> load(const Source& source, Diagnostics& diagnostics) {
  if (!check_text(source, diagnostics)) return std::nullopt;
  refuse_directives(source, diagnostics);
  if (diagnostics.empty()) {
    Diagnostics scratch = diagnostics;
    if (auto root = read_quickly(source, scratch)) return root;
  }
  return read_carefully(source, diagnostics);
}

Result<SourcePtr> read_source(const std::string& path, std::string name) {
  if (name.empty()) name = path;
  auto text = read_file(path, max_file_size);
  if (!text) return fail(std::move(text.error().what), std::move(name), std::move(text.error().hint));
  return make_source(std::move(name), *text);
}

Result<Document> load_file(const std::string& path, std::string name) {
  auto source = read_source(path, std::move(name));
  if (!source) return std::unexpected(source.error());
  Document document{.source = *source, .diagnostics = Diagnostics(*source), .root = std::nullopt};
  document.root = load(*document.source, document.diagnostics);
  return document;
}

std::vector<Result<Document>> load_files(const std::vector<NamedFile>& files, const UseTree& use) {
  std::vector<std::optional<Result<Document>>> loaded(files.size());
  in_parallel(files.size(), 0, [&](std::size_t i) {
    auto& document = loaded[i].emplace(load_file(files[i].path, files[i].name));
    if (!document || !document->root) return;
    use(i, *document->root, document->diagnostics);
    document->root.reset();
  });
  std::vector<Result<Document>> out;
  for (auto& each : loaded) out.push_back(std::move(*each));
  return out;
}

}  // namespace conform::yaml
