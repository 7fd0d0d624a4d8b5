#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/kinematics.hpp"
#include "bench/judgement.hpp"
#include "bench/population.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::bench {

/// What a report is made of.
struct ReportInput {
  Judgement judgement;
  analysis::Kinematics kinematics;

  /// The samples of judgement.points[i]; nullopt if they cannot be had. Called one at a time.
  std::function<std::optional<Recording>(std::size_t point)> load;
  std::string plan_json;  ///< resolved; empty if there was no plan
  std::string rig_json;
  std::vector<std::pair<std::string, std::string>> hashes;  ///< file name, SHA-256
  Population population = {};                               ///< of a unit that was run
};

/// report.html: one self-contained page with inline SVG and CSS, no script and no reference to
/// anything outside.
std::string make_report(const ReportInput& input);

}  // namespace rvbench::bench
