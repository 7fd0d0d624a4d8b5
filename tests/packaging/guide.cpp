#include "tests/packaging/guide.hpp"

#include <algorithm>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "bench/command.hpp"

namespace rvbench::test {
namespace {

Kind kind_of(const std::string& fence) {
  if (fence == "```sh") return Kind::now;
  if (fence == "```sh beside") return Kind::beside;
  if (fence == "```sh by-hand") return Kind::by_hand;
  throw std::runtime_error("a block of no known kind: " + fence);
}

GuideLine as_line(Kind kind, const std::string& text) {
  static const std::regex comment("(.*?) +# exit code ([0-9]+)");
  std::smatch parts;
  if (std::regex_match(text, parts, comment)) return {kind, parts[1], std::stoi(parts[2])};
  return {kind, text, 0};
}

}  // namespace

std::vector<GuideLine> guide_lines(const std::string& text) {
  std::vector<GuideLine> found;
  std::istringstream lines(text);
  for (std::string fence; std::getline(lines, fence);) {
    if (!fence.starts_with("```")) continue;
    const bool is_shell = fence.starts_with("```sh");
    std::string line, command;
    while (std::getline(lines, line) && line != "```") {
      const bool goes_on = line.ends_with('\\');
      command += goes_on ? line.substr(0, line.size() - 1) : line;
      if (goes_on) continue;
      if (is_shell && !command.empty()) found.push_back(as_line(kind_of(fence), command));
      command.clear();
    }
    if (line != "```") throw std::runtime_error("a block that does not end: " + fence);
  }
  return found;
}

std::string unknown_words(const std::string& command) {
  std::istringstream words(command);
  std::string word;
  while (words >> word && word != "rvbench") {
  }
  if (!(words >> word) || word.starts_with("-")) return "";
  for (const auto& known : bench::make_commands()) {
    if (known->name() != word) continue;
    const auto options = known->options();
    std::string unknown;
    while (words >> word && word != "|" && word != "#" && word != "&&") {
      const bool is_known = std::ranges::any_of(
          options, [&](const bench::Option& option) { return option.name == word; });
      if (word.starts_with("--") && !is_known) unknown += word + ' ';
    }
    return unknown;
  }
  return word;
}

}  // namespace rvbench::test
