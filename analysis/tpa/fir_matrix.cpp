#include "analysis/tpa/fir_matrix.hpp"

#include <string>

#include "analysis/fft.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {

LineMatrices frequency_response(const FirMatrix& filters, Eigen::Index n) {
  constexpr Require require{"frequency_response"};
  require(n >= filters.taps.rows(),
          std::to_string(n) + " samples hold no " + std::to_string(filters.taps.rows()) + " taps");
  LineMatrices response(filters.outputs, filters.inputs, n / 2 + 1);
  Eigen::VectorXd padded = Eigen::VectorXd::Zero(n);
  for (Eigen::Index output = 0; output < filters.outputs; ++output) {
    for (Eigen::Index input = 0; input < filters.inputs; ++input) {
      padded.head(filters.taps.rows()) = filters.response(output, input);
      const Eigen::VectorXcd lines = fft(padded);
      for (Eigen::Index k = 0; k < lines.size(); ++k) response[k](output, input) = lines[k];
    }
  }
  return response;
}

}  // namespace rvbench::analysis
