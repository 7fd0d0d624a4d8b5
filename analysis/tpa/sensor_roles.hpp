#pragma once

#include <vector>

#include "analysis/tpa/frf_matrix.hpp"
#include "analysis/tpa/operating_spectra.hpp"

namespace rvbench::analysis {

/// What each sensor is for. There is no analysis of paths without a sensor that it is not fitted
/// to: the score there is what says whether its contributions can be believed.
class SensorRoles {
 public:
  /// @param indicators  forces are found from these
  /// @param targets     what paths contribute to; these may validate as well
  /// @param validation  neither fitted to nor a target's only witness: one at least
  /// Errors  throws std::invalid_argument, naming the place: a role without sensor, a place twice
  ///         in one, an indicator that is a target or validates
  SensorRoles(std::vector<DegreeOfFreedom> indicators, std::vector<DegreeOfFreedom> targets,
              std::vector<DegreeOfFreedom> validation);

  const std::vector<DegreeOfFreedom>& indicators() const { return indicators_; }
  const std::vector<DegreeOfFreedom>& targets() const { return targets_; }
  const std::vector<DegreeOfFreedom>& validation() const { return validation_; }

 private:
  std::vector<DegreeOfFreedom> indicators_, targets_, validation_;
};

/// The rows of these places, in their order.
/// Shape   places x columns, all lines. Units  of the whole
/// Errors  throws std::invalid_argument, naming it, of a place that is not among the rows
/// Source  definition
FrfMatrix rows_of(const FrfMatrix& frfs, const std::vector<DegreeOfFreedom>& places);
OperatingSpectra rows_of(const OperatingSpectra& spectra,
                         const std::vector<DegreeOfFreedom>& places);

/// Whether spectra have the lines of the FRFs: the first to 1e-6 of a step, the last to a
/// twentieth. Units  none. Errors  none thrown. Source  operating_spectra(), whose blocks are of
/// whole samples
bool is_on_lines_of(const OperatingSpectra& spectra, const FrfMatrix& frfs);

}  // namespace rvbench::analysis
