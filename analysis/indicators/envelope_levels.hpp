#pragma once

#include <string>
#include <vector>

#include "analysis/envelope_spectra.hpp"
#include "analysis/indicators/indicator.hpp"
#include "analysis/kinematics.hpp"

namespace rvbench::analysis {

/// Depth of the line that a channel's envelope has at each characteristic order: the share of the
/// mean envelope that it swings by.
///
///     depth² = Σ sₖ·(A/E)²ₖ    over the IMFs k
///
/// with A the highest line within reach of the order, E the mean envelope and s the share of the
/// channel's power. An IMF whose carrier is too slow to swing at the order has nothing there.
///
/// Shape   any number of IMFs → as many indicators as orders that an IMF reaches and the record
///         parts from the mean, each named after its order
/// Units   dimensionless; m for a carrier (1 + m·cos): fully modulated is 1
/// Limits  noise counts as well: compare with that of a sound unit. Of rolling elements the order
///         is looked for within their slip, with what repeats with the gear train taken out: the
///         most that noise has there counts
/// Source  Randall & Antoni, Mech. Syst. Signal Process. 25(2), 485-520 (2011) for the spectrum;
///         the sum over IMFs is ours
class EnvelopeLevels {
 public:
  /// @param speed_error  relative: how far orders may be off, 0 where the angle was measured
  EnvelopeLevels(const Kinematics& kinematics, double speed_error);

  /// @param share  of the channel's power that the IMF carries, 0..1
  void add(const EnvelopeSpectra& envelope, double share);

  std::vector<Indicator> indicators() const;

 private:
  struct Place {
    std::string name;
    double order = 0;
    double within = 0;  ///< orders to both sides
    bool rolls = false;
    bool is_reached = false;
    double depth2 = 0;
  };
  std::vector<Place> places_;
};

}  // namespace rvbench::analysis
