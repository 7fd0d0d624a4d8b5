#include "bench/report/pdf/html_blocks.hpp"

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bench/report/pdf/figures.hpp"
#include "bench/report/pdf/html_tokens.hpp"
#include "bench/report/pdf/table.hpp"

namespace rvbench::bench::pdf {
namespace {

struct Manner {
  TextStyle style;
  double above_pt = 0, below_pt = 0;
  bool keeps_next = false;
};

const Manner heading{{.size_pt = 12, .bold = true}, 12, 3, true};
const Manner subheading{{.size_pt = 9.5, .bold = true}, 7, 2, true};
const Manner plain{{}, 1.5, 3};
const Manner aside{{.size_pt = 7.5, .colour = colours::faint}, 1, 3};
const Manner verbatim{{.size_pt = 6.5, .mono = true}, 1, 3};
const TextStyle in_tables{.size_pt = 7.5};

// Goes through a section once; text gathers until the tag that ends it says what it was.
class SectionSetter {
 public:
  SectionSetter(const Typesetter& typesetter, double width_pt)
      : typesetter_(typesetter), width_pt_(width_pt) {}

  void take(const HtmlToken& token) {
    using enum HtmlToken::Kind;
    if (token.kind != picture && !(token.kind == text && is_blank(token.text))) {
      if (!is_of_figures(token)) set_figures();
    }
    switch (token.kind) {
      case text: markup_ += verbatim_ ? token.text : without_breaks(token.text); break;
      case picture: figures_.push_back(token.text); break;
      case open: begin(token); break;
      case close: end(token.name); break;
    }
  }

  Blocks blocks() && {
    set_text(plain);
    set_figures();
    return std::move(blocks_);
  }

 private:
  static bool is_blank(const std::string& text) {
    return text.find_first_not_of(" \n\t") == std::string::npos;
  }
  static bool is_of_figures(const HtmlToken& token) { return token.name == "figure"; }

  static std::string without_breaks(std::string text) {
    for (char& c : text) c = c == '\n' ? ' ' : c;
    return text;
  }

  void begin(const HtmlToken& tag) {
    if (tag.name == "b") {
      markup_ += "<b>";
    } else if (tag.name == "br") {
      markup_ += "\n";
    } else if (tag.name == "span") {
      spans_.push_back(tag.style == "hash" ? "</tt>" : "");
      markup_ += tag.style == "hash" ? "<tt>" : "";
    } else if (tag.name != "td" && tag.name != "th" && tag.name != "dt" && tag.name != "dd") {
      set_text(plain);
    }
    if (tag.name == "table" || tag.name == "dl") table_ = {};
    if (tag.name == "pre") verbatim_ = true;
    if (tag.name == "p") is_note_ = tag.style == "note";
  }

  void end(const std::string& name) {
    if (name == "b") markup_ += "</b>";
    if (name == "span" && !spans_.empty()) {
      markup_ += spans_.back();
      spans_.pop_back();
    }
    if (name == "td" || name == "th" || name == "dt" || name == "dd") {
      cells_.push_back(std::exchange(markup_, ""));
    }
    if (name == "dt") cells_.back() = "<b>" + cells_.back() + "</b>";
    if (name == "thead") table_.head = std::exchange(cells_, {});
    if (name == "dd" || (name == "tr" && !cells_.empty() && has_head())) {
      table_.rows.push_back(std::exchange(cells_, {}));
    }
    if (name == "table" || name == "dl") set_table();
    if (name == "pre") verbatim_ = false;
    const auto manner = manners().find(name);
    if (manner != manners().end()) set_text(name == "p" && is_note_ ? aside : manner->second);
  }

  static const std::map<std::string, Manner>& manners() {
    static const std::map<std::string, Manner> all{
        {"h1", heading}, {"h2", heading},   {"h3", subheading}, {"p", plain},      {"li", plain},
        {"div", plain},  {"pre", verbatim}, {"section", plain}, {"summary", plain}};
    return all;
  }

  // The cells of a head are one row until </thead>.
  bool has_head() const { return !table_.head.empty(); }

  void set_text(const Manner& manner) {
    const std::string markup = std::exchange(markup_, "");
    if (is_blank(markup)) return;
    Blocks lines = typesetter_.text(markup, manner.style, width_pt_);
    if (!blocks_.empty()) blocks_.push_back(space(manner.above_pt));
    for (Block& line : lines) line.keeps_next = manner.keeps_next;
    append(blocks_, lines);
    blocks_.push_back(space(manner.below_pt));
    blocks_.back().keeps_next = manner.keeps_next;
  }

  void set_table() {
    append(blocks_, table_blocks(typesetter_, table_, in_tables, width_pt_));
    blocks_.push_back(space(4));
    table_ = {};
  }

  void set_figures() {
    if (figures_.empty()) return;
    append(blocks_, figure_rows(std::exchange(figures_, {}), width_pt_, 2));
  }

  const Typesetter& typesetter_;
  double width_pt_;
  Blocks blocks_;
  std::string markup_;
  std::vector<std::string> spans_;  // what ends those that are open
  std::vector<std::string> figures_, cells_;
  Table table_;
  bool verbatim_ = false, is_note_ = false;
};

}  // namespace

Blocks html_blocks(const Typesetter& typesetter, std::string_view html, double width_pt) {
  SectionSetter setter(typesetter, width_pt);
  for (const HtmlToken& token : tokens_of(html)) setter.take(token);
  return std::move(setter).blocks();
}

}  // namespace rvbench::bench::pdf
