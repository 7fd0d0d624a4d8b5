#include "analysis/envelope/method_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "analysis/emd/emd.hpp"
#include "analysis/envelope/kurtogram.hpp"
#include "analysis/envelope/spectral_coherence.hpp"
#include "analysis/envelope/squared_envelope_spectrum.hpp"
#include "analysis/envelope/whitening.hpp"
#include "analysis/hilbert.hpp"
#include "analysis/statistics.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

constexpr double relevant_correlation = 0.1;  // an IMF below it says nothing about the signal
constexpr double beyond_candidates = 200;     // lines, that the floor of the highest is taken from

using Evidence = std::vector<MethodEvidence>;  // one per candidate

struct Task {
  const Eigen::Ref<const Eigen::VectorXd>& x;
  double rate;
  const std::vector<CandidateLine>& candidates;
  const ComparisonOptions& options;

  double highest() const {
    double most = 0;
    for (const CandidateLine& c : candidates) most = std::max(most, c.frequency + c.within);
    return most;
  }
};

struct Imf {
  int number;  // 1-based
  TestedSpectrum envelope;
};

TestedSpectrum depth_of_imf(const Eigen::Ref<const Eigen::VectorXd>& imf, double rate) {
  Spectrum depth = amplitude_spectrum(envelope(imf), rate, Window::hann);
  if (depth.amplitude[0] > 0) depth.amplitude /= depth.amplitude[0];
  const double held = 0.5 * crossing_frequency(imf, rate);
  const auto last = static_cast<Eigen::Index>(held / depth.resolution);
  return tested_against_floor(std::move(depth), last);
}

std::vector<Imf> relevant_imfs(const Task& task) {
  const Emd modes = emd(task.x, {.imfs = task.options.imfs, .sifts = task.options.sifts});
  std::vector<Imf> relevant;
  for (Eigen::Index k = 0; k < modes.imfs.cols(); ++k) {
    if (correlation(modes.imfs.col(k), task.x) < relevant_correlation) continue;
    relevant.push_back({static_cast<int>(k) + 1, depth_of_imf(modes.imfs.col(k), task.rate)});
  }
  return relevant;
}

// The IMF with the least p-value speaks for EMD, and pays for the choice.
Evidence by_emd(const Task& task) {
  const std::vector<Imf> imfs = relevant_imfs(task);
  const double rate = task.options.false_alarm_rate / double(std::max<std::size_t>(imfs.size(), 1));
  Evidence evidence;
  for (const CandidateLine& candidate : task.candidates) {
    MethodEvidence best{EnvelopeMethod::emd, {candidate.frequency}, 0, task.rate / 2, 0};
    for (const Imf& imf : imfs) {
      const LineEvidence line =
          evidence_near(imf.envelope, candidate.frequency, candidate.within, rate);
      if (best.imf > 0 && line.p_value >= best.line.p_value) continue;
      best.line = line;
      best.imf = imf.number;
    }
    best.line.p_value = std::min(1.0, best.line.p_value * double(imfs.size()));
    evidence.push_back(best);
  }
  return evidence;
}

Evidence in_spectrum(const Task& task, EnvelopeMethod method, const TestedSpectrum& tested,
                     double from, double to) {
  Evidence evidence;
  for (const CandidateLine& candidate : task.candidates) {
    evidence.push_back({method,
                        evidence_near(tested, candidate.frequency, candidate.within,
                                      task.options.false_alarm_rate),
                        from, to, 0});
  }
  return evidence;
}

Evidence by_kurtogram(const Task& task) {
  const double untested = double(too_few_products) * task.rate / double(task.x.size());
  const Kurtogram kurtogram =
      fast_kurtogram(task.x, task.rate, {.least_width_Hz = 2 * task.highest() + untested});
  const double from = kurtogram.best ? kurtogram.best->from_Hz : 0;
  const double to = kurtogram.best ? kurtogram.best->to_Hz : task.rate / 2;
  return in_spectrum(task, EnvelopeMethod::kurtogram,
                     squared_envelope_spectrum(task.x, task.rate, from, to), from, to);
}

Evidence by_coherence(const Task& task) {
  const double highest = task.highest() + beyond_candidates * task.rate / double(task.x.size());
  const SpectralCoherence coherence =
      spectral_coherence(floor_whitened(task.x), task.rate,
                         {.highest = highest, .bands = task.options.coherence_bands});
  const double to = coherence.first + coherence.width * task.options.coherence_bands;
  return in_spectrum(task, EnvelopeMethod::coherence, enhanced_envelope_spectrum(coherence),
                     coherence.first, to);
}

Evidence by_prewhitening(const Task& task) {
  return in_spectrum(
      task, EnvelopeMethod::prewhitened,
      squared_envelope_spectrum(cepstrum_prewhitened(task.x), task.rate, 0, task.rate / 2), 0,
      task.rate / 2);
}

}  // namespace

std::string_view name_of(EnvelopeMethod method) {
  switch (method) {
    case EnvelopeMethod::emd: return "EMD";
    case EnvelopeMethod::kurtogram: return "kurtogram";
    case EnvelopeMethod::coherence: return "spectral coherence";
    case EnvelopeMethod::prewhitened: return "cepstrum pre-whitening";
  }
  return {};
}

bool MethodComparison::found(std::size_t candidate, EnvelopeMethod method) const {
  for (const MethodEvidence& e : evidence.at(candidate)) {
    if (e.method == method) return e.line.amplitude > e.line.threshold;
  }
  return false;
}

double MethodComparison::share_of_emd() const {
  double by_any = 0, by_emd_too = 0;
  for (std::size_t i = 0; i < evidence.size(); ++i) {
    const bool any = std::ranges::any_of(envelope_methods,
                                         [&](EnvelopeMethod method) { return found(i, method); });
    by_any += any ? 1 : 0;
    by_emd_too += found(i, EnvelopeMethod::emd) ? 1 : 0;
  }
  return by_any > 0 ? by_emd_too / by_any : std::numeric_limits<double>::quiet_NaN();
}

MethodComparison compare_methods(const Eigen::Ref<const Eigen::VectorXd>& x, double rate,
                                 const std::vector<CandidateLine>& candidates,
                                 const ComparisonOptions& options) {
  constexpr Require require{"compare_methods"};
  for (const CandidateLine& candidate : candidates) {
    require(candidate.frequency > 0 && candidate.frequency + candidate.within < rate / 4,
            "a candidate must be above 0 and below a quarter of the rate");
  }
  MethodComparison comparison{options.false_alarm_rate, {}};
  comparison.evidence.resize(candidates.size());
  if (candidates.empty()) return comparison;
  const Task task{x, rate, candidates, options};
  for (const Evidence& of_method :
       {by_emd(task), by_kurtogram(task), by_coherence(task), by_prewhitening(task)}) {
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      comparison.evidence[i].push_back(of_method[i]);
    }
  }
  return comparison;
}

}  // namespace rvbench::analysis
