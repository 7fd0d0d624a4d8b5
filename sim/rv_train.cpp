#include "sim/rv_train.hpp"

#include <cmath>
#include <stdexcept>

#include "hal/types/recording.hpp"
#include "hal/types/units.hpp"
#include "sim/common_motion.hpp"
#include "sim/named.hpp"

namespace rvbench::sim {
namespace {

using units::two_pi;

// The speed at which the brake's dry friction changes sign: assumed.
constexpr double brake_creep_speed_rad_s = 0.05;
constexpr double rounding = 1e-6;  // far above it, and far below what a turn would do to a term

PlantModel model_of(const PlantSpec& plant, double step_s) {
  for (const hal::ConfigFault& fault : rv_plant_faults(plant, 1 / step_s)) {
    throw std::invalid_argument("RvTrain: " + fault.pointer + ": " + fault.message);
  }
  return std::get<PlantModel>(make_model(plant));
}

// What all bodies turn while one makes a turn, after which no term can tell the difference; empty
// if there is no such motion.
Eigen::VectorXd whole_turn(const PlantModel& model, int body) {
  const auto common = common_motion(model);
  if (!std::holds_alternative<Eigen::VectorXd>(common)) return {};
  const Eigen::VectorXd turns =
      std::get<Eigen::VectorXd>(common) / std::get<Eigen::VectorXd>(common)[body];
  const Eigen::VectorXd whole = turns.array().round();
  if ((turns - whole).cwiseAbs().maxCoeff() > rounding || held_by(model, whole) != nullptr)
    return {};
  return two_pi * whole;
}

}  // namespace

RvTrain::RvTrain(const PlantSpec& plant, const RvUnit& unit, double step_s)
    : RvTrain(model_of(as_built(plant, unit), step_s), plant, step_s) {}

RvTrain::RvTrain(PlantModel model, const PlantSpec& plant, double step_s)
    : output_turn_rad_(whole_turn(model, index_of(plant.bodies, rv_parts::carrier))),
      plant_(std::move(model), step_s),
      motor_(index_of(plant.bodies, rv_parts::motor)),
      input_shaft_(index_of(plant.bodies, rv_parts::input_shaft)),
      carrier_(index_of(plant.bodies, rv_parts::carrier)),
      brake_(index_of(plant.bodies, rv_parts::brake)),
      supply_input_(static_cast<std::size_t>(index_of(plant.inputs, rv_parts::supply))),
      brake_input_(static_cast<std::size_t>(index_of(plant.inputs, rv_parts::brake_torque))),
      brake_holds_(plant.inputs[brake_input_].kind == InputKind::signal) {
  for (const auto& term : plant_.terms()) {
    if (auto* motor = dynamic_cast<InductionMotor*>(term.get())) motors_.push_back(motor);
    if (auto* mesh = dynamic_cast<PlanetMesh*>(term.get())) meshes_.push_back(mesh);
  }
  find_stages();
  coupling_ = input_joint(plant);
  output_ = Joint::between(plant_.terms(), carrier_, brake_);
  set_supply(0, false);
}

// Where the plant has its torque transducer, or else between motor and input shaft.
Joint RvTrain::input_joint(const PlantSpec& plant) const {
  for (const OutputSpec& output : plant.outputs) {
    if (output.channel != channel_names::input_torque || output.kind != OutputKind::effort)
      continue;
    return Joint::at(plant_.terms(), static_cast<std::size_t>(index_of(plant.terms, output.of)));
  }
  return Joint::between(plant_.terms(), motor_, input_shaft_);
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

void RvTrain::set_supply(double frequency_Hz, bool enabled) {
  plant_.set_input(supply_input_, frequency_Hz);
  for (InductionMotor* motor : motors_) motor->switch_on(enabled);
}

void RvTrain::step() {
  const double share = brake_holds_ ? 1 : creeping_sign(state().v[brake_], brake_creep_speed_rad_s);
  plant_.set_input(brake_input_, brake_setpoint_Nm_ * share);
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
