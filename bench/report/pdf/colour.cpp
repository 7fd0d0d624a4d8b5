#include "bench/report/pdf/colour.hpp"

#include <cstdlib>

namespace rvbench::bench::pdf {

void use_colour(cairo_t* page, const char* colour) {
  const auto rgb = static_cast<unsigned>(std::strtoul(colour + 1, nullptr, 16));
  const auto share = [rgb](unsigned shift) { return ((rgb >> shift) & 0xffU) / 255.0; };
  cairo_set_source_rgb(page, share(16), share(8), share(0));
}

void fill_box(cairo_t* page, const char* colour, double x_pt, double y_pt, double width_pt,
              double height_pt) {
  use_colour(page, colour);
  cairo_rectangle(page, x_pt, y_pt, width_pt, height_pt);
  cairo_fill(page);
}

}  // namespace rvbench::bench::pdf
