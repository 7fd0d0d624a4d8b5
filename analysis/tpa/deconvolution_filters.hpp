#pragma once

#include "analysis/tpa/fir_matrix.hpp"

namespace rvbench::analysis {

/// What a filter network is to be.
struct FilterDesign {
  double rate_Hz = 0;
  Eigen::Index taps = 0;           ///< at most rate/step of the lines
  Eigen::Index delay_samples = 0;  ///< room for what comes before its cause: 0 to taps - 1
  double from_Hz = 0;  ///< the band; from 0 it does not fade in, to half the rate not out
  double to_Hz = 0;
  double edge_Hz = 0;  ///< width, inside the band, over which it fades
};

/// Filters of a band, causal and with the phase kept, and what that cost.
struct DesignedFilters {
  FirMatrix filters;
  Eigen::MatrixXd cut_share;  ///< outputs x inputs: energy of each response that its taps cut off
};

/// Filters that do what `s` says within a band: its lines, faded at the band's edges by half a
/// cosine and delayed, as an impulse response, of which the first taps are kept and faded at both
/// ends (in over half the delay, out over a sixteenth of the taps).
///
/// The inverse of a structure is not causal: its response before time 0 needs the delay, and what
/// is longer than rate/step samples folds over onto itself; a line every `step` cannot tell.
///
/// Shape   s: outputs x inputs per line. Of RegularisedInverse: forces per response; of an
///         FrfMatrix: the synthesis of targets
/// Errors  throws std::invalid_argument: of filter_grid(); taps outside 1 to rate/step, delay
///         outside 0 to taps - 1, band empty, outside the lines or narrower than its edges
/// Source  Kirkeby, Nelson, Hamada & Orduna-Bustamante, IEEE Trans. Speech Audio Process. 6(2),
///         189-194 (1998): regularised inversion of many channels, delay against folding
DesignedFilters deconvolution_filters(const LineMatrices& s, double first_Hz, double step_Hz,
                                      const FilterDesign& design);

/// How far filters and structure in series are from giving the forces back: |S·H·exp(+jωτ) - 1|
/// over |1| (Frobenius), at each line of H. Between lines it is not known.
///
/// Errors  throws std::invalid_argument: of filter_grid(), sizes that do not fit each other, a rate
///         over step below the number of taps
Eigen::VectorXd identity_errors(const FirMatrix& filters, const LineMatrices& h, double first_Hz,
                                double step_Hz);

}  // namespace rvbench::analysis
