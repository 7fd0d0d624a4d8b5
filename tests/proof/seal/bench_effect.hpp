#pragma once

#include <Eigen/Core>
#include <vector>

namespace seal {

/// Where the bodies of the train stand in its vectors.
enum Body { motor, sun, planet_1, planet_2, carrier, brake, train_bodies };

/// The linear part of a train: inertias, and elastic links across arms of coordinates.
struct Structure {
  struct Link {
    Eigen::VectorXd arm;  ///< per body; its stretch is arm·q
    double stiffness = 0, damping = 0;
  };
  std::vector<double> inertia;
  std::vector<Link> links;

  /// @return the new body's place
  int add_body(double value) {
    inertia.push_back(value);
    return static_cast<int>(inertia.size()) - 1;
  }
  /// Between two bodies, or from the first to the ground (second < 0).
  void add_spring(int first, int second, double stiffness, double damping);
};

/// What an effect sees of a train.
struct Moment {
  double time_s = 0;
  double supply_Hz = 0;
  double electrical_rad = 0;  ///< phase of the inverter's output
  double brake_Nm = 0;        ///< that the brake is asked for
  double motor_Nm = 0;        ///< of the motor, without ripple
  double slip_rad_s = 0;      ///< how fast the field runs past the rotor, electrical
  const Eigen::VectorXd& q;   ///< rad
  const Eigen::VectorXd& v;   ///< rad/s
};

/// Something that acts in a bench. All that it does not override, it leaves alone. Effects are made
/// with a size of 1 in their own unit, and scaled.
class BenchEffect {
 public:
  virtual ~BenchEffect() = default;
  virtual void join(Structure&) {}
  virtual void push(const Moment&, double /*step_s*/, Eigen::VectorXd& /*torque_Nm*/) {}
  /// What the coupling passes beside what its spring and damper do: pushed, and seen.
  virtual double coupling_Nm(const Moment&) { return 0; }
  virtual double mesh_error_m(int /*mesh*/, double /*sun_rad*/, double /*planet_rad*/) { return 0; }
  virtual double mesh_softening(int /*mesh*/, double /*sun_rad*/) { return 0; }  ///< relative
  virtual double stage_error_rad(int /*stage*/, double /*crank_rad*/) { return 0; }
  virtual double supply_Hz(double /*time_s*/, double asked_Hz) { return asked_Hz; }
  virtual double shown_torque_Nm(double /*time_s*/, double torque_Nm) { return torque_Nm; }
};

}  // namespace seal
