#include <cmath>

#include "analysis/examples/examples.hpp"
#include "analysis/examples/signals.hpp"
#include "analysis/indicators/gear_condition.hpp"
#include "analysis/indicators/order_levels.hpp"
#include "analysis/indicators/power_transmission.hpp"
#include "analysis/indicators/signal_levels.hpp"
#include "analysis/order/mesh_residual.hpp"

namespace rvbench::analysis::examples {
namespace {

constexpr Eigen::Index per_turn = 400, records = 20;

// The average of a gear of 20 teeth; from record 10 on a tooth gets worse, and then its neighbours.
Eigen::VectorXd average_of(Eigen::Index record) {
  const Eigen::ArrayXd turn = times_s(per_turn, double(per_turn));
  Eigen::VectorXd x = wave(20 * turn) + 0.3 * wave(40 * turn) +
                      0.02 * noise(per_turn, static_cast<unsigned>(record + 1));
  const double damage = 0.05 * std::max(0.0, double(record - 9));
  for (Eigen::Index tooth = 0; tooth < std::max<Eigen::Index>(1, record - 13); ++tooth) {
    for (Eigen::Index i = 0; i < per_turn; ++i) {
      const double away = 20 * turn[i] - double(3 * tooth + 2);
      x[i] += damage * std::exp(-8 * away * away);
    }
  }
  return x;
}

struct Course {
  Eigen::VectorXd fm0{records}, fm4{records}, na4{records};
};

Course course() {
  Course seen;
  //! [page]
  const RegularMeshing without_mesh{.mesh_lines = 20, .sidebands = 0};
  const RegularMeshing without_sidebands{.mesh_lines = 20, .sidebands = 1};
  std::vector<double> variances;  // of the records before
  for (Eigen::Index record = 0; record < records; ++record) {
    const Eigen::VectorXd average = average_of(record);
    const Eigen::VectorXd residual = mesh_residual(average, without_mesh);
    seen.fm0[record] = *fm0(average, 20, 2);
    seen.fm4[record] = fm4(mesh_residual(average, without_sidebands));
    const ResidualMoments moments = residual_moments(residual);
    seen.na4[record] = *na4(moments, variances);
    variances.push_back(moments.variance);
  }
  //! [page]
  return seen;
}

Panel over_records(const std::string& name, const Eigen::VectorXd& values) {
  return {name + " over the records",
          {"record", 0, double(records - 1)},
          {name, 0, 1.1 * values.maxCoeff()},
          {{"", 0, 1, values}},
          {{10, "one tooth"}, {15, "its neighbours"}}};
}

}  // namespace

Example indicators_example() {
  const Course seen = course();
  //! [page]
  const Eigen::ArrayXd turns = times_s(6400, 64);
  const Eigen::VectorXd mesh = (1 + 0.2 * wave(turns).array()) * wave(20 * turns).array();
  const SignalLevels levels = signal_levels(wave(20 * turns));
  const Spectrum orders = amplitude_spectrum(mesh, 64, Window::hann);
  const double level = *level_at_order(orders, 20, 0.1);
  const double sidebands = *sideband_ratio(orders, 20, 1, 1);

  const Eigen::VectorXd torque_Nm = 10 + 0.5 * wave(turns).array();
  const Eigen::VectorXd speed_rad_s = Eigen::VectorXd::Constant(6400, 100);
  const double ripple = *torque_ripple(torque_Nm);
  const double efficient = *efficiency(mean_power_W(torque_Nm, speed_rad_s), 850);
  //! [page]
  return {
      "indicators",
      "Indicators that a limit can be set on",
      "Twenty averages of a gear of 20 teeth; from record 10 on one tooth gets worse, from 15 "
      "on its neighbours do as well. FM4 stands for one tooth among sound ones, and falls as "
      "others follow; NA4 counts against all records so far, and stays high. The levels "
      "are those of signals for which they are known by a formula.",
      {"indicators/gear_condition.hpp", "indicators/order_levels.hpp",
       "indicators/power_transmission.hpp", "indicators/signal_levels.hpp"},
      {{"FM4 of a sound gear, mean of records 0 to 9", "3", rounded(seen.fm4.head(10).mean(), 1)},
       {"FM4 of one bad tooth, record 13", "–", rounded(seen.fm4[13], 1)},
       {"FM4 of several, record 19", "–", rounded(seen.fm4[records - 1], 1)},
       {"NA4 of a sound gear, mean of records 0 to 9", "3", rounded(seen.na4.head(10).mean(), 1)},
       {"NA4 of one bad tooth, record 13", "–", rounded(seen.na4[13], 0)},
       {"NA4 of several, record 19", "–", rounded(seen.na4[records - 1], 0)},
       {"FM0 of a sound gear, record 0", "–", rounded(seen.fm0[0], 2)},
       {"crest factor of a sine", "1.414", rounded(levels.crest_factor, 3)},
       {"kurtosis of a sine", "1.500", rounded(levels.kurtosis, 3)},
       {"level at the mesh [m/s²]", "1.000", rounded(level, 3)},
       {"sideband ratio of a mesh that swings by 0.2", "0.200", rounded(sidebands, 3)},
       {"torque ripple of 0.5 N·m about 10 N·m", "0.100", rounded(ripple, 3)},
       {"efficiency, 850 W of 1000 W", "0.850", rounded(efficient, 3)}},
      {over_records("FM4", seen.fm4), over_records("NA4", seen.na4)}};
}

}  // namespace rvbench::analysis::examples
