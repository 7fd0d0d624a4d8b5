#include "bench/this_machine.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "analysis/quality.hpp"
#include "analysis/quality/gear_train_fit.hpp"
#include "bench/judging.hpp"

namespace rvbench::bench {
namespace {

// What the same lines would say of another speed; empty if nothing.
std::string at_better_speed(const analysis::GearTrainFit& fit,
                            const std::vector<analysis::Examination>& points) {
  if (std::isnan(fit.best_speed) || fit.fits_a_ratio) return "";
  std::vector<std::string> speeds;
  for (const analysis::Examination& point : points) {
    if (point.angle_measured) return "";
    std::string speed = fmt::format("{:.1f}", fit.best_speed * point.speed_rpm);
    if (std::ranges::find(speeds, speed) == speeds.end()) speeds.push_back(std::move(speed));
  }
  return fmt::format("; at {} rpm it would be {:.0f} %: is that the speed?",
                     fmt::join(speeds, ", "), 100 * fit.best_share);
}

std::string why_not_shown(const analysis::GearTrainFit& fit) {
  if (fit.is_too_short) {
    return "the records are too short to tell this machine's lines from those of another";
  }
  if (fit.tried == 0) {
    return "no line is in the data but those of its input shaft, which any machine has: nothing "
           "says that it is this one";
  }
  if (fit.fits_a_ratio) {
    return fmt::format(
        "the lines in the data fit this machine as well at {:.3g} times the speed, {:.0f} % of "
        "their power against {:.0f} %: the speed or the sample rate may be wrong by that",
        fit.best_speed, 100 * fit.best_share, 100 * fit.share);
  }
  return fmt::format(
      "the lines in the data are not shown to be this machine's: {:.0f} % of their power lies on "
      "its orders, and at {} of {} other speeds they fit as well: it may be another machine, or "
      "the speed or the sample rate is wrong",
      100 * fit.share, fit.as_good, fit.tried);
}

}  // namespace

std::string what_confirms_it(const Judgement& judgement, const analysis::Kinematics& kinematics) {
  if (analysis::has_own_lines(kinematics)) return "";
  const std::vector<analysis::Examination> examined = examined_points(judgement);
  if (std::ranges::all_of(examined, &analysis::Examination::angle_measured)) return "";
  return "it has no teeth whose lines would tell: that speed and sample rate are right rests on "
         "the line of its shaft alone";
}

std::string why_not_this_machine(const Judgement& judgement,
                                 const analysis::Kinematics& kinematics) {
  const std::vector<analysis::Examination> examined = examined_points(judgement);
  const bool has_own_lines = analysis::has_own_lines(kinematics);
  const bool shows_shaft = analysis::shows_shaft(examined, judgement.diagnosis, kinematics);
  if (!has_own_lines && shows_shaft) return "";
  const analysis::GearTrainFit fit = analysis::gear_train_fit(examined, kinematics);
  if (has_own_lines && fit.is_shown()) return "";
  const std::string why =
      shows_shaft ? why_not_shown(fit)
                  : "no line of this machine is in the data, so nothing confirms its speed, the "
                    "sample rate or that it is this machine";
  return why + at_better_speed(fit, examined);
}

}  // namespace rvbench::bench
