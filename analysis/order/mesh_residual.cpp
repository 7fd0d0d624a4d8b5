#include "analysis/order/mesh_residual.hpp"

#include <utility>

#include "analysis/fft.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {

Eigen::VectorXd mesh_residual(const Eigen::Ref<const Eigen::VectorXd>& average,
                              const RegularMeshing& regular) {
  constexpr Require require{"mesh_residual"};
  const Eigen::Index n = average.size();
  require(regular.mesh_lines >= 1 && regular.mesh_lines <= n / 2,
          "mesh_lines must be within 1 and half the samples");
  require(regular.shaft_lines >= 1, "shaft_lines must be at least 1");
  require(regular.shaft_harmonics >= 0 && regular.sidebands >= 0, "a count is below 0");
  require(average.allFinite(), "a sample is not finite");

  Eigen::VectorXcd lines = fft(average);
  const auto take_out = [&](Eigen::Index line) {
    if (line >= 0 && line < lines.size()) lines[line] = 0;
  };
  for (Eigen::Index h = 0; h <= regular.shaft_harmonics; ++h) take_out(h * regular.shaft_lines);
  for (Eigen::Index mesh = regular.mesh_lines; mesh < lines.size(); mesh += regular.mesh_lines) {
    for (Eigen::Index s = -regular.sidebands; s <= regular.sidebands; ++s) {
      take_out(mesh + s * regular.shaft_lines);
    }
  }
  return inverse_fft(std::move(lines), n);
}

}  // namespace rvbench::analysis
