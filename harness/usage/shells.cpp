// SPDX-License-Identifier: Apache-2.0
#include "usage/shells.hpp"

#include <algorithm>

#include "base/text.hpp"

namespace conform::usage {
namespace {

// readline takes "=" and ":" for ends of words, so the program is given the line and tells the rest of the
// word that readline sees. Names of files are left to readline, which knows quotes, tildes and links.
constexpr std::string_view bash_script = R"(# Completion of @PROGRAM@ for bash, made by the program itself.
@FUNCTION@() {
  local program=${1/#\~\//$HOME/}
  mapfile -t COMPREPLY < <("$program" __complete bash "$2" "${COMP_LINE:0:COMP_POINT}" 2>/dev/null)
  case ${COMPREPLY[0]-} in
    files) compopt -o bashdefault -o default ;;
    folders) compopt -o dirnames ;;
    open) compopt -o nospace ;;
  esac
  COMPREPLY=("${COMPREPLY[@]:1}")
}
complete -F @FUNCTION@ @PROGRAM@
)";

constexpr std::string_view zsh_script = R"(#compdef @PROGRAM@
# Completion of @PROGRAM@ for zsh, made by the program itself.
@FUNCTION@() {
  local line word about expl
  local -a answer whole open
  answer=("${(@f)$("${(Q)words[1]/#\~\//$HOME/}" __complete words "${(@Q)words[2,CURRENT-1]}" "${(Q)PREFIX}" 2>/dev/null)}")
  case $answer[1] in
    files|folders)
      compset -P '--*='
      if [[ $answer[1] == folders ]]; then _wanted directories expl folder _path_files -/; else _files; fi
      return
      ;;
  esac
  for line in "${(@)answer[2,-1]}"; do
    word=${line%%$'\t'*}
    about=
    [[ $line != *$'\t'* ]] || about=:${line#*$'\t'}
    if [[ $word == *[/=] ]]; then open+=("${word//:/\\:}$about"); else whole+=("${word//:/\\:}$about"); fi
  done
  (( ! $#whole )) || _describe -t words word whole
  (( ! $#open )) || _describe -t words word open -S ''
}
if [[ $funcstack[1] == @FUNCTION@ ]]; then
  @FUNCTION@ "$@"
else
  compdef @FUNCTION@ @PROGRAM@
fi
)";

constexpr std::string_view fish_script = R"(# Completion of @PROGRAM@ for fish, made by the program itself.
function @FUNCTION@
    set -l words (commandline -opc)
    set -l current (commandline -ct)
    set -l program $words[1]
    set -e words[1]
    set -l answer ($program __complete words $words "$current" 2>/dev/null)
    set -l option (string match -r -- '^--[^=]*=' "$current")
    set -l path (string replace -r -- '^--[^=]*=' '' "$current")
    set -l found
    switch "$answer[1]"
        case files
            set found "$option"(__fish_complete_path "$path")
        case folders
            set found "$option"(__fish_complete_directories "$path" '')
        case '*'
            set found $answer[2..-1]
    end
    test (count $found) -eq 0; or printf '%s\n' $found
end
complete -c @PROGRAM@ -f -a '(@FUNCTION@)'
)";

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

/// A tabulator or the end of a line would end the word.
std::string one_line(std::string text) {
  std::ranges::replace_if(text, [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  return text;
}

}  // namespace

std::string completion_script(std::string_view shell, const std::string& program) {
  auto function = "_" + program;
  if (shell != "zsh") std::ranges::replace(function, '-', '_');
  const auto script = shell == "bash" ? bash_script : shell == "zsh" ? zsh_script : fish_script;
  return replaced(replaced(std::string(script), "@FUNCTION@", function), "@PROGRAM@", program);
}

std::string completion_path(std::string_view shell, const std::string& program) {
  if (shell == "bash") return "bash-completion/completions/" + program;
  return shell == "zsh" ? "zsh/site-functions/_" + program : "fish/vendor_completions.d/" + program + ".fish";
}

std::vector<std::string> words_of_line(std::string_view line) {
  std::vector<std::string> out(1);
  char quote = 0;
  bool begun = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    const bool escapes = c == '\\' && quote != '\'' && i + 1 < line.size();
    if (escapes && (quote == 0 || std::string_view("\\\"$`").contains(line[i + 1]))) {
      out.back() += line[++i];
    } else if (quote != 0 ? c == quote : c == '\'' || c == '"') {
      quote = quote != 0 ? '\0' : c;
    } else if (quote == 0 && (c == ' ' || c == '\t' || c == '\n')) {
      if (begun) out.emplace_back();
      begun = false;
      continue;
    } else if (c != '\\' || quote != 0) {
      out.back() += c;
    }
    begun = true;
  }
  return out;
}

std::string completion_answer(CLI::App& app, std::span<const std::string> question, const Values& values) {
  const bool by_line = question.size() == 3 && question[0] == "bash";
  if (!by_line && (question.size() < 2 || question[0] != "words")) return "words\n";
  std::vector<std::string> words(question.begin() + 1, question.end());
  std::size_t typed = 0;
  if (by_line) {
    words = words_of_line(question[2]);
    words.erase(words.begin());  // the program
    if (words.empty()) return "words\n";
    const auto seen = words_of_line(question[1]).back();
    if (words.back().ends_with(seen)) typed = words.back().size() - seen.size();
  }
  const auto found = complete(app, std::span(words).first(words.size() - 1), words.back(), values);
  if (found.kind != Completion::Kind::words && found.words.empty())
    return found.kind == Completion::Kind::files ? "files\n" : "folders\n";
  const bool open = !found.words.empty() && std::ranges::all_of(found.words, [](const Candidate& each) {
    return each.word.ends_with('/') || each.word.ends_with('=');
  });
  std::string out = open ? "open\n" : "words\n";
  for (const auto& each : found.words) {
    out += one_line(each.word.substr(std::min(typed, each.word.size())));
    if (!by_line && !each.about.empty()) out += "\t" + one_line(each.about);
    out += '\n';
  }
  return out;
}

}  // namespace conform::usage
