#include "analysis/frf/frf_record.hpp"

#include "hal/types/require.hpp"

namespace rvbench::analysis {

void require_record(const FrfRecord& record, const FrfSetup& setup, const char* where) {
  const Require require{where};
  require(!setup.excitations.empty() && !setup.responses.empty(),
          "needs an excitation and a response");
  require(record.rate_Hz > 0, record.source + ": the rate must be above 0");
  require(record.excitations.cols() == Eigen::Index(setup.excitations.size()) &&
              record.responses.cols() == Eigen::Index(setup.responses.size()),
          record.source + ": not the channels of the setup");
  require(record.excitations.rows() == record.responses.rows() && record.responses.rows() >= 16,
          record.source + ": needs 16 samples or more, of each channel as many");
}

}  // namespace rvbench::analysis
