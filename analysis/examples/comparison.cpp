#include "analysis/compare/comparison.hpp"

#include <algorithm>

#include "analysis/examples/examples.hpp"
#include "analysis/examples/signals.hpp"
#include "analysis/gear_train.hpp"
#include "hal/types/units.hpp"

namespace rvbench::analysis::examples {
namespace {

// A gear of 20 teeth at 20 rev/s over 200 turns, with an encoder.
Recording record_of(const Eigen::VectorXd& vibration) {
  const Eigen::VectorXd angle_rad = units::two_pi * 20 * times_s(20000, 2000);
  Recording record;
  record.source = "one of the repeats";
  record.speed_rpm = 1200;
  record.load_pct = 100;
  record.channels = {{{"accel_1x", "m/s²", "+X", not_known}, 2000, 0, vibration},
                     {{"input_angle", "rad", "", not_known}, 2000, 0, angle_rad}};
  return record;
}

const Change& change_of(const Comparison& found, const std::string& name) {
  return *std::ranges::find_if(found.changes, [&](const Change& change) {
    return found.quantities[change.quantity].name == name;
  });
}

std::string told(const Change& change) {
  return rounded(change.change_dB, 1) + " ± " + rounded(change.uncertainty_dB, 1) + ", " +
         (change.word == ChangeWord::changed ? "changed" : "not changed");
}

}  // namespace

Example comparison_example() {
  //! [page]
  GearTrain train;
  train.machine = "one gear";
  train.shafts = {{"input shaft", "input_shaft"}};
  train.meshes = {{"mesh", 0, 20, -1, 0, "gear", ""}};
  const Kinematics gear = gear_train(train);
  const std::vector<Quantity> quantities = quantities_to_compare(gear);

  const Eigen::ArrayXd turns = 20 * times_s(20000, 2000);
  std::vector<RecordLevels> before, after;
  for (const unsigned repeat : {1u, 2u, 3u}) {
    // The mesh doubles, the shaft's line stays; each mounting is off by some per cent.
    const double scatter = 1 + 0.02 * (repeat - 2.0);
    const Eigen::VectorXd shaft = 0.5 * wave(turns), mesh = wave(20 * turns);
    const Eigen::VectorXd a = scatter * (shaft + mesh) + 0.1 * noise(20000, repeat);
    const Eigen::VectorXd b = scatter * (shaft + 2 * mesh) + 0.1 * noise(20000, 10 + repeat);
    before.push_back(measure_levels(record_of(a), gear, quantities));
    after.push_back(measure_levels(record_of(b), gear, quantities));
  }
  const Comparison found = compare(before, after, quantities);
  //! [page]
  const Change& shaft = change_of(found, "input shaft");
  const Change& mesh = change_of(found, "mesh");
  return {"comparison",
          "Before and after",
          "A gear's mesh line doubles while the line of its shaft stays; three repeats before and "
          "three after, each off by some per cent as mountings are. What changed is what moved by "
          "more than 1 dB against the scatter of the repeats; beside what did not, the change that "
          "would have been seen.",
          {"compare/comparison.hpp", "compare/quantities.hpp", "compare/record_levels.hpp"},
          {{"change of the mesh [dB]", "6.0, changed", told(mesh)},
           {"change of the shaft's line [dB]", "0.0, not changed", told(shaft)},
           {"what would have been seen of the shaft [dB]", "–", rounded(shaft.detectable_dB, 1)}},
          {Bars{"Levels",
                {"dB re 1 mm/s²", 0, 80},
                {"before", "after"},
                {{"input shaft", {shaft.a_dB + 60, shaft.b_dB + 60}},
                 {"mesh", {mesh.a_dB + 60, mesh.b_dB + 60}}}}}};
}

}  // namespace rvbench::analysis::examples
