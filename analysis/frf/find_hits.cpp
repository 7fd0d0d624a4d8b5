#include "analysis/frf/find_hits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/frf/force_pulse.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {

std::vector<FrfRecord> find_hits(const FrfRecord& record, const HitSearch& search) {
  constexpr Require require{"find_hits"};
  require(record.rate_Hz > 0 && record.excitations.cols() == 1, "needs a rate and one excitation");
  require(record.responses.rows() == record.excitations.rows(), "channels differ in length");
  require(search.before_s >= 0 && search.length_s > search.before_s, "length must exceed before_s");
  require(search.least_share > 0 && search.least_share < 1, "least_share must be within 0 and 1");
  const ForcePulse strongest = force_pulse(record.excitations.col(0));
  const Eigen::VectorXd raw = record.excitations.col(0);
  const double sign = strongest.height < 0 ? -1 : 1;
  const double trigger = std::max(search.least_share * std::abs(strongest.height),
                                  ForcePulse::noise_widths * strongest.noise);
  const auto before = Eigen::Index(std::lround(search.before_s * record.rate_Hz));
  const auto length = Eigen::Index(std::lround(search.length_s * record.rate_Hz));

  std::vector<FrfRecord> hits;
  const auto is_up = [&](Eigen::Index i) { return sign * (raw[i] - strongest.rest) > trigger; };
  for (Eigen::Index i = 0; i < raw.size(); ++i) {
    if (!is_up(i) || (i > 0 && is_up(i - 1))) continue;
    const Eigen::Index from = std::max<Eigen::Index>(i - before, 0);
    if (from + length > raw.size()) break;
    hits.push_back({fmt::format("{} at {:.4g} s", record.source, double(i) / record.rate_Hz),
                    record.rate_Hz, record.excitations.middleRows(from, length),
                    record.responses.middleRows(from, length)});
    i = from + length - 1;
  }
  return hits;
}

}  // namespace rvbench::analysis
