#include <algorithm>
#include <cmath>

#include "analysis/diagnosis.hpp"
#include "analysis/examples/examples.hpp"
#include "analysis/examples/signals.hpp"
#include "analysis/rv_reducer.hpp"
#include "hal/types/units.hpp"

namespace rvbench::analysis::examples {
namespace {

// A reducer of ratio 21 at 20 rev/s, eight turns of its output: a mesh whose amplitude its bent
// input shaft swings, in noise. The encoder stands beside it.
Recording record_of(double load_pct, const Eigen::VectorXd& vibration) {
  const Eigen::VectorXd angle_rad = units::two_pi * 20 * times_s(10760, 1280);
  Recording record;
  record.source = rounded(load_pct, 0) + " %";
  record.speed_rpm = 1200;
  record.load_pct = load_pct;
  record.channels = {{{"accel_1x", "m/s²", "+X", not_known}, 1280, 0, vibration},
                     {{"input_angle", "rad", "", not_known}, 1280, 0, angle_rad}};
  return record;
}

std::string named(const Finding& f) { return f.component + ": " + f.mechanism; }

// The five likeliest.
Bars drawn(const Diagnosis& found) {
  Bars picture{"How much better than noise the likeliest parts explain the four records",
               {"log10(1 + ln ratio)", 0, 4},
               {"ln likelihood ratio"},
               {}};
  for (const Finding* hypothesis : found.hypotheses()) {
    if (picture.groups.size() == 5) break;
    const double ratio = std::max(hypothesis->log_likelihood_ratio, 0.0);
    picture.groups.push_back({hypothesis->component, {std::log10(1 + ratio)}});
  }
  return picture;
}

}  // namespace

Example evidence_example() {
  //! [page]
  const Kinematics reducer = rv_reducer("small", {12, 24, 2, 9, 10}, {11, 5, 26, 0});
  const Eigen::ArrayXd turns = 20 * times_s(10760, 1280);
  std::vector<Examination> points;
  for (const double load_pct : {25.0, 50.0, 100.0, 150.0}) {
    const Eigen::ArrayXd swing = 1 + 0.5 * wave(20.0 / 21 * turns).array();
    const Eigen::VectorXd x = swing * wave(240.0 / 21 * turns).array() +
                              0.2 * noise(10760, static_cast<unsigned>(load_pct)).array();
    points.push_back(examine(record_of(load_pct, x), reducer));
  }
  const Diagnosis found = conclude(points, reducer);
  //! [page]
  const Finding& first = found.findings.at(0);
  const Finding& second = *found.second();
  return {"evidence",
          "Evidence: which part explains the records",
          "A bent input shaft swings the amplitude of a mesh line by 0.5, alike at four loads, in "
          "noise. Each part's own lines are weighed against noise over all records and channels, "
          "and against lines that no gear reaches: that gives p. One of the two sidebands is a "
          "line of the pins as well and is left out, so the depth is 0.5/√2. For a part that does "
          "not show, the depth is stated that would have been visible.",
          {"diagnosis.hpp", "evidence/own_lines.hpp", "evidence/gear_evidence.hpp",
           "evidence/growth_law.hpp", "evidence/severity.hpp"},
          {{"findings", "1", std::to_string(found.findings.size())},
           {"part and mechanism", "input_shaft: misalignment", named(first)},
           {"depth of the swing", "0.354", rounded(first.severity, 3)},
           {"p-value", "–", p_value_text(first.p_value)},
           {"exponent of the load", "0.00",
            rounded(first.growth.load.exponent, 2) + " ± " + rounded(first.growth.load.error, 2)},
           {"fits a misalignment", "yes", first.growth_fits ? "yes" : "no"},
           {"second hypothesis, which is not shown", "–", named(second)},
           {"its depth", "0.000", "below " + rounded(second.severity_high, 3)}},
          {drawn(found)}};
}

}  // namespace rvbench::analysis::examples
