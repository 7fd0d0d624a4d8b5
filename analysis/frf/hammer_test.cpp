#include "analysis/frf/hammer_test.hpp"

#include <fmt/format.h>

#include <cmath>

#include "analysis/frf/unlike_hits.hpp"
#include "analysis/statistics.hpp"

namespace rvbench::analysis {

namespace {

double median_height(const std::vector<HammerResult>& results) {
  std::vector<double> heights;
  for (const HammerResult& result : results) {
    for (const JudgedHit& hit : result.hits) {
      if (hit.accepted()) heights.push_back(std::abs(hit.pulse.height));
    }
  }
  return heights.empty() ? 0 : median(heights);
}

void reject_weak(JudgedHit& hit, double least, const std::string& unit) {
  const double height = std::abs(hit.pulse.height);
  if (!hit.accepted() || height >= least) return;
  hit.faults.push_back({HitFaultKind::weak, height, least,
                        fmt::format("weak hit: peak of {:.3g} {}, {:.3g} is the least beside the "
                                    "session's other hits",
                                    height, unit, least)});
}

void reject_unequal(JudgedHit& hit, const FrfRecord& record, const FrfRecord& first) {
  if (record.rate_Hz == first.rate_Hz && record.responses.rows() == first.responses.rows()) return;
  hit.faults.push_back({HitFaultKind::unequal, record.rate_Hz, first.rate_Hz,
                        fmt::format("unequal: {} samples at {:.6g} Hz, {} at {:.6g} Hz before",
                                    record.responses.rows(), record.rate_Hz, first.responses.rows(),
                                    first.rate_Hz)});
}

void reject_unlike(HammerResult& result, std::vector<std::size_t>& used,
                   std::vector<FrfRecord>& windowed, double most) {
  const Eigen::VectorXd distances = distances_to_others(windowed);
  for (Eigen::Index i = distances.size() - 1; i >= 0; --i) {
    const double distance = distances[i];
    if (distance <= most) continue;
    result.hits[used[std::size_t(i)]].faults.push_back(
        {HitFaultKind::unlike_others, distance, most,
         fmt::format("unlike others: {:.0f} % from what most hits at this place gave, at most "
                     "{:.0f} % is allowed: off in direction or place",
                     100 * distance, 100 * most)});
    used.erase(used.begin() + i);
    windowed.erase(windowed.begin() + i);
  }
}

void average(const HammerSeries& series, const HammerOptions& options, HammerResult& result) {
  std::vector<std::size_t> used;
  std::vector<FrfRecord> accepted;
  for (std::size_t i = 0; i < series.hits.size(); ++i) {
    if (!result.hits[i].accepted()) continue;
    if (!used.empty()) reject_unequal(result.hits[i], series.hits[i], series.hits[used.front()]);
    if (!result.hits[i].accepted()) continue;
    used.push_back(i);
    accepted.push_back(windowed_hit(series.hits[i], options.windows));
  }
  reject_unlike(result, used, accepted, options.most_apart);
  if (accepted.empty()) return;
  result.estimates =
      estimate_responses(hit_spectra(accepted), series.setup, options.estimator,
                         fmt::format("{} of {} hits from {}", accepted.size(), series.hits.size(),
                                     series.hits.front().source));
  if (options.deviations_in.to_Hz > 0) {
    result.deviations = hit_deviations(accepted, options.deviations_in);
  }
  if (!std::isfinite(options.windows.decay_s)) return;
  for (EstimatedResponse& pair : result.estimates.responses) {
    pair.response.notes.push_back(
        fmt::format("exponential window of {:.4g} s: adds {:.4g} rad/s to each mode's decay",
                    options.windows.decay_s, 1 / options.windows.decay_s));
  }
}

}  // namespace

std::vector<HammerResult> measure_session(const std::vector<HammerSeries>& session,
                                          const HammerOptions& options) {
  std::vector<HammerResult> results;
  for (const HammerSeries& series : session) {
    HammerResult& result = results.emplace_back();
    for (const FrfRecord& record : series.hits) {
      result.hits.push_back(judge_hit(record, series.setup, options.limits, options.windows));
    }
  }
  const double least = options.least_share_of_median * median_height(results);
  for (std::size_t s = 0; s < session.size(); ++s) {
    for (JudgedHit& hit : results[s].hits) {
      reject_weak(hit, least, session[s].setup.excitations.front().unit);
    }
    average(session[s], options, results[s]);
  }
  return results;
}

}  // namespace rvbench::analysis
