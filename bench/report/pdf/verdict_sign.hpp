#pragma once

#include <cairo.h>

#include "hal/types/outcome.hpp"

namespace rvbench::bench::pdf {

/// The colour of a verdict, as "#rrggbb".
const char* colour_of(Outcome outcome);

/// A verdict by its shape, for those who do not tell its colour: PASS a disc with a tick, FAIL an
/// octagon with a cross, INVALID a triangle, ERROR a diamond, each with "!", ABORTED a square with
/// a bar.
void draw_sign(cairo_t* page, Outcome outcome, double x_pt, double y_pt, double size_pt);

}  // namespace rvbench::bench::pdf
