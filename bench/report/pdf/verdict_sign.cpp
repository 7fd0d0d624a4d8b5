#include "bench/report/pdf/verdict_sign.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "bench/report/pdf/colour.hpp"
#include "hal/types/units.hpp"

namespace rvbench::bench::pdf {
namespace {

using Points = std::vector<std::pair<double, double>>;  // in a square from -1 to 1, y downwards

void trace(cairo_t* page, const Points& points) {
  cairo_new_sub_path(page);
  for (const auto& [x, y] : points) cairo_line_to(page, x, y);
}

void stroke(cairo_t* page, const Points& points) {
  trace(page, points);
  cairo_stroke(page);
}

Points polygon(int corners, double first_turn) {
  Points points;
  for (int i = 0; i < corners; ++i) {
    const double angle = units::two_pi * (first_turn + double(i) / corners);
    points.emplace_back(std::cos(angle), std::sin(angle));
  }
  return points;
}

Points outline_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::pass: return polygon(90, 0);
    case Outcome::fail: return polygon(8, 1 / 16.0);
    case Outcome::invalid: return {{0, -0.95}, {1, 0.85}, {-1, 0.85}};
    case Outcome::aborted: return {{-0.9, -0.9}, {0.9, -0.9}, {0.9, 0.9}, {-0.9, 0.9}};
    case Outcome::error: break;
  }
  return polygon(4, 0);
}

void draw_mark(cairo_t* page, Outcome outcome) {
  switch (outcome) {
    case Outcome::pass: return stroke(page, {{-0.45, 0.05}, {-0.1, 0.4}, {0.5, -0.35}});
    case Outcome::fail:
      stroke(page, {{-0.38, -0.38}, {0.38, 0.38}});
      return stroke(page, {{-0.38, 0.38}, {0.38, -0.38}});
    case Outcome::aborted: return stroke(page, {{-0.5, 0}, {0.5, 0}});
    default: break;
  }
  stroke(page, {{0, -0.32}, {0, 0.25}});
  stroke(page, {{0, 0.55}, {0, 0.56}});  // a dot, by its round ends
}

}  // namespace

const char* colour_of(Outcome outcome) {
  if (outcome == Outcome::pass) return colours::good;
  return outcome == Outcome::fail ? colours::bad : colours::warn;
}

void draw_sign(cairo_t* page, Outcome outcome, double x_pt, double y_pt, double size_pt) {
  cairo_save(page);
  cairo_translate(page, x_pt + size_pt / 2, y_pt + size_pt / 2);
  cairo_scale(page, size_pt / 2, size_pt / 2);
  use_colour(page, colour_of(outcome));
  trace(page, outline_of(outcome));
  cairo_close_path(page);
  cairo_fill(page);
  cairo_set_line_width(page, 0.2);
  cairo_set_line_cap(page, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(page, CAIRO_LINE_JOIN_ROUND);
  use_colour(page, "#ffffff");
  draw_mark(page, outcome);
  cairo_restore(page);
}

}  // namespace rvbench::bench::pdf
