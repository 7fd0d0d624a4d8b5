#include "analysis/examples/example.hpp"

#include <fmt/format.h>

#include "analysis/examples/examples.hpp"

namespace rvbench::analysis::examples {

std::vector<Example> all_examples() {
  return {emd_example(),
          ensemble_emd_example(),
          hilbert_spectrum_example(),
          live_emd_example(),
          envelope_order_spectrum_example(),
          order_tracking_example(),
          tacholess_speed_example(),
          synchronous_average_example(),
          sidebands_example(),
          kurtogram_example(),
          squared_envelope_spectrum_example(),
          spectral_coherence_example(),
          cepstrum_prewhitening_example(),
          method_comparison_example(),
          indicators_example(),
          evidence_example(),
          comparison_example()};
}

std::string rounded(double value, int decimals) {
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  return text.find_first_of("123456789") == std::string::npos && text[0] == '-' ? text.substr(1)
                                                                                : text;
}

std::string p_value_text(double p_value) {
  return p_value < 1e-15 ? "below 1e-15" : fmt::format("{:.1g}", p_value);
}

}  // namespace rvbench::analysis::examples
