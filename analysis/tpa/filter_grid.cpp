#include "analysis/tpa/filter_grid.hpp"

#include <cmath>
#include <string>

#include "hal/types/require.hpp"

namespace rvbench::analysis {

bool has_filter_grid(double first_Hz, double step_Hz, double rate_Hz) {
  const double length = rate_Hz / step_Hz, first = first_Hz / step_Hz;
  return std::abs(length - std::round(length)) < 1e-6 * length &&
         std::abs(first - std::round(first)) < 1e-6;
}

FilterGrid filter_grid(const char* where, const LineMatrices& lines, double first_Hz,
                       double step_Hz, double rate_Hz) {
  const Require require{where};
  require(std::isfinite(step_Hz) && step_Hz > 0 && std::isfinite(rate_Hz) && rate_Hz > 0,
          "step or rate is not above 0");
  require(std::isfinite(first_Hz) && first_Hz >= 0, "first line at " + std::to_string(first_Hz));
  require(lines.lines > 0 && lines.rows > 0 && lines.columns > 0, "nothing to filter by");
  require(lines.values.allFinite(), "a value is not finite");
  require(has_filter_grid(first_Hz, step_Hz, rate_Hz),
          "rate " + std::to_string(rate_Hz) + " Hz or first line " + std::to_string(first_Hz) +
              " Hz is no multiple of the step " + std::to_string(step_Hz) + " Hz");
  const FilterGrid grid{Eigen::Index(std::lround(rate_Hz / step_Hz)),
                        Eigen::Index(std::lround(first_Hz / step_Hz))};
  require(grid.first + lines.lines - 1 <= grid.length / 2, "a line lies above half the rate");
  return grid;
}

}  // namespace rvbench::analysis
