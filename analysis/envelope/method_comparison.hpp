#pragma once

#include <Eigen/Core>
#include <string_view>
#include <vector>

#include "analysis/envelope/tested_spectrum.hpp"

namespace rvbench::analysis {

/// Ways to ask an envelope how often something is struck.
enum class EnvelopeMethod {
  emd,          ///< envelopes of the IMFs, as the article does
  kurtogram,    ///< squared envelope of the band of the fast kurtogram
  coherence,    ///< enhanced envelope spectrum of the whitened signal
  prewhitened,  ///< squared envelope of all bands after cepstrum pre-whitening
};

inline constexpr EnvelopeMethod envelope_methods[] = {
    EnvelopeMethod::emd, EnvelopeMethod::kurtogram, EnvelopeMethod::coherence,
    EnvelopeMethod::prewhitened};

/// "EMD", "kurtogram", "spectral coherence", "cepstrum pre-whitening": for reports.
/// Errors  none thrown. Source  ours
std::string_view name_of(EnvelopeMethod method);

/// A frequency at which a part would show, in Hz; an order if the samples are even in shaft angle.
struct CandidateLine {
  double frequency = 0;
  double within = 0;  ///< to both sides: how far the part may slip
};

/// What one method shows at one candidate.
struct MethodEvidence {
  EnvelopeMethod method = EnvelopeMethod::emd;

  /// Amplitude and threshold: of EMD, depth of the envelope's swing over its mean; of a squared
  /// envelope, depth of the power's; of the coherence, rms of |γ|. Do not compare those of
  /// different methods, compare p-values.
  LineEvidence line;
  double from = 0;  ///< band that was looked at, in the unit of the candidates
  double to = 0;
  int imf = 0;  ///< 1-based, where EMD shows most; 0 for the other methods
};

struct ComparisonOptions {
  double false_alarm_rate = 1e-3;  ///< of each method at each candidate
  int imfs = 9;
  int sifts = 10;  ///< per IMF
  int coherence_bands = 64;
};

/// What each method found at each candidate.
struct MethodComparison {
  double false_alarm_rate = 0;
  std::vector<std::vector<MethodEvidence>> evidence;  ///< [candidate][method], as envelope_methods

  /// Whether a method found a candidate: it is above its threshold.
  bool found(std::size_t candidate, EnvelopeMethod method) const;

  /// Candidates that EMD found, over those that any method found; NaN if none found any.
  double share_of_emd() const;
};

/// Four ways beside each other, so that what each one adds can be seen.
///
/// IMFs count if they correlate with the signal by 0.1 at least, and the p-value is for all of
/// them. The band of the kurtogram is at least twice as wide as the highest candidate; where none
/// stands out of noise, it is the whole.
///
/// Shape   N samples, at least 256
/// Units   those of the rate: Hz, or orders for samples per turn
/// Limits  the speed must be steady, or the samples even in shaft angle and the rate in samples per
///         turn; those of EMD's envelope reach half the mean frequency of the IMF
/// Errors  throws std::invalid_argument: of fast_kurtogram(), emd() and spectral_coherence(), and
///         for a candidate that is not above 0 and below a quarter of the rate
/// Source  of emd(), fast_kurtogram(), enhanced_envelope_spectrum(), cepstrum_prewhitened(); that
///         they are held to one rate of false alarms is ours
MethodComparison compare_methods(const Eigen::Ref<const Eigen::VectorXd>& x, double rate,
                                 const std::vector<CandidateLine>& candidates,
                                 const ComparisonOptions& options = {});

}  // namespace rvbench::analysis
