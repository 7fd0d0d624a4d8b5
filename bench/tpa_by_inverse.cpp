#include "bench/tpa_by_inverse.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace rvbench::bench {
namespace {

void read_by_inverse(hal::ConfigReader& json, TpaProject& project) {
  need_indicators(json, project);
}

MadeTpaMethod make_by_inverse(const TpaProject& project, const TpaFrfs& frfs,
                              analysis::OperatingSpectra motion) {
  return std::make_unique<ByInverse>(project, frfs, std::move(motion));
}

}  // namespace

ByInverse::ByInverse(const TpaProject& project, const TpaFrfs& frfs,
                     analysis::OperatingSpectra motion)
    : frfs_(frfs),
      motion_(std::move(motion)),
      roles_(project.indicators, project.targets, project.validation),
      rule_(analysis::find_rule(project.rule)->rule) {}

analysis::PathContributions ByInverse::contributions(const analysis::FrfMatrix& frfs,
                                                     const std::vector<Eigen::Index>& blocks,
                                                     unsigned threads) const {
  // How much is inverted is one answer of all blocks; a few of them, some twice, would say less.
  return analysis::over_blocks(analysis::matrix_inverse_contributions(
                                   frfs, motion_, roles_, rule_, frfs_.coherent.is_used, threads),
                               blocks);
}

MethodFindings ByInverse::findings(const analysis::PathContributions& whole) const {
  MethodFindings found;
  found.faults =
      analysis::faults_before_inversion(Eigen::Index(roles_.indicators().size()),
                                        frfs_.matrix.values.columns, frfs_.coherent.is_used);
  std::ranges::move(analysis::faults_of_inversion(frfs_.matrix, motion_, roles_, whole),
                    std::back_inserter(found.faults));
  return found;
}

void need_indicators(hal::ConfigReader& json, const TpaProject& project) {
  if (project.indicators.size() >= project.paths.size()) return;
  json.object("sensors").fault("indicators",
                               fmt::format("{} indicators cannot tell the forces at {} paths",
                                           project.indicators.size(), project.paths.size()));
}

NamedTpaMethod inverse_method() {
  return {"matrix_inverse",
          "Forces are found line by line from the indicators, by an inverse of their FRFs.", true,
          read_by_inverse, make_by_inverse};
}

}  // namespace rvbench::bench
