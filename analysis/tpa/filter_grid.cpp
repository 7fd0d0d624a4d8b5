#include "analysis/tpa/filter_grid.hpp"

#include <cmath>
#include <string>

#include "hal/types/require.hpp"

namespace rvbench::analysis {

FilterGrid filter_grid(const char* where, const LineMatrices& lines, double first_Hz,
                       double step_Hz, double rate_Hz) {
  const Require require{where};
  require(std::isfinite(step_Hz) && step_Hz > 0 && std::isfinite(rate_Hz) && rate_Hz > 0,
          "step or rate is not above 0");
  require(std::isfinite(first_Hz) && first_Hz >= 0, "first line at " + std::to_string(first_Hz));
  require(lines.lines > 0 && lines.rows > 0 && lines.columns > 0, "nothing to filter by");
  require(lines.values.allFinite(), "a value is not finite");
  const double length = std::round(rate_Hz / step_Hz), first = std::round(first_Hz / step_Hz);
  const bool fits = std::abs(rate_Hz / step_Hz - length) < 1e-6 * length &&
                    std::abs(first_Hz / step_Hz - first) < 1e-6;
  require(fits, "rate " + std::to_string(rate_Hz) + " Hz or first line " +
                    std::to_string(first_Hz) + " Hz is no multiple of the step " +
                    std::to_string(step_Hz) + " Hz");
  const FilterGrid grid{Eigen::Index(length), Eigen::Index(first)};
  require(grid.first + lines.lines - 1 <= grid.length / 2, "a line lies above half the rate");
  return grid;
}

}  // namespace rvbench::analysis
