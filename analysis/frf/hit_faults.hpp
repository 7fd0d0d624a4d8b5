#pragma once

#include <string>
#include <vector>

#include "analysis/frf/force_pulse.hpp"
#include "analysis/frf/frf_record.hpp"
#include "analysis/frf/hit_windows.hpp"

namespace rvbench::analysis {

enum class HitFaultKind {
  not_finite,
  weak,              ///< not enough force, or not above its noise
  double_hit,        ///< a second pulse of force
  overload,          ///< the force was clipped
  narrow_spectrum,   ///< mis-hit or soft tip: the force does not reach all of the band
  response_clipped,  ///< a response was
  not_decayed,       ///< a response goes on at the end: leakage
  unequal,           ///< rate or length are not those of the hits before it
  unlike_others      ///< other responses than most hits at the place: off in direction or place
};

/// Why a hit is not used: what was measured, and what would have been allowed.
struct HitFault {
  HitFaultKind kind;
  double value = 0;
  double limit = 0;
  std::string reason;  ///< with channel and numbers, for people
};

/// What a good hit keeps to.
struct HitLimits {
  double from_Hz = 0;                 ///< band that is wanted
  double to_Hz = not_known;           ///< NaN: the force's spectrum is not judged
  double spectrum_drop_dB = 20;       ///< that the force may fall within the band
  double second_pulse_share = 0.05;   ///< of the pulse's height
  double least_peak = not_known;      ///< unit of the force; NaN: any
  double least_peak_over_noise = 20;  ///< in standard deviations of the force at rest
  double undecayed_share = 0.02;      ///< rms at the end over the peak, after the windows
};

/// A hit and what is wrong with it.
struct JudgedHit {
  std::string source;
  ForcePulse pulse;
  double reaches_Hz =
      not_known;                 ///< below it the force's spectrum has not dropped by the limit yet
  std::vector<HitFault> faults;  ///< empty: accepted

  bool accepted() const { return faults.empty(); }
};

/// Judges one record of one hit.
///
/// A channel is clipped where a sample reaches 99.9 % of its range or, where that is not known,
/// where three samples or more stay exactly at the largest magnitude and a neighbour is far from
/// it: four of the channel's smallest steps, which a quantised top of a wave is not.
/// A response has not decayed if the rms of its last twentieth, in the exponential window, is above
/// the limit and above what the noise before the hit reaches once in a million (F test).
///
/// Shape   one excitation; any number of responses
/// Units   of the setup
/// Errors  throws std::invalid_argument: not one excitation, or of require_record(); samples that
///         are not finite are a fault of the hit, and then the only one told
/// Limits  noise before the hit is not known where fewer than 8 samples come before it
/// Source  Ewins, Modal Testing (2nd ed., 2000), sec. 3.9; limits: ours, after ISO 7626-5:1994
JudgedHit judge_hit(const FrfRecord& record, const FrfSetup& setup, const HitLimits& limits,
                    const HitWindows& windows);

/// "double hit", "overload", ...
const char* to_string(HitFaultKind kind) noexcept;

}  // namespace rvbench::analysis
