#include "bench/examples/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace rvbench::bench {

using analysis::examples::Example;
using analysis::examples::Figure;

namespace {

constexpr std::size_t line_width = 98;

// As a paragraph.
std::string wrapped(const std::string& text) {
  std::istringstream words(text);
  std::string result, line, word;
  while (words >> word) {
    if (!line.empty() && line.size() + 1 + word.size() > line_width) {
      result += line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return result + line + "\n";
}

// The lines without what all of them begin with.
std::string to_the_left(const std::vector<std::string>& lines) {
  std::size_t indent = std::string::npos;
  for (const std::string& line : lines) indent = std::min(indent, line.find_first_not_of(' '));
  std::string text;
  for (const std::string& line : lines) {
    text += (line.size() > indent ? line.substr(indent) : "") + "\n";
  }
  return text;
}

}  // namespace

std::string shown_lines(const std::string& source) {
  std::istringstream text(source);
  std::string line, shown;
  std::vector<std::string> stretch;
  bool is_shown = false;
  while (std::getline(text, line)) {
    if (line.find("//! [page]") == std::string::npos) {
      if (is_shown) stretch.push_back(line);
      continue;
    }
    is_shown = !is_shown;
    if (is_shown) continue;
    shown += (shown.empty() ? "" : "\n") + to_the_left(stretch);
    stretch.clear();
  }
  return shown;
}

std::string page_of(const Example& example, const std::string& source) {
  std::string page =
      fmt::format("# {}\n\n{}\n![{}]({}.svg)\n\n```cpp\n{}```\n\n", example.title,
                  wrapped(example.text), example.title, example.name, shown_lines(source));
  page += "| | known | found |\n|---|---|---|\n";
  for (const Figure& figure : example.figures) {
    page += fmt::format("| {} | {} | {} |\n", figure.what, figure.known, figure.found);
  }
  std::string headers;
  for (const std::string& header : example.headers) {
    headers += fmt::format("{}[{}](../{})", headers.empty() ? "" : ", ", header, header);
  }
  return page + "\n" +
         wrapped(fmt::format("Shape, units, errors and source of each function: {}. All of the "
                             "example: [{}.cpp]({}.cpp).",
                             headers, example.name, example.name));
}

std::string index_of(const std::vector<Example>& examples) {
  std::string page =
      "# examples: each method at work on a signal that is known\n\n"
      "Written by `build/release/rvbench_examples analysis/examples`; a test holds them to what it "
      "writes.\nA new one is a source file here, a line in `examples.hpp` and in "
      "`example.cpp`.\n\n";
  for (const Example& example : examples) {
    page += fmt::format("* [{}]({}.md)\n", example.title, example.name);
  }
  return page;
}

}  // namespace rvbench::bench
