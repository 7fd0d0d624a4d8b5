#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace rvbench::sim {

/// A rigid body with six coordinates: the way of its centre of mass [m], then its turns [rad]
/// about X, Y and Z, all small.
struct RigidBody {
  std::string name;
  double mass_kg = 0;
  Eigen::Vector3d gyration_m;  ///< radii about the centre; X, Y, Z are its principal axes
  Eigen::Vector3d centre_m;    ///< at rest, in the machine's coordinates
};

using SixDirections = Eigen::Matrix<double, 6, 1>;

inline constexpr int ground = -1;

/// A spring between two bodies at one place: what it gives way by is the way of `to` less that of
/// `from` there, in six directions.
struct FlexibleJoint {
  int from = ground;  ///< body, or ground
  int to = 0;
  Eigen::Vector3d at_m;
  SixDirections stiffness;    ///< N/m along X, Y, Z; N·m/rad about them
  SixDirections loss_factor;  ///< energy lost in a cycle over 2π times that stored
};

/// A place on a body where a sensor sits or a hammer hits.
struct BodyPoint {
  std::string name;
  int body = 0;
  Eigen::Vector3d at_m;
};

/// Bodies on springs; it moves little about its rest.
///
///     M·d²q/dt² + K·q = f,   q: six coordinates of each body, one after the other
///
/// Leaves out: gravity, gyroscopic moments, play, and that stiffness depends on pose and load
/// Source: Craig & Kurdila, Fundamentals of Structural Dynamics, 2nd ed., ch. 8
struct Structure {
  std::vector<RigidBody> bodies;
  std::vector<FlexibleJoint> joints;

  Eigen::Index coordinates() const { return 6 * static_cast<Eigen::Index>(bodies.size()); }
};

/// @throws std::invalid_argument if a mass or radius is not above 0, a stiffness or loss factor
///         below 0, a value not finite, or a joint between bodies that are not there
void require_sound(const Structure& structure);

Eigen::MatrixXd mass_matrix(const Structure& structure);       ///< n x n; kg and kg·m²
Eigen::MatrixXd stiffness_matrix(const Structure& structure);  ///< n x n; N/m, N, N·m/rad

/// What a joint gives way by, in its six directions, for each coordinate: 6 x n.
Eigen::MatrixXd give_of(const Structure& structure, const FlexibleJoint& joint);

/// How a point moves along X, Y and Z, and turns about them, for each coordinate: 6 x n.
/// Its transpose takes force [N] and moment [N·m] at the point to the coordinates.
Eigen::MatrixXd motion_of(const Structure& structure, const BodyPoint& point);

}  // namespace rvbench::sim
