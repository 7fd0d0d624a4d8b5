#pragma once

#include <Eigen/Core>
#include <optional>

#include "analysis/order/line_ridge.hpp"
#include "analysis/shaft_angle.hpp"

namespace rvbench::analysis {

/// The phase of a line, sample by sample.
struct LinePhase {
  double rate_Hz = 0;
  Eigen::VectorXd cycles;            ///< of the line since the first sample
  Eigen::VectorXd amplitude;         ///< 0-to-peak, in the unit of the signal
  Eigen::Index settling = 0;         ///< samples at both ends that see the filter's end
  double carrier_over_noise = 0;     ///< power of the line over that of the noise in the band
  double standard_error_cycles = 0;  ///< of one sample of `cycles`, from that noise
  double faded = 0;  ///< share of samples at which the line is hardly above the noise: a cycle may
                     ///< have been lost there

  /// Mean frequency between the settled ends. No rate needs to be known: cycles per sample times
  /// rate_Hz.
  double mean_frequency_Hz() const;
};

/// Phase of the line along a ridge: x is turned back by the ridge's own phase, what is left is let
/// through within band_Hz, and its phase, unwrapped, added to the ridge's. So the band-pass follows
/// the line, and speed ripple slower than band_Hz / 3 is seen in full.
///
/// Shape    N → N; empty if the line is less than 10 dB above the noise in the band: below that an
///          FM demodulator loses cycles
/// Units    x in [u]; Hz. With rate_Hz = 1 all is in cycles per sample
/// Band     full gain up to band_Hz / 3 from the ridge, 80 dB down from 2/3 of band_Hz on: no other
///          line may lie within that
/// Noise    that of the quieter one of two bands beside, 1.5 band_Hz away
/// Errors   throws std::invalid_argument: band_Hz not above 0, ridge ± 2.5 band_Hz not within half
///          the rate, or more than a fifth of the samples settling
/// Source   Bonnardot, El Badaoui, Randall, Daniere & Guillet, Mech. Syst. Signal Process. 19(4),
///          766-785 (2005): phase of a mesh line as tachometer; Rice, in: Time Series Analysis (ed.
///          Rosenblatt, 1963), ch. 25: the threshold of FM
std::optional<LinePhase> line_phase(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_Hz,
                                    const LineRidge& ridge, double band_Hz);

/// The angle of the shaft that sheds the line at this order. Its zero is that of the first sample.
///
/// @param start_s  of the first sample  @param order  of the line, events per turn, above 0
/// @return empty if the line's phase turned back
/// Units    turns of the shaft. Source  of line_phase()
/// Limits   the line must be one where the sensor is: the mesh of a sun with planets that go round,
///          1080/121, is 1079/121 and 1081/121 in the housing, and following either for the middle
///          is 1/1080 off; 1521/121 and 1599/121 each stand alone
/// Errors   throws std::invalid_argument: order not above 0
std::optional<ShaftAngle> angle_of_line(const LinePhase& line, double start_s, double order);

}  // namespace rvbench::analysis
