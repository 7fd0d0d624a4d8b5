#include "bench/report/pdf/figures.hpp"

#include <librsvg/rsvg.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "bench/report/sections.hpp"

namespace rvbench::bench::pdf {
namespace {

constexpr double gap_pt = 8;

// On paper a plot is half as wide as on a screen.
constexpr const char* larger_text =
    "svg, svg text { font-family: sans-serif; } svg text { font-size: 12.5px; }"
    "svg .title { font-size: 13px; } svg .marklabel, svg .ownlabel { font-size: 10.5px; }";

struct Unref {
  void operator()(RsvgHandle* handle) const noexcept { g_object_unref(handle); }
};

[[noreturn]] void give_up(GError* error) {
  const std::string why = error == nullptr ? "unknown" : error->message;
  if (error != nullptr) g_error_free(error);
  throw std::invalid_argument("figure_rows: no plot: " + why);
}

const guint8* bytes_of(const std::string& text) {
  return reinterpret_cast<const guint8*>(text.data());
}

// Inline in HTML it needs no namespace, alone it does; nor does it know the page's style.
std::shared_ptr<RsvgHandle> plot_of(std::string svg) {
  svg.replace(0, 4, "<svg xmlns=\"http://www.w3.org/2000/svg\"");
  GError* error = nullptr;
  RsvgHandle* handle = rsvg_handle_new_from_data(bytes_of(svg), svg.size(), &error);
  if (handle == nullptr) give_up(error);
  std::shared_ptr<RsvgHandle> plot(handle, Unref());
  const std::string style = report::plot_style_sheet() + larger_text;
  if (!rsvg_handle_set_stylesheet(handle, bytes_of(style), style.size(), &error)) give_up(error);
  return plot;
}

// Height over width, of its viewBox.
double aspect_of(RsvgHandle* plot) {
  gboolean has_width = FALSE, has_height = FALSE, has_box = FALSE;
  RsvgLength width, height;
  RsvgRectangle box{};
  rsvg_handle_get_intrinsic_dimensions(plot, &has_width, &width, &has_height, &height, &has_box,
                                       &box);
  return has_box && box.width > 0 ? box.height / box.width : 0.5;
}

Block figure(const std::string& svg, double width_pt) {
  const auto plot = plot_of(svg);
  const double height_pt = width_pt * aspect_of(plot.get());
  return {height_pt, [=](cairo_t* page, double x_pt, double y_pt) {
            const RsvgRectangle place{x_pt, y_pt, width_pt, height_pt};
            GError* error = nullptr;
            if (!rsvg_handle_render_document(plot.get(), page, &place, &error)) give_up(error);
          }};
}

}  // namespace

Blocks figure_rows(const std::vector<std::string>& figures, double width_pt, int per_row) {
  const double each_pt = (width_pt - gap_pt * (per_row - 1)) / per_row;
  const auto count = static_cast<std::size_t>(per_row);
  Blocks rows;
  for (std::size_t first = 0; first < figures.size(); first += count) {
    Blocks row;
    double height_pt = 0;
    for (std::size_t i = first; i < std::min(first + count, figures.size()); ++i) {
      row.push_back(figure(figures[i], each_pt));
      height_pt = std::max(height_pt, row.back().height_pt);
    }
    rows.push_back({height_pt + 2, [=](cairo_t* page, double x_pt, double y_pt) {
                      for (const Block& one : row) {
                        one.draw(page, x_pt, y_pt);
                        x_pt += each_pt + gap_pt;
                      }
                    }});
  }
  return rows;
}

}  // namespace rvbench::bench::pdf
