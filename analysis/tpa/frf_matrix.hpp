#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/tpa/line_matrices.hpp"
#include "hal/types/frequency_response.hpp"

namespace rvbench::analysis {

/// The frequency responses between all excitations (columns) and all responses (rows) of a test.
struct FrfMatrix {
  std::vector<DegreeOfFreedom> responses;    ///< of the rows; directions positive: "+X", never "-X"
  std::vector<DegreeOfFreedom> excitations;  ///< of the columns; as well
  std::string response_unit;                 ///< of all rows
  std::string excitation_unit;               ///< of all columns
  double first_Hz = 0;
  double step_Hz = 0;
  LineMatrices values;        ///< in response_unit per excitation_unit
  Eigen::MatrixXd variances;  ///< rows·columns x lines, ordered as `values`: E|error|²; empty if
                              ///< the coherence or the averages of a response are not known
  Eigen::MatrixXd noise;      ///< as `variances`, of what differs from line to line; empty if not
                              ///< known: smooth_frfs() tells. What a hammer's places and
                              ///< directions do to a column mixes paths, and hides none of them
  std::vector<std::string> notes;

  double frequency_Hz(Eigen::Index line) const {
    return first_Hz + static_cast<double>(line) * step_Hz;
  }
};

/// A matrix, or all that keeps a set of responses from being one.
struct AssembledFrfs {
  std::optional<FrfMatrix> matrix;  ///< there if there is no fault
  std::vector<std::string> faults;  ///< "J2 +X per J3 +Z: missing"
};

/// Puts responses into a matrix, rows and columns in the order in which places first come. Of a
/// direction "-X" the sign of the response changes, and a note says so; "X" is "+X".
///
/// An H1 estimate of n averages and coherence γ² errs by E|error|² = |H|²·(1 - γ²)/(γ²·n).
///
/// @param columns  the excitations there must be, in this order; empty: those of the set
/// Errors  faults, all at once: nothing given, a pair missing or given twice, an excitation that is
///         not among `columns`, other lines or units than the first's, values or coherence that are
///         not finite, coherence of another length or outside 0 to 1
/// Source  Bendat & Piersol, Random Data (4th ed., 2010), table 9.6 for the errors
AssembledFrfs assemble_frf_matrix(const std::vector<FrequencyResponse>& set,
                                  const std::vector<DegreeOfFreedom>& columns = {});

}  // namespace rvbench::analysis
