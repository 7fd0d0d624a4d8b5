#include "bench/report/pdf/typesetter.hpp"

#include <fmt/format.h>
#include <pango/pangocairo.h>

namespace rvbench::bench::pdf {
namespace {

template <typename Object>
std::shared_ptr<Object> owned(Object* object) {
  return std::shared_ptr<Object>(object, [](Object* last) { g_object_unref(last); });
}

double pt(int pango_units) { return static_cast<double>(pango_units) / PANGO_SCALE; }

int pango_units(double pt) { return static_cast<int>(pt * PANGO_SCALE); }

// Paper has no pixels to fit glyphs to.
void set_for_paper(PangoContext* context) {
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  pango_cairo_context_set_font_options(context, options);
  cairo_font_options_destroy(options);
  pango_cairo_context_set_resolution(context, 72);  // 1 pt is 1/72 in
  pango_context_set_round_glyph_positions(context, FALSE);
  // Which font stands in for a Chinese character must not depend on who prints.
  pango_context_set_language(context, pango_language_from_string("en"));
}

}  // namespace

void TextLine::draw(cairo_t* page, double x_pt, double y_pt) const {
  cairo_move_to(page, x_pt, y_pt + baseline_pt);
  pango_cairo_show_layout_line(page, pango_layout_get_line_readonly(layout.get(), number));
}

Typesetter::Typesetter()
    : fonts_(owned(pango_cairo_font_map_new())),
      context_(owned(pango_font_map_create_context(fonts_.get()))) {
  set_for_paper(context_.get());
}

bool Typesetter::has_fonts() const {
  PangoFontFamily** families = nullptr;
  int count = 0;
  pango_font_map_list_families(fonts_.get(), &families, &count);
  // Pango lists names that fontconfig makes up; a font that can be loaded has a face.
  bool found = false;
  for (int i = 0; i < count && !found; ++i) {
    PangoFontFace** faces = nullptr;
    int face_count = 0;
    pango_font_family_list_faces(families[i], &faces, &face_count);
    for (int f = 0; f < face_count && !found; ++f) {
      found = pango_font_face_is_synthesized(faces[f]) == FALSE;
    }
    g_free(faces);
  }
  g_free(families);
  return found;
}

std::shared_ptr<PangoLayout> Typesetter::layout_of(const std::string& markup,
                                                   const TextStyle& style) const {
  auto layout = owned(pango_layout_new(context_.get()));
  PangoFontDescription* font = pango_font_description_new();
  pango_font_description_set_family_static(font, style.mono ? "monospace" : "sans-serif");
  pango_font_description_set_weight(font, style.bold ? PANGO_WEIGHT_BOLD : PANGO_WEIGHT_NORMAL);
  pango_font_description_set_absolute_size(font, style.size_pt * PANGO_SCALE);
  pango_layout_set_font_description(layout.get(), font);
  pango_font_description_free(font);
  const std::string spanned = fmt::format(
      "<span insert_hyphens=\"false\" foreground=\"{}\">{}</span>", style.colour, markup);
  pango_layout_set_wrap(layout.get(), PANGO_WRAP_WORD_CHAR);
  pango_layout_set_markup(layout.get(), spanned.data(), static_cast<int>(spanned.size()));
  return layout;
}

std::vector<TextLine> Typesetter::lines(const std::string& markup, const TextStyle& style,
                                        double width_pt, int most_lines) const {
  const auto layout = layout_of(markup, style);
  pango_layout_set_width(layout.get(), pango_units(width_pt));
  if (most_lines > 0) {
    pango_layout_set_single_paragraph_mode(layout.get(), TRUE);
    pango_layout_set_height(layout.get(), -most_lines);
    pango_layout_set_ellipsize(layout.get(), PANGO_ELLIPSIZE_END);
  }
  lacks_characters_ |= pango_layout_get_unknown_glyphs_count(layout.get()) > 0;
  std::vector<TextLine> lines;
  PangoLayoutIter* at = pango_layout_get_iter(layout.get());
  do {
    PangoRectangle box;
    pango_layout_iter_get_line_extents(at, nullptr, &box);
    lines.push_back({layout, static_cast<int>(lines.size()), pt(box.height),
                     pt(pango_layout_iter_get_baseline(at) - box.y), pt(box.width)});
  } while (pango_layout_iter_next_line(at) != FALSE);
  pango_layout_iter_free(at);
  return lines;
}

Blocks Typesetter::text(const std::string& markup, const TextStyle& style, double width_pt,
                        int most_lines) const {
  Blocks blocks;
  for (const TextLine& line : lines(markup, style, width_pt, most_lines)) {
    blocks.push_back({line.height_pt, [line](cairo_t* page, double x_pt, double y_pt) {
                        line.draw(page, x_pt, y_pt);
                      }});
  }
  return blocks;
}

double Typesetter::width_pt(const std::string& markup, const TextStyle& style) const {
  const auto layout = layout_of(markup, style);
  PangoRectangle box;
  pango_layout_get_extents(layout.get(), nullptr, &box);
  return pt(box.width);
}

}  // namespace rvbench::bench::pdf
