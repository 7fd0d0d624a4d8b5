#include "sim/robot/structure.hpp"

#include "hal/types/require.hpp"

namespace rvbench::sim {
namespace {

// Of a rigid body: motion at a place by motion of its centre, u + θ × r.
Eigen::Matrix<double, 6, 6> carried_to(const RigidBody& body, const Eigen::Vector3d& at_m) {
  const Eigen::Vector3d r = at_m - body.centre_m;
  Eigen::Matrix<double, 6, 6> carried = Eigen::Matrix<double, 6, 6>::Identity();
  carried.topRightCorner<3, 3>() << 0, r.z(), -r.y(), -r.z(), 0, r.x(), r.y(), -r.x(), 0;
  return carried;
}

Eigen::Index first_of(int body) { return 6 * static_cast<Eigen::Index>(body); }

}  // namespace

void require_sound(const Structure& structure) {
  constexpr Require require{"Structure"};
  const int bodies = static_cast<int>(structure.bodies.size());
  for (const RigidBody& body : structure.bodies) {
    require(body.mass_kg > 0 && (body.gyration_m.array() > 0).all() &&
                body.gyration_m.allFinite() && body.centre_m.allFinite(),
            "body " + body.name + " needs a mass and radii above 0 and a finite centre");
  }
  for (const FlexibleJoint& joint : structure.joints) {
    require(joint.from >= ground && joint.from < bodies && joint.to >= 0 && joint.to < bodies &&
                joint.from != joint.to,
            "a joint between bodies " + std::to_string(joint.from) + " and " +
                std::to_string(joint.to) + " of " + std::to_string(bodies));
    require((joint.stiffness.array() >= 0).all() && joint.stiffness.allFinite() &&
                (joint.loss_factor.array() >= 0).all() && joint.loss_factor.allFinite() &&
                joint.at_m.allFinite(),
            "stiffness and loss factor of a joint must be finite and not below 0");
  }
}

Eigen::MatrixXd mass_matrix(const Structure& structure) {
  Eigen::VectorXd diagonal(structure.coordinates());
  Eigen::Index at = 0;
  for (const RigidBody& body : structure.bodies) {
    diagonal.segment<3>(at).setConstant(body.mass_kg);
    diagonal.segment<3>(at + 3) = body.mass_kg * body.gyration_m.array().square();
    at += 6;
  }
  return diagonal.asDiagonal();
}

Eigen::MatrixXd give_of(const Structure& structure, const FlexibleJoint& joint) {
  Eigen::MatrixXd give = motion_of(structure, {"", joint.to, joint.at_m});
  if (joint.from != ground) give -= motion_of(structure, {"", joint.from, joint.at_m});
  return give;
}

Eigen::MatrixXd stiffness_matrix(const Structure& structure) {
  Eigen::MatrixXd stiffness =
      Eigen::MatrixXd::Zero(structure.coordinates(), structure.coordinates());
  for (const FlexibleJoint& joint : structure.joints) {
    const Eigen::MatrixXd give = give_of(structure, joint);
    stiffness += give.transpose() * joint.stiffness.asDiagonal() * give;
  }
  return stiffness;
}

Eigen::MatrixXd motion_of(const Structure& structure, const BodyPoint& point) {
  constexpr Require require{"motion_of"};
  require(point.body >= 0 && first_of(point.body) < structure.coordinates(),
          "no body " + std::to_string(point.body));
  const RigidBody& body = structure.bodies[static_cast<std::size_t>(point.body)];
  Eigen::MatrixXd motion = Eigen::MatrixXd::Zero(6, structure.coordinates());
  motion.middleCols<6>(first_of(point.body)) = carried_to(body, point.at_m);
  return motion;
}

}  // namespace rvbench::sim
