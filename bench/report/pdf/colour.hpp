#pragma once

#include <cairo.h>

namespace rvbench::bench::pdf {

/// As in the page's style sheet.
namespace colours {
inline constexpr const char* ink = "#1c2530";
inline constexpr const char* faint = "#5b6876";
inline constexpr const char* line = "#d3dae1";
inline constexpr const char* head = "#eef2f5";
inline constexpr const char* good = "#1b7f3b";
inline constexpr const char* bad = "#b3261e";
inline constexpr const char* warn = "#9a6700";
}  // namespace colours

/// @param colour  "#rrggbb"
void use_colour(cairo_t* page, const char* colour);

/// A filled rectangle.
void fill_box(cairo_t* page, const char* colour, double x_pt, double y_pt, double width_pt,
              double height_pt);

}  // namespace rvbench::bench::pdf
