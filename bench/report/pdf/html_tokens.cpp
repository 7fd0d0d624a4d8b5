#include "bench/report/pdf/html_tokens.hpp"

#include <algorithm>

namespace rvbench::bench::pdf {
namespace {

constexpr std::string_view picture_end = "</svg>";

// class="note" → "note"
std::string class_in(std::string_view tag) {
  constexpr std::string_view key = "class=\"";
  const std::size_t found = tag.find(key);
  if (found == std::string_view::npos) return "";
  const std::string_view rest = tag.substr(found + key.size());
  return std::string(rest.substr(0, rest.find('"')));
}

// @param tag  what is between < and >
HtmlToken tag_of(std::string_view tag) {
  const bool closes = tag.starts_with('/');
  const std::string_view body = closes ? tag.substr(1) : tag;
  const std::size_t end = std::min(body.find_first_of(" \n/"), body.size());
  return {closes ? HtmlToken::Kind::close : HtmlToken::Kind::open, std::string(body.substr(0, end)),
          class_in(tag), ""};
}

}  // namespace

std::vector<HtmlToken> tokens_of(std::string_view html) {
  std::vector<HtmlToken> tokens;
  while (!html.empty()) {
    if (html.starts_with("<svg ")) {
      const std::size_t end = std::min(html.find(picture_end), html.size() - picture_end.size());
      const std::size_t length = end + picture_end.size();
      tokens.push_back({HtmlToken::Kind::picture, "svg", "", std::string(html.substr(0, length))});
      html.remove_prefix(length);
    } else if (html.starts_with('<')) {
      const std::size_t end = std::min(html.find('>'), html.size() - 1);
      tokens.push_back(tag_of(html.substr(1, end - 1)));
      html.remove_prefix(end + 1);
    } else {
      const std::size_t length = std::min(html.find('<'), html.size());
      tokens.push_back({HtmlToken::Kind::text, "", "", std::string(html.substr(0, length))});
      html.remove_prefix(length);
    }
  }
  return tokens;
}

}  // namespace rvbench::bench::pdf
