#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rvbench::bench::pdf {

/// A piece of a report's section.
struct HtmlToken {
  enum class Kind { text, open, close, picture };
  Kind kind = Kind::text;
  std::string name;   ///< of a tag: "td"
  std::string style;  ///< its class; empty: none
  std::string text;   ///< between tags, its entities as they are; of a picture the whole <svg>
};

/// Parts the HTML that our own sections are made of; it is no reader of pages from elsewhere.
std::vector<HtmlToken> tokens_of(std::string_view html);

}  // namespace rvbench::bench::pdf
