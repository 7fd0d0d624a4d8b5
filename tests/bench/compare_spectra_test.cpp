#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <string>

#include "bench/compare_sections.hpp"

namespace rvbench::bench::report {
namespace {

using Catch::Contains;

// One line that changed by 6 dB, from 0.1 to 0.2 m/s², at each of the points.
analysis::Comparison changed_at(std::size_t points) {
  analysis::Comparison comparison;
  comparison.quantities.resize(1);
  comparison.quantities[0].name = "input shaft";
  comparison.quantities[0].order = 1;
  comparison.channels.resize(1);
  comparison.channels[0] = {"accel_1x", "m/s²", "+X", not_known};
  for (std::size_t point = 0; point < points; ++point) {
    analysis::MatchedPoint matched;
    matched.a.speed_rpm = matched.b.speed_rpm = 600 + 100 * double(point);
    matched.a.load_pct = matched.b.load_pct = 50;
    comparison.points.push_back(matched);
    analysis::Change change;
    change.point = point;
    change.a_dB = -20;
    change.b_dB = -14;
    change.change_dB = 6;
    change.seen = true;
    change.word = analysis::ChangeWord::changed;
    comparison.changes.push_back(change);
  }
  return comparison;
}

std::string section_of(const analysis::Comparison& comparison) {
  const analysis::Spectrum flat{0.1, Eigen::VectorXd::Constant(101, 0.1)};
  return compare_spectra_section(comparison, {}, [&](std::size_t, const std::string&) {
    return SpectrumPair{flat, flat};
  });
}

}  // namespace

TEST_CASE("spectra of more changed points than are shown say how many there are", "[bench]") {
  CHECK_THAT(section_of(changed_at(8)),
             Contains("Lines changed at 8 points; shown are 6 of them."));
  CHECK_THAT(section_of(changed_at(6)), Contains("1100 rpm") && !Contains("Lines changed at"));
}

}  // namespace rvbench::bench::report
