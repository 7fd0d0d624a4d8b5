#pragma once

#include <Eigen/Core>
#include <complex>
#include <cstddef>
#include <string>
#include <vector>

#include "analysis/explain/residual_cells.hpp"

namespace rvbench::analysis {

/// One line of one channel under one condition: measured beside predicted, and what a force at each
/// site of the model would add to it: on a body, or between two.
struct PushedLine {
  std::string channel;
  std::size_t condition = 0;
  LockedTo locked_to = LockedTo::shaft;
  int number = 0;       ///< one force brings all lines of one number, in all channels
  double place = 0;     ///< order of the reference shaft, or Hz
  double load = 0;      ///< of the condition, in any unit: what a force may grow with
  double measured = 0;  ///< amplitude, mean of the condition's records
  double standard_error = 1;
  double floor = 0;  ///< amplitude that noise shows on average where no line is
  std::complex<double> predicted;
  Eigen::RowVectorXcd response;  ///< per site, in the channel's unit per N or N·m
};

/// The force at one site that brings a line nearest to what was measured.
struct SitePush {
  std::size_t site = 0;
  double share = 0;           ///< that it explains of the squared differences, in standard errors:
                              ///< 1 of all, 0 of noise on average
  double standard_error = 0;  ///< of that, from how conditions and channels differ
  double p_value = 1;         ///< that noise alone is explained so well
  double size = 0;            ///< amplitude [N or N·m], RMS over the conditions
  bool is_as_good = true;     ///< as the best site, as far as this line tells
};

/// A line in all channels and under all conditions.
struct LinePushes {
  LockedTo locked_to = LockedTo::shaft;
  double place = 0;             ///< order, or Hz under the first condition
  std::vector<SitePush> sites;  ///< the one that explains most first

  /// Whether a force at one site explains more than half, and not by chance.
  bool are_explained() const;
};

/// Lines that forces at one site may have brought: any of these sites, not all, does as well.
struct PushSource {
  std::vector<std::size_t> lines;  ///< places in Pushes::lines, farthest off first
  std::vector<std::size_t> sites;  ///< the one that explains most of the first line first
};

struct Pushes {
  std::vector<LinePushes> lines;    ///< that were looked at, farthest off first
  std::vector<PushSource> sources;  ///< of the lines that are explained and tell sites apart
};

/// Where missing physics pushes: for each found line and each site the force there that brings the
/// line nearest to what was measured.
///
///     measured ≈ |predicted + response·(a + b·load)|
///
/// with one complex a and b for each line number, the same at all speeds and in all channels: what
/// geometry and load bring. b is 0 where the load hardly changes. A site is as good as the best one
/// unless it leaves over more than twice as much (RMS): what is left over is alike under all loads
/// of a speed, so that many conditions tell less than their number. Sites are as good as each other
/// if |cos| of their responses, in standard errors, is above 0.95. A line that all sites bring as
/// well has no source.
///
/// Leaves out: forces that grow with speed, forces at two sites at once, what a force does at
/// other orders. Amplitudes alone tell less than lines with phases: which site it is shows only
/// in how a line changes with speed and from channel to channel.
///
/// @param lines  of found numbers also those cells that are within chance
/// @param found  clusters of locate(): what is to be explained; means are passed over
/// @return without those lines that are too few for so many unknowns
/// Source  Gerchberg & Saxton, Optik 35(2), 237-246 (1972), for phases that were not measured
/// Units   N or N·m; those of the channels. Errors  none thrown: responses have one size
Pushes find_pushes(const std::vector<PushedLine>& lines, const std::vector<ResidualCluster>& found);

}  // namespace rvbench::analysis
