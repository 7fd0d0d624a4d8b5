#include "bench/report/matrix_cell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/diagnosis.hpp"

namespace rvbench::bench::report {
namespace {

// The worst modulation depth of a record in units of its limit.
double worst_share(const analysis::Examination& seen, const analysis::Kinematics& kinematics) {
  double worst = 0;
  for (const analysis::SignatureScore& score : seen.scores) {
    const auto index = static_cast<std::size_t>(score.signature);
    if (index >= kinematics.signatures.size() || score.p_value > analysis::significant_p) continue;
    const double limit = kinematics.signatures[index].depth_limit;
    if (score.depth > 0) worst = std::fmax(worst, score.depth / limit);  // a limit of 0: infinite
  }
  return worst;
}

}  // namespace

MatrixCell matrix_cell(const JudgedPoint& point, const analysis::Kinematics& kinematics) {
  if (point.status == not_recorded) return {"absent", "none"};
  if (point.status != "ok") return {"spoiled", point.status};
  if (std::ranges::any_of(point.examination.quality, &analysis::QualityNote::invalidates)) {
    return {"spoiled", "data"};
  }
  if (point.examination.of_hysteresis) return {"torsion", "loop"};
  if (!point.examination.resolvable) return {"spoiled", "short"};
  const double share = worst_share(point.examination, kinematics);
  const char* level = share > 1 ? "high" : share > 0.5 ? "mid-level" : "low";
  return {level, std::isinf(share) ? "above 0" : fmt::format("{:.2f}", share)};
}

}  // namespace rvbench::bench::report
