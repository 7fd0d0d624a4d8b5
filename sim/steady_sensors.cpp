#include "sim/steady_sensors.hpp"

#include "hal/types/recording.hpp"
#include "sim/named.hpp"

namespace rvbench::sim {

SteadySensors::SteadySensors(const PlantSpec& plant, const PlantModel& model) : plant_(plant) {
  for (const OutputSpec& output : plant.outputs) {
    const bool of_term = output.kind == OutputKind::effort;
    places_.push_back(of_term ? index_of(plant.terms, output.of)
                              : index_of(plant.bodies, output.of));
    joints_.push_back(of_term ? Joint::at(model.terms, std::size_t(places_.back())) : Joint());
  }
}

bool SteadySensors::is_linear(Eigen::Index output) const {
  const auto o = static_cast<std::size_t>(output);
  return plant_.outputs[o].kind != OutputKind::effort || joints_[o].is_linear();
}

double SteadySensors::value(Eigen::Index output, const PlantState& s,
                            const Eigen::VectorXd& acceleration) const {
  const auto o = static_cast<std::size_t>(output);
  return plant_.outputs[o].gain.value * unscaled(o, s, acceleration);
}

Eigen::VectorXd SteadySensors::values(const PlantState& s,
                                      const Eigen::VectorXd& acceleration) const {
  Eigen::VectorXd values(static_cast<Eigen::Index>(places_.size()));
  for (Eigen::Index o = 0; o < values.size(); ++o) values[o] = value(o, s, acceleration);
  return values;
}

double SteadySensors::unscaled(std::size_t output, const PlantState& s,
                               const Eigen::VectorXd& acceleration) const {
  const int body = places_[output];
  switch (plant_.outputs[output].kind) {
    case OutputKind::position: return s.q[body];
    case OutputKind::speed: return s.v[body];
    case OutputKind::acceleration: return acceleration[body];
    case OutputKind::effort: return joints_[output].passed(s);
    case OutputKind::drive: break;
  }
  return not_known;
}

}  // namespace rvbench::sim
