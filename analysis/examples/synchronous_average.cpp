#include "analysis/order/synchronous_average.hpp"

#include <cmath>

#include "analysis/examples/examples.hpp"
#include "analysis/examples/signals.hpp"
#include "analysis/fft.hpp"
#include "analysis/order/mesh_residual.hpp"
#include "analysis/spectrum.hpp"

namespace rvbench::analysis::examples {
namespace {

constexpr Eigen::Index per_turn = 400, bad_tooth = 13;

// One turn of a gear of 20 teeth of which one, 13, meshes too late.
Eigen::VectorXd one_turn() {
  const Eigen::ArrayXd turn = times_s(per_turn, double(per_turn));
  Eigen::VectorXd x = wave(20 * turn) + 0.4 * wave(40 * turn);
  for (Eigen::Index i = 0; i < per_turn; ++i) {
    const double teeth_away = 20 * turn[i] - double(bad_tooth);
    x[i] += 0.3 * std::exp(-8 * teeth_away * teeth_away);
  }
  return x;
}

Panel over_turn(const std::string& title, const Axis& y, const std::vector<Trace>& traces) {
  return {title, {"tooth", 0, 20}, y, traces, {}};
}

Panel left_over(const Spectrum& rest) {
  return {"Spectrum of what no turn shares",
          {"order", 0, 50},
          {"m/s²", 0, 0.55},
          {{"", 0, rest.resolution, rest.amplitude}}};
}

}  // namespace

Example synchronous_average_example() {
  //! [page]
  // 200 turns at even steps of the angle; a tone that no turn shares, and noise.
  const Eigen::ArrayXd angle_turns = times_s(200 * 400, 400);
  const Eigen::VectorXd turn = one_turn();
  const Eigen::VectorXd x =
      turn.replicate(200, 1) + 0.5 * wave(7.365 * angle_turns) + 0.5 * noise(200 * 400, 1);

  const SynchronousAverage found = synchronous_average(x, 400);
  const Eigen::VectorXd residual =
      mesh_residual(found.average, {.mesh_lines = 20, .shaft_harmonics = 2, .sidebands = 0});
  const Eigen::VectorXd rest = without_average(x, 400);
  //! [page]
  Eigen::Index at = 0;
  residual.maxCoeff(&at);
  const Spectrum of_rest = amplitude_spectrum(rest, per_turn, Window::hann);  // 1/200 per line
  const double step = 20.0 / double(per_turn);
  return {
      "synchronous_average",
      "Synchronous average and what it leaves",
      "A gear of 20 teeth, of which number 13 strikes; a tone at order 7.365, which no two "
      "turns share, and noise as strong. The average over 200 turns keeps the gear; without "
      "its mesh lines it shows the one tooth. Taken out of each turn it leaves the tone.",
      {"order/synchronous_average.hpp", "order/mesh_residual.hpp"},
      {{"amplitude of the mesh line [m/s²]", rounded(2 * std::abs(fft(turn)[20]) / per_turn, 2),
        rounded(std::abs(found.lines[20]), 2)},
       {"p-value of the mesh line", "–", p_value_text(found.p_value(20))},
       {"standard error of a sample of the average [m/s²]", rounded(std::sqrt(0.375 / 200), 3),
        rounded(rms(found.standard_error), 3)},
       {"error of the average, rms [m/s²]", rounded(std::sqrt(0.25 / 200), 3),
        rounded(rms(found.average - turn), 3)},
       {"tooth that stands out of the residual", std::to_string(bad_tooth),
        rounded(double(at) * step, 0)},
       {"tone that is left at order 7.365 [m/s²]", "0.50", rounded(of_rest.amplitude[1473], 2)}},
      {over_turn("One turn of 200, and their average", {"m/s²", -4, 4},
                 {{"one turn", 0, step, x.head(per_turn)}, {"average", 0, step, found.average}}),
       over_turn("Average without its mesh lines", {"m/s²", -0.2, 0.5},
                 {{"residual", 0, step, residual}}),
       left_over(of_rest)}};
}

}  // namespace rvbench::analysis::examples
