#pragma once

#include <string>
#include <vector>

#include "analysis/indicators/gear_residual.hpp"
#include "analysis/indicators/indicator.hpp"
#include "analysis/kinematics.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::analysis {

/// A p-value below it, over everything searched, says that something is there.
inline constexpr double significant_p = 1e-3;

/// A record with a p-value below it speaks for a part that all records together show.
inline constexpr double plausible_p = 0.05;

/// What is wrong with the data, and whether it forbids a verdict.
struct QualityNote {
  std::string where;  ///< "point 012, accel_1x"
  std::string what;   ///< "clipped: 31 samples at full scale"
  bool invalidates = false;
  bool leaves_out = false;  ///< the channel is not judged by, and the others are
};

/// How much of a signature one record shows.
struct SignatureScore {
  int signature = 0;  ///< index into Kinematics::signatures
  double order = 0;   ///< where it was found; off the nominal one only within slip or tolerance
  double depth = 0;   ///< amplitude of its own lines over the rms of the mesh; of blows over that
                      ///< of all gear lines; median over the channels, without noise
  double amplitude = not_known;  ///< that depth times the rms it refers to, in the channel's unit;
                                 ///< median over the channels
  bool by_noise = false;         ///< it is how the noise swings that shows it, not lines of its own
  double in_phase = not_known;   ///< blow_phases() of a part that strikes: median over the channels
  double depth2_variance = 0;    ///< of the squared depth, by the record's noise
  double log_likelihood_ratio = 0;  ///< against noise, over lines and channels, less what its
                                    ///< decoys have
  double p_value = 1;               ///< of the ratio, for all orders searched
  int imf = 0;      ///< 1-based: whose envelope shows the part's order most; 0 if none does
  int channel = 0;  ///< index into Examination::channels: where it is deepest
  std::vector<double> line_orders;         ///< the deepest lines of the signature, and
  std::vector<double> line_depths;         ///< the depth of each
  std::vector<double> channel_amplitudes;  ///< in the unit of each channel; 0: it does not show;
                                           ///< empty: noise alone shows it
  double smallest_visible = not_known;  ///< the least depth that this record would have shown with
                                        ///< 90 %
  double article_statistic = 0;  ///< −ln p of the line at its order in the envelopes of IMF 1 to 5,
                                 ///< summed over channels: all the article asks

  /// Whether any line of it could be read: noise moves whatever was.
  bool is_read() const { return depth > 0 || depth2_variance > 0; }
};

/// Damage makes families of at least as many lines.
inline constexpr int harmonics_of_damage = 4;

/// A family of lines that follows the shaft, and that no part of the machine explains.
struct UnknownFamily {
  double spacing = 0;  ///< orders
  int harmonics = 0;
  int sidebands = 0;
  bool is_locked = false;  ///< to the shaft, as gears are; else it slips, as a bearing does
  double severity = 0;     ///< as a part's
  double p_value = 1;
  std::vector<std::string> points = {};  ///< sources of the records that show it
};

/// A line of the order spectrum of the signal itself, well above its surroundings.
struct SpectralLine {
  double order = 0;
  double frequency_Hz = 0;
  double amplitude = 0;  ///< 0-to-peak, in the unit of the channel
  double p_value = 1;
  std::string meaning;  ///< "sun-planet mesh x2"; empty if the kinematics does not explain it
  int harmonics = 0;    ///< of a family of unexplained lines: how many it has, and how many
  int sidebands = 0;    ///< sidebands of meshes
};

struct ChannelExamination {
  std::string name;
  std::string unit;
  double rms = 0;
  double peak = 0;
  double kurtosis = 0;
  std::vector<double> imf_correlation;  ///< with the signal, IMF 1..K (the article's Table 5)
  std::vector<SpectralLine> lines;      ///< strongest first
  std::vector<Indicator> indicators = {};
  std::vector<GearResidual> residuals =
      {};  ///< of gears whose turn could be averaged; not in files
};

/// One record, examined.
struct Examination {
  std::string source;
  double speed_rpm = not_known;  ///< by the angle, or by the meshes' lines near what was stated
  bool angle_measured = false;   ///< else orders are as sure as the speed
  double load_pct = not_known;
  int repeat = 0;
  double periods = 0;       ///< output turns (or input turns) that the record spans
  bool resolvable = false;  ///< long enough to part the orders that the kinematics asks for
  std::vector<ChannelExamination> channels;
  std::vector<SignatureScore> scores;  ///< one per signature
  std::vector<UnknownFamily> unknown = {};
  std::vector<QualityNote> quality;
  std::vector<Indicator> indicators = {};  ///< of torques and angles
  bool of_hysteresis = false;  ///< the shaft went to and fro: it tells of torsion, not of vibration
};

/// Exponent with which something grows; NaN if it is not known.
struct Growth {
  double exponent = not_known;
  double error = not_known;    ///< half of the 95 % interval
  double freedom = not_known;  ///< degrees of freedom of the error
};

/// How what a part modulates grows over the matrix.
struct GrowthLaw {
  Growth load;
  Growth speed;  ///< the path to the sensors is in it
};

/// One hypothesis, a part that may not be as it should be, weighed by all points.
struct Finding {
  std::string component;
  std::string mechanism;
  std::string table4_item;
  double order = 0;
  double frequency_Hz = 0;          ///< at the first point that shows it
  std::vector<std::string> points;  ///< sources of the records that show it
  std::vector<int> imfs;
  double log_likelihood_ratio = 0;  ///< against noise, summed over all points
  double p_value = 1;               ///< over all points, for everything searched
  double severity = 0;      ///< modulation depth, median over the points that show it; 0 if none
  double severity_low = 0;  ///< of its 95 % interval; where none shows it 0 to what it is below,
                            ///< NaN if no line of it could be read
  double severity_high = 0;
  double severity_m_s2 =
      not_known;  ///< the amplitude behind it: median over the points that show it
  double smallest_visible = not_known;  ///< the least severity that the points would have shown
                                        ///< with 90 %
  double in_phase = not_known;    ///< blow_phases() of a part that strikes: mean over the points
                                  ///< that show it; NaN if none does
  double limit = 0;               ///< of severity
  double over_sound = not_known;  ///< how many scatters of sound units it lies above their median
  double confidence = 0;  ///< 0..1: share of severity over limit, less what growth speaks against
                          ///< it, among all findings; a cause has at least its consequence's
  std::string advice;
  std::vector<double> line_orders;  ///< evidence: the envelope lines, strongest first
  std::vector<double> line_depths;
  GrowthLaw growth;
  double growth_p_value = 1;        ///< of an exponent as far outside what the mechanism allows
  bool growth_fits = true;          ///< false: it is, at 5 %
  std::vector<std::string> one_of;  ///< components that no line of the record can tell apart, this
                                    ///< one first; empty: it stands alone
  std::vector<std::string> cannot_tell_from;  ///< "component: mechanism" that explain it as well
  std::string may_follow_from;  ///< "component: mechanism" of a graver one that makes all its lines

  /// True if the finding names the part, alone or in its set.
  bool may_be(const std::string& part) const;

  /// Whether no point shows it, and none could have shown that it is within its limit.
  bool is_open() const { return points.empty() && !(severity_high <= limit); }
};

struct Diagnosis {
  std::vector<Finding> findings;          ///< above their limit, by confidence
  std::vector<Finding> below_limit;       ///< significant, but within limits
  std::vector<Finding> not_shown;         ///< all other hypotheses, likeliest first
  std::vector<UnknownFamily> unknown;     ///< damage-like, of no part of the machine
  std::vector<SpectralLine> unexplained;  ///< families of lines no kinematics accounts for
  std::vector<QualityNote> quality;
  bool resolvable = false;  ///< at least one record could be judged

  /// All hypotheses: findings, those within limits, those not shown.
  std::vector<const Finding*> hypotheses() const;

  /// The likeliest hypothesis of another part than the first finding's; null without a finding.
  const Finding* second() const;
};

struct ExamineOptions {
  int imfs = 9;
  int sifts = 10;
  double clip_level = not_known;  ///< full scale of the channels, if known
  int channels_may_fail = 0;  ///< that are left out instead of spoiling the record; never so many
                              ///< that fewer than four remain, or than two thirds
};

/// Examines the acceleration channels of one record: quality, EMD, envelope spectra of the
/// relevant IMFs over the measured shaft angle, and the score of every signature.
///
/// Shape   channels of one rate and length, or groups of such; angle and torque channels may differ
/// Units   orders of the input shaft; depths over the mean envelope; those of the channels
/// Errors  never throws for what was measured: bad data becomes quality notes
/// Source  Xie, Cheng & Li, Vibration Diagnosis and Optimization of Industrial Robot Based on TPA
///         and EMD Methods: "the article"; p-values and signatures are ours, it judges by eye
Examination examine(const Recording& record, const Kinematics& kinematics,
                    const ExamineOptions& options = {});

/// Weighs the examinations of all points of a run (or of one file) into findings.
///
/// Shape   any number of points, none among them → findings, by confidence
/// Units   of the examinations; limits are those of the kinematics
/// Errors  none thrown; no point that could be judged is `resolvable` false
/// Source  combined_p_value() over the points; what explains what is ours
Diagnosis conclude(const std::vector<Examination>& points, const Kinematics& kinematics);

}  // namespace rvbench::analysis
