#pragma once

#include <string>
#include <vector>

#include "bench/report/pdf/block.hpp"
#include "bench/report/pdf/typesetter.hpp"
#include "hal/types/outcome.hpp"

namespace rvbench::bench::pdf {

/// A4, upright: what is left of it between margins, header and footer.
inline constexpr double body_width_pt = 515;
inline constexpr double body_height_pt = 742;

/// What stands on every page, and in the file's own description. Plain text.
struct PageFrame {
  std::string title;    ///< of the file
  std::string unit;     ///< at the head
  std::string source;   ///< at the foot
  std::string created;  ///< "2026-01-02T03:04:05Z"
  Outcome outcome = Outcome::error;
};

/// Lays out parts, each from a new page on, and returns the PDF: for the same parts and frame the
/// same bytes.
///
/// Errors  throws std::runtime_error if cairo cannot draw
std::string make_pages(const Typesetter& typesetter, const std::vector<Blocks>& parts,
                       const PageFrame& frame);

}  // namespace rvbench::bench::pdf
