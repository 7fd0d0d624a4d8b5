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
    const AnalyticSignal swing = analytic_signal(imf, rate_Hz);
    const Eigen::VectorXd power = 0.5 * swing.envelope.array().square() / double(imf.size());
    for (Eigen::Index i = 0; i < power.size(); ++i) {
      if (swing.frequency_Hz[i] <= 0) {  // exactly 0 where nothing swings
        spectrum.unplaced += power[i];
        continue;
      }
      const auto bin = static_cast<Eigen::Index>(swing.frequency_Hz[i] / spectrum.resolution_Hz);
      spectrum.power[std::min(bin, bins - 1)] += power[i];
    }
  }
  return spectrum;
}

}  // namespace rvbench::analysis
