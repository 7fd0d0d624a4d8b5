#include "bench/manual/bash_completion.hpp"

#include <fmt/format.h>

namespace rvbench::bench {
namespace {

// "--speed=9" comes as three words, as '=' is in COMP_WORDBREAKS.
constexpr const char* script =
    R"(# Completes rvbench's commands and options. Made of the commands themselves; do not edit.
_rvbench() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}}
  local command=${{COMP_WORDS[1]}} words=""
  if [[ $word == = ]]; then
    word=""
  elif [[ $before == = ]]; then
    before=${{COMP_WORDS[COMP_CWORD - 2]}}
  fi
  COMPREPLY=()
  if (( COMP_CWORD == 1 )); then
    words="{commands} --help --version"
  else
    case "$command $before" in
{values}      *)
        case $command in
{options}        esac ;;
    esac
  fi
  COMPREPLY=($(compgen -W "$words" -- "$word"))
}}
complete -o default -F _rvbench rvbench
)";

std::string joined(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + word;
  return line;
}

std::vector<std::string> values_of(const Option& option, const BuiltInValues& built_in) {
  if (!option.choices.empty()) return option.choices;
  const auto known = built_in.find(option.name);
  return known == built_in.end() ? std::vector<std::string>() : known->second;
}

}  // namespace

std::string bash_completion(const std::vector<std::unique_ptr<Command>>& commands,
                            const BuiltInValues& built_in) {
  std::vector<std::string> names;
  std::string values, options;
  for (const auto& command : commands) {
    const std::string name = command->name();
    std::string switches = "--help", arguments;
    for (const Option& option : command->options()) {
      const std::string known = joined(values_of(option, built_in));
      if (!option.name.starts_with("--")) {
        arguments += known;
        continue;
      }
      switches += ' ' + option.name;
      if (std::holds_alternative<bool*>(option.target)) continue;
      values += fmt::format("      \"{} {}\") words=\"{}\" ;;\n", name, option.name, known);
    }
    options += fmt::format("          {}) words=\"{}\"; [[ $word == -* ]] && words=\"{}\" ;;\n",
                           name, arguments, switches);
    names.push_back(name);
  }
  return fmt::format(script, fmt::arg("commands", joined(names)), fmt::arg("values", values),
                     fmt::arg("options", options));
}

}  // namespace rvbench::bench
