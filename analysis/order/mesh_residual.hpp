#pragma once

#include <Eigen/Core>

namespace rvbench::analysis {

/// The regular part of a gear's synchronous average.
struct RegularMeshing {
  int mesh_lines = 0;       ///< meshings per period of the average: teeth, over one turn
  int shaft_lines = 1;      ///< turns of the shaft per period
  int shaft_harmonics = 2;  ///< of the shaft that count as regular
  int sidebands = 0;        ///< of each mesh harmonic, shaft_lines apart, to each side
};

/// An average without its mean, mesh harmonics, shaft harmonics and so many sidebands: what makes
/// one tooth unlike the others. With no sidebands it is the residual signal that NA4 is made of,
/// with one to each side the difference signal of FM4.
///
/// Shape    N samples, one period → N
/// Units    those of the average
/// Errors   throws std::invalid_argument: mesh_lines not within 1 and N/2, shaft_lines below 1, a
///          count below 0, a sample not finite
/// Source   Zakrajsek, Townsend & Decker, NASA TM-105950 (1993), for both signals
Eigen::VectorXd mesh_residual(const Eigen::Ref<const Eigen::VectorXd>& average,
                              const RegularMeshing& regular);

}  // namespace rvbench::analysis
