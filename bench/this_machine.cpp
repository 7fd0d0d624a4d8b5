#include "bench/this_machine.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "analysis/quality.hpp"
#include "analysis/quality/gear_train_fit.hpp"

namespace rvbench::bench {
namespace {

// What the same lines would say of another speed; empty if nothing.
std::string at_better_speed(const analysis::GearTrainFit& fit,
                            const std::vector<analysis::Examination>& points) {
  if (std::isnan(fit.best_speed)) return "";
  std::string speeds;
  for (const analysis::Examination& point : points) {
    if (point.angle_measured) return "";
    const std::string speed = fmt::format("{:.1f}", fit.best_speed * point.speed_rpm);
    if (speeds.find(speed) == std::string::npos) speeds += (speeds.empty() ? "" : ", ") + speed;
  }
  return fmt::format("; at {} rpm it would be {:.0f} %: is that the speed?", speeds,
                     100 * fit.best_share);
}

}  // namespace

std::string why_not_this_machine(const Judgement& judgement,
                                 const analysis::Kinematics& kinematics) {
  std::vector<analysis::Examination> examined;
  for (const JudgedPoint& point : judgement.points) examined.push_back(point.examination);
  const bool has_own_lines = analysis::has_own_lines(kinematics);
  const bool shows_shaft = analysis::shows_shaft(examined, judgement.diagnosis, kinematics);
  if (!has_own_lines && shows_shaft) return "";
  const analysis::GearTrainFit fit = analysis::gear_train_fit(examined, kinematics);
  if (has_own_lines && fit.is_shown()) return "";
  const std::string better = at_better_speed(fit, examined);
  if (!shows_shaft) {
    return "no line of this machine is in the data, so nothing confirms its speed, the sample rate "
           "or that it is this machine" +
           better;
  }
  return fmt::format(
      "the lines in the data are not this machine's: {:.0f} % of their power lies on its orders, "
      "no "
      "more than by chance (as much at {:.0f} % of other speeds): it is another machine, or the "
      "speed or the sample rate is wrong{}",
      100 * fit.share, 100 * fit.chance, better);
}

}  // namespace rvbench::bench
