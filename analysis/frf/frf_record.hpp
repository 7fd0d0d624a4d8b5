#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "hal/types/frequency_response.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::analysis {

/// One channel of a test: what it measures, where, and how much it can show.
struct FrfChannel {
  DegreeOfFreedom place;
  std::string unit;          ///< SI symbol: "N", "m/s²"
  double range = not_known;  ///< full scale in `unit`; NaN if not known
};

/// Who excites and who listens. A hammer is one excitation, shakers may be several at once.
struct FrfSetup {
  std::vector<FrfChannel> excitations;  ///< E >= 1
  std::vector<FrfChannel> responses;    ///< R >= 1
};

/// One record of a test, all channels on one clock.
struct FrfRecord {
  std::string source;           ///< file and place in it
  double rate_Hz = 0;           ///< > 0
  Eigen::MatrixXd excitations;  ///< N samples x E, in the units of the setup
  Eigen::MatrixXd responses;    ///< N samples x R
};

/// @throws std::invalid_argument naming `where`: no channel, another number of channels or samples
///         than the setup and the record itself state, rate not above 0
/// Units  none. Source  definition
void require_record(const FrfRecord& record, const FrfSetup& setup, const char* where);

}  // namespace rvbench::analysis
