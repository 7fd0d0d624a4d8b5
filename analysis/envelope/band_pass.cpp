#include "analysis/envelope/band_pass.hpp"

#include "analysis/fft.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {

Eigen::VectorXcd band_lines(const Eigen::Ref<const Eigen::VectorXd>& x, double rate, double from,
                            double to) {
  constexpr Require require{"band_lines"};
  require(from >= 0 && to > from && to <= rate / 2, "the band must lie within half the rate");
  require(x.size() >= 4 && x.allFinite(), "needs at least 4 finite samples");
  Eigen::VectorXcd lines = fft(x);
  for (Eigen::Index k = 0; k < lines.size(); ++k) {
    const double f = double(k) * rate / double(x.size());
    if (k == 0 || f < from || f >= to) lines[k] = 0;
  }
  return lines;
}

Eigen::VectorXd band_passed(const Eigen::Ref<const Eigen::VectorXd>& x, double rate, double from,
                            double to) {
  return inverse_fft(band_lines(x, rate, from, to), x.size());
}

}  // namespace rvbench::analysis
