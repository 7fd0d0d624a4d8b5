#include "sim/robot/robot_arm.hpp"

#include <string>

#include "hal/types/require.hpp"
#include "hal/types/units.hpp"

namespace rvbench::sim {
namespace {

enum Part { foot, turret, lower_arm, elbow, forearm_tube, wrist, flange_and_load, first_gear };

constexpr double frame_loss = 0.03, wrist_loss = 0.04, axis_loss = 0.072, mount_loss = 0.06;
constexpr double from_mount_to_frame_m = 0.12;

std::vector<RigidBody> bodies() {
  return {{"foot", 45, {0.16, 0.16, 0.14}, {0, 0, 0.15}},
          {"turret", 42, {0.14, 0.15, 0.15}, {0.06, 0.01, 0.40}},
          {"lower arm", 26, {0.20, 0.20, 0.08}, {0.17, 0.03, 0.74}},
          {"elbow", 27, {0.11, 0.13, 0.13}, {0.22, -0.02, 1.12}},
          {"forearm", 12, {0.06, 0.17, 0.17}, {0.60, 0.01, 1.17}},
          {"wrist", 4.5, {0.05, 0.06, 0.06}, {0.88, -0.01, 1.17}},
          {"flange and load", 13.2, {0.07, 0.07, 0.08}, {1.02, 0.015, 1.15}},
          {"J1 gear", 8, {0.06, 0.06, 0.05}, {-0.10, 0.03, 0.45}},
          {"J2 gear", 8, {0.06, 0.05, 0.06}, {0.16, -0.14, 0.46}},
          {"J3 gear", 6.5, {0.055, 0.05, 0.055}, {0.17, 0.11, 1.06}},
          {"J4 gear", 3.8, {0.04, 0.05, 0.05}, {0.10, -0.015, 1.20}},
          {"J5 gear", 2.2, {0.03, 0.04, 0.04}, {0.50, 0.015, 1.19}},
          {"J6 gear", 1.6, {0.03, 0.035, 0.035}, {0.86, -0.015, 1.22}}};
}

// An axis: turning about it twists the reducer, in the other directions the main bearing gives.
FlexibleJoint axis_joint(Part from, const Eigen::Vector3d& at_m, int axis, double bearing_N_m,
                         double tilt_Nm_rad, double twist_Nm_rad, double loss) {
  FlexibleJoint joint{from, from + 1, at_m, {}, SixDirections::Constant(loss)};
  joint.stiffness << Eigen::Vector3d::Constant(bearing_N_m), Eigen::Vector3d::Constant(tilt_Nm_rad);
  joint.stiffness[axis] *= 1.4;
  joint.stiffness[3 + axis] = twist_Nm_rad;
  joint.loss_factor[3 + axis] = axis_loss;
  return joint;
}

std::vector<FlexibleJoint> frame_joints() {
  FlexibleJoint floor{ground, foot, {0, 0, 0}, {}, SixDirections::Constant(mount_loss)};
  floor.stiffness << 1e8, 1e8, 2e8, 6e6, 6e6, 6e6;
  return {floor,
          axis_joint(foot, {0, 0, 0.25}, 2, 8e8, 5e6, 4.5e5, frame_loss),
          axis_joint(turret, {0.16, 0, 0.45}, 1, 6e8, 3e6, 4.5e5, frame_loss),
          axis_joint(lower_arm, {0.16, 0, 1.04}, 1, 5e8, 1.6e6, 2.0e5, frame_loss),
          axis_joint(elbow, {0.40, 0, 1.17}, 0, 4e8, 5e5, 6e4, frame_loss),
          axis_joint(forearm_tube, {0.84, 0, 1.17}, 1, 2.4e8, 1.2e5, 1.6e4, wrist_loss),
          axis_joint(wrist, {0.93, 0, 1.17}, 0, 1.75e8, 8e4, 9e3, wrist_loss)};
}

struct GearMount {
  Part carrier;
  double frequency_Hz;  ///< of the gear on its mount along X, the carrier held
};

constexpr std::array<GearMount, robot_joints> mounts{
    {{turret, 230}, {turret, 260}, {elbow, 105}, {elbow, 120}, {forearm_tube, 135}, {wrist, 150}}};

// Where the line from the gear to its carrier's centre leaves so far behind.
Eigen::Vector3d towards(const RigidBody& gear, const RigidBody& carrier, double way_m) {
  return gear.centre_m + (carrier.centre_m - gear.centre_m).normalized() * way_m;
}

FlexibleJoint gear_mount(const Structure& structure, int joint) {
  const GearMount& mount = mounts[static_cast<std::size_t>(joint)];
  const RigidBody& carrier = structure.bodies[mount.carrier];
  const RigidBody& gear = structure.bodies[static_cast<std::size_t>(first_gear + joint)];
  const double omega = units::two_pi * mount.frequency_Hz;
  const double stiffness_N_m = gear.mass_kg * omega * omega;
  const Eigen::Vector3d twist =
      Eigen::Vector3d(1.6, 1.1, 1.9).cwiseProduct(stiffness_N_m * gear.gyration_m.cwiseAbs2());
  FlexibleJoint rubber{mount.carrier,
                       first_gear + joint,
                       towards(gear, carrier, from_mount_to_frame_m / 2),
                       {},
                       SixDirections::Constant(mount_loss)};
  rubber.stiffness << stiffness_N_m * Eigen::Vector3d(1.0, 1.5, 0.8), twist;
  return rubber;
}

// On the gear's housing, off its centre, as there is no sensor inside; left or right in turn.
BodyPoint active_side(const Structure& structure, int joint) {
  const RigidBody& gear = structure.bodies[static_cast<std::size_t>(first_gear + joint)];
  const double side = joint % 2 == 0 ? -1 : 1;
  const Eigen::Vector3d offset = side * gear.gyration_m.x() * Eigen::Vector3d(0.50, 0.33, 0.58);
  return {"J" + std::to_string(joint + 1) + " active", first_gear + joint, gear.centre_m + offset};
}

BodyPoint passive_side(const Structure& structure, int joint) {
  const Part carrier = mounts[static_cast<std::size_t>(joint)].carrier;
  const RigidBody& gear = structure.bodies[static_cast<std::size_t>(first_gear + joint)];
  return {"J" + std::to_string(joint + 1) + " passive", carrier,
          towards(gear, structure.bodies[carrier], from_mount_to_frame_m)};
}

}  // namespace

RobotArm make_robot_arm(Draw draw, double spread) {
  constexpr Require require{"make_robot_arm"};
  require(spread >= 0 && spread <= 0.3, "spread is " + std::to_string(spread) + ", must be 0-0.3");
  RobotArm arm;
  arm.structure = {bodies(), frame_joints()};
  for (int joint = 0; joint < robot_joints; ++joint) {
    arm.structure.joints.push_back(gear_mount(arm.structure, joint));
    arm.active[static_cast<std::size_t>(joint)] = active_side(arm.structure, joint);
    arm.passive[static_cast<std::size_t>(joint)] = passive_side(arm.structure, joint);
  }
  arm.flange = {"flange", flange_and_load, {1.06, 0, 1.17}};
  arm.forearm = {"forearm", forearm_tube, {0.70, 0.04, 1.22}};
  for (FlexibleJoint& joint : arm.structure.joints) {
    for (double& k : joint.stiffness) k *= 1 + draw.uniform(-spread, spread);
    for (double& loss : joint.loss_factor) loss *= 1 + draw.uniform(-0.05, 0.05);
  }
  return arm;
}

}  // namespace rvbench::sim
