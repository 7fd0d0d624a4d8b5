#include "sim/rv_train.hpp"

#include <Eigen/LU>
#include <cmath>
#include <stdexcept>

#include "hal/types/units.hpp"
#include "sim/named.hpp"

namespace rvbench::sim {
namespace {

using units::two_pi;

// The speed at which the brake's dry friction changes sign: assumed.
constexpr double brake_creep_speed_rad_s = 0.05;
constexpr double rounding = 1e-6;  // far above it, and far below what a turn would do to a term

PlantModel model_of(const PlantSpec& plant) {
  for (const hal::ConfigFault& fault : rv_plant_faults(plant)) {
    throw std::invalid_argument("RvTrain: " + fault.pointer + ": " + fault.message);
  }
  return std::get<PlantModel>(make_model(plant));
}

// The motion that strains no spring, per turn of one body; empty if there is not just one.
Eigen::VectorXd free_motion(const Plant& plant, int body) {
  const Eigen::Index n = plant.state().q.size();
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(n, n), damping = stiffness;
  for (const auto& term : plant.terms()) term->add_linear(stiffness, damping);
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(stiffness);
  if (lu.dimensionOfKernel() != 1) return {};
  const Eigen::VectorXd motion = lu.kernel().col(0);
  return motion / motion[body];
}

// Whether a term pushes otherwise once everything has turned by this.
bool can_tell(const PhysicsTerm& term, const PlantState& here, const Eigen::VectorXd& turn_rad) {
  PlantState there = here;
  there.q += turn_rad;
  Eigen::VectorXd before = Eigen::VectorXd::Zero(here.q.size()), after = before;
  term.add_force(here, before);
  term.add_force(there, after);
  return (after - before).norm() > rounding * before.norm();
}

}  // namespace

RvTrain::RvTrain(const PlantSpec& plant, const RvUnit& unit, double step_s)
    : RvTrain(model_of(as_built(plant, unit)), plant, step_s) {}

RvTrain::RvTrain(PlantModel model, const PlantSpec& plant, double step_s)
    : plant_(std::move(model), step_s),
      motor_(index_of(plant.bodies, rv_parts::motor)),
      input_shaft_(index_of(plant.bodies, rv_parts::input_shaft)),
      carrier_(index_of(plant.bodies, rv_parts::carrier)),
      brake_(index_of(plant.bodies, rv_parts::brake)),
      supply_input_(static_cast<std::size_t>(index_of(plant.inputs, rv_parts::supply))),
      brake_input_(static_cast<std::size_t>(index_of(plant.inputs, rv_parts::brake_torque))) {
  for (const auto& term : plant_.terms()) {
    if (auto* motor = dynamic_cast<InductionMotor*>(term.get())) motors_.push_back(motor);
    if (auto* mesh = dynamic_cast<PlanetMesh*>(term.get())) meshes_.push_back(mesh);
  }
  find_stages();
  coupling_ = joint_of(motor_, input_shaft_);
  output_ = joint_of(carrier_, brake_);
  find_output_turn();
  set_supply(0, false);
}

void RvTrain::find_stages() {
  for (const PlanetMesh* mesh : meshes_) {
    for (const auto& term : plant_.terms()) {
      const auto* stage = dynamic_cast<const CycloidStage*>(term.get());
      if (stage != nullptr && stage->params().crank == mesh->params().planet) {
        stages_.push_back(stage);
        break;
      }
    }
  }
}

RvTrain::Joint RvTrain::joint_of(int body_a, int body_b) const {
  Joint joint;
  for (const auto& term : plant_.terms()) {
    const auto* between = dynamic_cast<const OneAxisTerm*>(term.get());
    if (between == nullptr) continue;
    const Axis axis = between->axis();
    if (axis.body_a == body_a && axis.body_b == body_b) joint.emplace_back(between, 1);
    if (axis.body_a == body_b && axis.body_b == body_a) joint.emplace_back(between, -1);
  }
  return joint;
}

double RvTrain::passed_Nm(const Joint& joint) const {
  double torque_Nm = 0;
  for (const auto& [term, sign] : joint) torque_Nm += sign * term->effort(state());
  return torque_Nm;
}

void RvTrain::find_output_turn() {
  const Eigen::VectorXd turns = free_motion(plant_, carrier_);
  if (turns.size() == 0) return;
  const Eigen::VectorXd whole = turns.array().round();
  if ((turns - whole).cwiseAbs().maxCoeff() > rounding) return;
  PlantState here = state();
  here.q = Eigen::VectorXd::LinSpaced(here.q.size(), 0.1, 0.2);
  for (const auto& term : plant_.terms()) {
    if (can_tell(*term, here, two_pi * whole)) return;
  }
  output_turn_rad_ = two_pi * whole;
}

void RvTrain::set_supply(double frequency_Hz, bool enabled) {
  plant_.set_input(supply_input_, frequency_Hz);
  for (InductionMotor* motor : motors_) motor->switch_on(enabled);
}

void RvTrain::step() {
  plant_.set_input(brake_input_,
                   brake_setpoint_Nm_ * creeping_sign(state().v[brake_], brake_creep_speed_rad_s));
  plant_.step();
}

void RvTrain::wrap() {
  if (output_turn_rad_.size() == 0 || std::abs(state().q[carrier_]) < two_pi) return;
  const double turns = std::trunc(state().q[carrier_] / two_pi);
  plant_.shift(-turns * output_turn_rad_);
  wrapped_turns_ += turns;
}

double RvTrain::motor_torque_Nm() const {
  double torque_Nm = 0;
  for (const InductionMotor* motor : motors_) torque_Nm += motor->torque_Nm(state());
  return torque_Nm;
}

double RvTrain::input_angle_rad() const {
  const double wrapped_rad =
      output_turn_rad_.size() == 0 ? 0 : wrapped_turns_ * output_turn_rad_[input_shaft_];
  return shaft_angle_rad() + wrapped_rad;
}

double RvTrain::crank_angle_rad(std::size_t k) const {
  return meshes_[k]->planet_angle_rad(state());
}

double RvTrain::place_rad(std::size_t k) const { return meshes_[k]->place_in_housing_rad(state()); }

}  // namespace rvbench::sim
