#pragma once

#include <Eigen/Core>

namespace rvbench::analysis {

/// fft() of x with all lines zero but those from `from` on and below `to`; line 0 is zero always.
///
/// Shape   N → N/2 + 1
/// Units   those of the rate: Hz, or orders for samples per turn
/// Limits  x is taken as periodic: what the record cuts off reaches every band
/// Errors  throws std::invalid_argument: band not within half the rate, N < 4, sample not finite
/// Source  Randall & Antoni, Mech. Syst. Signal Process. 25(2), 485-520 (2011): band by lines
Eigen::VectorXcd band_lines(const Eigen::Ref<const Eigen::VectorXd>& x, double rate, double from,
                            double to);

/// The part of x between two frequencies, without delay.
///
/// Shape  N → N
/// Units, limits, errors  of band_lines(); edges are sharp, and ring beside a strong tone
/// Source  of band_lines()
Eigen::VectorXd band_passed(const Eigen::Ref<const Eigen::VectorXd>& x, double rate, double from,
                            double to);

}  // namespace rvbench::analysis
