#include "analysis/emd/hilbert_spectrum.hpp"

#include <algorithm>
#include <stdexcept>

#include "analysis/hilbert.hpp"
#include "hal/types/require_positive.hpp"

namespace rvbench::analysis {

MarginalSpectrum marginal_spectrum(const Eigen::Ref<const Eigen::MatrixXd>& imfs, double rate_Hz,
                                   Eigen::Index bins) {
  require_positive(rate_Hz, "marginal_spectrum", "rate_Hz");
  if (bins < 1) throw std::invalid_argument("marginal_spectrum: bins, at least 1");
  MarginalSpectrum spectrum;
  spectrum.resolution_Hz = rate_Hz / 2 / static_cast<double>(bins);
  spectrum.power = Eigen::VectorXd::Zero(bins);
  for (const auto& imf : imfs.colwise()) {
    const Eigen::VectorXd power = 0.5 * envelope(imf).array().square() / double(imf.size());
    const Eigen::VectorXd frequency_Hz = instantaneous_frequency_Hz(imf, rate_Hz);
    for (Eigen::Index i = 0; i < power.size(); ++i) {
      if (frequency_Hz[i] <= 0) {  // exactly 0 where nothing swings
        spectrum.unplaced += power[i];
        continue;
      }
      const auto bin = static_cast<Eigen::Index>(frequency_Hz[i] / spectrum.resolution_Hz);
      spectrum.power[std::min(bin, bins - 1)] += power[i];
    }
  }
  return spectrum;
}

}  // namespace rvbench::analysis
