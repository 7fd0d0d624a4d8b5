#pragma once

#include "analysis/examples/example.hpp"

namespace rvbench::analysis::examples {

Example emd_example();
Example ensemble_emd_example();
Example hilbert_spectrum_example();
Example live_emd_example();
Example envelope_order_spectrum_example();
Example order_tracking_example();
Example tacholess_speed_example();
Example synchronous_average_example();
Example sidebands_example();
Example kurtogram_example();
Example squared_envelope_spectrum_example();
Example spectral_coherence_example();
Example cepstrum_prewhitening_example();
Example method_comparison_example();
Example indicators_example();
Example evidence_example();
Example comparison_example();

}  // namespace rvbench::analysis::examples
