#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/tpa/line_matrices.hpp"
#include "hal/types/frequency_response.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::analysis {

/// Which frequencies lines lie at.
struct LineGrid {
  double first_Hz = 0;
  double step_Hz = 0;
  Eigen::Index lines = 0;

  double frequency_Hz(Eigen::Index line) const {
    return first_Hz + static_cast<double>(line) * step_Hz;
  }
};

/// What sensors showed in operation: phasors of each sensor, block by block, on the lines of FRFs.
struct OperatingSpectra {
  std::vector<DegreeOfFreedom> places;  ///< of the rows; directions positive
  std::string unit;                     ///< of all rows
  LineGrid grid;
  LineMatrices values;  ///< places x blocks: X of x(t) = Re(X·e^{iω(t - start of the block)}),
                        ///< 0-to-peak. A tone on a line reads its amplitude there
};

/// Σ|X|² over the lines of a Hann block, times this, is the mean square over them: half for the
/// phasor, and 1.5 lines of noise that each Hann line lets through.
inline constexpr double mean_square_per_power = 1 / (2 * 1.5);

/// Spectra, or all that keeps a record from giving them.
struct TakenSpectra {
  std::optional<OperatingSpectra> spectra;  ///< there if there is no fault
  std::vector<std::string> faults;          ///< "J3 active +X: 2480 samples a second, not 4960"
};

/// Hann blocks of 1/step_Hz, the same samples for all channels, from channels that are named by
/// point and direction. A channel of "-X" is taken with the other sign for a place of "+X".
///
/// Shape   places x blocks, at each line of the grid
/// Units   of the channels, 0-to-peak
/// Errors  faults, all at once: a place without channel or with two, other rates, lengths, starts
///         or units than the first channel's, a sample that is not finite, all samples alike,
///         fewer than two blocks,
///         lines that blocks of whole samples do not have (off by a twentieth of a step), lines
///         beyond half the sample rate. Throws std::invalid_argument: no place, a grid without
///         lines or step, overlap not in [0, 1)
/// Limits  resonances and lines narrower than 4 steps are smeared over as many
/// Source  Welch, IEEE Trans. Audio Electroacoust. 15(2), 70-73 (1967); Heinzel, Rüdiger &
///         Schilling, Spectrum and spectral density estimation by the DFT (2002)
TakenSpectra operating_spectra(const Recording& recording,
                               const std::vector<DegreeOfFreedom>& places, const LineGrid& grid,
                               double overlap = 0.5);

/// These blocks, in this order; one may be there twice.
/// Shape   places x as many blocks, all lines. Units  of the whole
/// Errors  throws std::invalid_argument of a block that is not there. Source  definition
OperatingSpectra blocks_of(const OperatingSpectra& spectra,
                           const std::vector<Eigen::Index>& blocks);

}  // namespace rvbench::analysis
