#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/report/pdf/block.hpp"
#include "bench/report/pdf/colour.hpp"

struct _PangoContext;
struct _PangoFontMap;
struct _PangoLayout;

namespace rvbench::bench::pdf {

struct TextStyle {
  double size_pt = 8.5;
  bool bold = false;
  bool mono = false;
  const char* colour = colours::ink;
};

/// A line of set text.
struct TextLine {
  std::shared_ptr<_PangoLayout> layout;
  int number = 0;  ///< in it
  double height_pt = 0, baseline_pt = 0, width_pt = 0;

  void draw(cairo_t* page, double x_pt, double y_pt) const;
};

/// Sets text in the fonts that fontconfig knows, with others where a character is not in the first.
///
/// Text is Pango's markup: what comes from outside passes through xml_escaped().
class Typesetter {
 public:
  Typesetter();

  /// Whether there is any font at all: without, nothing can be set.
  bool has_fonts() const;

  /// Broken to a width, inside of words if it must be.
  /// @param most_lines  what is beyond becomes "…", and line breaks of its own spaces; 0: all
  std::vector<TextLine> lines(const std::string& markup, const TextStyle& style, double width_pt,
                              int most_lines = 0) const;

  /// The same as blocks.
  Blocks text(const std::string& markup, const TextStyle& style, double width_pt,
              int most_lines = 0) const;

  /// Of one line that is not broken.
  double width_pt(const std::string& markup, const TextStyle& style) const;

  /// Whether a character was set that no font has.
  bool lacks_characters() const { return lacks_characters_; }

 private:
  std::shared_ptr<_PangoLayout> layout_of(const std::string& markup, const TextStyle& style) const;

  std::shared_ptr<_PangoFontMap> fonts_;
  std::shared_ptr<_PangoContext> context_;
  mutable bool lacks_characters_ = false;
};

}  // namespace rvbench::bench::pdf
