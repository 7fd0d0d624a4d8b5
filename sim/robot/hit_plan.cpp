#include "sim/robot/hit_plan.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "sim/robot/virtual_robot.hpp"
#include "sim/robot/white_noise.hpp"

namespace rvbench::sim {
namespace {

constexpr std::array<std::string_view, 5> kinds{"good", "double hit", "overload", "weak",
                                                "misdirected"};

Eigen::Vector3d normal_deviates(Draw& draw) {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(3);
  add_white_noise(values, 1, draw.seed());
  return values;
}

// The direction leant over by this angle, towards any side.
Eigen::Vector3d leant(const Eigen::Vector3d& aim, Eigen::Index axis, double angle_rad, Draw& draw) {
  const double side_rad = draw.phase_rad();
  Eigen::Vector3d leaning = std::cos(angle_rad) * aim;
  leaning[(axis + 1) % 3] += std::sin(angle_rad) * std::cos(side_rad);
  leaning[(axis + 2) % 3] += std::sin(angle_rad) * std::sin(side_rad);
  return leaning;
}

void spoil(HitPlan& hit, HitKind kind, Draw& draw) {
  hit.kind = kind;
  if (kind == HitKind::double_hit) {
    hit.second_after_s = draw.uniform(0.005, 0.025);
    hit.second_share = draw.uniform(0.25, 0.6);
  }
  if (kind == HitKind::overload) hit.peak_N = draw.uniform(600, 900);
  if (kind == HitKind::weak) hit.peak_N = draw.uniform(4, 10);
  if (kind == HitKind::misdirected) {
    const double angle_rad = draw.uniform(35, 55) * std::numbers::pi / 180;
    hit.direction = leant(hit.direction, hit.path % 3, angle_rad, draw);
  }
}

HitPlan good_hit(Eigen::Index path, int number, double tip_s, const RobotOptions& options,
                 Draw& draw) {
  const double scatter = options.hit_scatter;
  const Eigen::Index axis = path % 3;
  HitPlan hit;
  hit.path = path;
  hit.number = number;
  hit.peak_N = nominal_peak_N * draw.within_factor(1.25);
  hit.width_s = tip_s * draw.uniform(0.9, 1.1);
  hit.start_s = pre_trigger_s + draw.uniform(0, 1) / options.rate_Hz;
  hit.told_share = 1 + 0.7 * scatter * normal_deviates(draw)[0];
  hit.direction = 0.4 * scatter * normal_deviates(draw);
  hit.direction[axis] = 1;
  hit.arm_m = 0.03 * scatter * normal_deviates(draw);
  hit.noise_seed = draw.seed();
  return hit;
}

}  // namespace

std::string_view to_string(HitKind kind) { return kinds[static_cast<std::size_t>(kind)]; }

std::vector<HitPlan> plan_hits(const RobotOptions& options) {
  Draw draw = draw_for(options, "hits");
  const double tip_s = draw.uniform(0.6e-3, 0.9e-3);
  std::vector<HitPlan> hits;
  for (Eigen::Index path = 0; path < VirtualRobot::paths; ++path) {
    int bad = 0;
    for (int number = 1; number <= options.hits; ++number) {
      HitPlan hit = good_hit(path, number, tip_s, options, draw);
      const bool goes_wrong = draw.uniform(0, 1) < options.bad_hit_share;
      const auto kind = static_cast<HitKind>(1 + static_cast<int>(draw.uniform(0, 4)));
      if (goes_wrong && bad < options.hits / 2) {
        spoil(hit, kind, draw);
        ++bad;
      }
      hits.push_back(hit);
    }
  }
  return hits;
}

}  // namespace rvbench::sim
