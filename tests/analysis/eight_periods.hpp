#pragma once

#include "analysis/envelope_spectra.hpp"
#include "tests/analysis/order_signals.hpp"

namespace rvbench::test {

/// Eight periods of a gear train that repeats every 21 turns.
inline constexpr double period_turns = 21;
inline const OrderSignals turning{.speed_Hz = 20, .rate_Hz = 2000, .count = 16801};

inline analysis::EnvelopeSpectra spectra_of(const Eigen::VectorXd& x) {
  return envelope_spectra(x, turning.rate_Hz, 0, turning.angle(), period_turns);
}

}  // namespace rvbench::test
