#include "sim/plant_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "hal/types/linear_algebra.hpp"
#include "hal/types/units.hpp"
#include "sim/linear_flow.hpp"
#include "sim/named.hpp"
#include "sim/plant_check.hpp"
#include "sim/term_memory.hpp"
#include "sim/terms/dry_friction.hpp"

namespace rvbench::sim {
namespace {

constexpr double steps_per_period = 24;
constexpr double steps_per_sample_of_dry_friction = 4;

// Index in PlantState::u: motions are no part of it.
int input_index(const PlantSpec& plant, std::string_view name) {
  int index = 0;
  for (const InputSpec& input : plant.inputs) {
    if (input.name == name) return index;
    if (input.kind < InputKind::position) ++index;
  }
  return -1;
}

std::unique_ptr<PhysicsTerm> make_term(const PlantSpec& plant, const TermSpec& spec,
                                       const TermType& type, const PlantModel& model) {
  TermSite site;
  site.axis = {index_of(plant.bodies, spec.body_a), index_of(plant.bodies, spec.body_b)};
  site.parameters = &spec.parameters;
  switch (type.gate.reference) {
    case ReferenceKind::none: break;
    case ReferenceKind::input:
    case ReferenceKind::push: site.input = input_index(plant, spec.reference); break;
    case ReferenceKind::body: site.body = index_of(plant.bodies, spec.reference); break;
    case ReferenceKind::term:
      site.term =
          model.terms[static_cast<std::size_t>(index_of(plant.terms, spec.reference))].get();
  }
  return type.make(site);
}

void place_memories(PlantModel& model) {
  for (const auto& term : model.terms) {
    if (auto* memory = dynamic_cast<TermMemory*>(term.get())) {
      memory->place(model.memory_size);
      model.memory_size += memory->size();
    }
  }
}

// Taps of one body's position, speed and acceleration, from what is recorded of them.
class MotionTaps {
 public:
  void add(const InputSpec& input, int column) {
    const double gain = input.gain.value, offset = input.offset.value;
    switch (input.kind) {
      case InputKind::position:
        take(0, 3, {column, gain, offset, 0});
        take(1, 1, {column + 1, gain, 0, 0});
        take(2, 1, {column + 2, gain, 0, 0});
        break;
      case InputKind::speed:
        take(0, 1, {column, gain, 0, offset});
        take(1, 3, {column + 1, gain, offset, 0});
        take(2, 2, {column + 2, gain, 0, 0});
        break;
      case InputKind::acceleration: take(2, 3, {column, gain, offset, 0}); break;
      case InputKind::force:
      case InputKind::signal: break;
    }
  }
  bool any() const { return rank_[0] > 0; }
  // @param start  of a position that is known by its speed only
  void append_to(std::vector<SignalTap>& taps, double start) {
    if (rank_[0] == 1) taps_[0].offset += start;
    taps.insert(taps.end(), taps_.begin(), taps_.end());
  }

 private:
  // The better source wins: recorded (3) before differentiated once (2) before the rest (1).
  void take(std::size_t which, int rank, const SignalTap& tap) {
    if (rank <= rank_[which]) return;
    rank_[which] = rank;
    taps_[which] = tap;
  }

  std::array<int, 3> rank_{};
  std::array<SignalTap, 3> taps_{};
};

void wire_inputs(const PlantSpec& plant, PlantModel& model) {
  int column = 0;
  std::vector<MotionTaps> motions(plant.bodies.size());
  for (const InputSpec& input : plant.inputs) {
    const int body = index_of(plant.bodies, input.body);
    if (input.kind < InputKind::position) {
      model.pushed.push_back(input.kind == InputKind::force ? body : -1);
      model.taps.push_back({column, input.gain.value, input.offset.value, 0});
    } else {
      motions[static_cast<std::size_t>(body)].add(input, column);
    }
    column += columns_of(input.kind);
  }
  for (std::size_t body = 0; body < motions.size(); ++body) {
    if (!motions[body].any()) continue;
    model.prescribed.push_back(static_cast<int>(body));
    motions[body].append_to(model.taps, plant.bodies[body].start_position);
  }
}

// rad/s of the fastest mode that bodies, springs and dampers have.
double fastest_mode_rad_s(const PlantModel& model) {
  auto [stiffness, damping] = linear_parts(model);
  for (const int body : model.prescribed) {
    stiffness.row(body).setZero();
    damping.row(body).setZero();
  }
  const LinearBodies bodies(model.inertia, stiffness, damping);
  return algebra::eigenvalues(bodies.a).cwiseAbs().maxCoeff();
}

}  // namespace

int columns_of(InputKind kind) {
  return kind == InputKind::position || kind == InputKind::speed ? 3 : 1;
}

LinearParts linear_parts(const PlantModel& model) {
  const Eigen::Index n = model.inertia.size();
  LinearParts parts{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n)};
  for (const auto& term : model.terms) term->add_linear(parts.stiffness, parts.damping);
  return parts;
}

Eigen::VectorXd si_inputs(const PlantModel& model, const Eigen::VectorXd& inputs) {
  Eigen::VectorXd u(static_cast<Eigen::Index>(model.pushed.size()));
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    const SignalTap& tap = model.taps[static_cast<std::size_t>(i)];
    u[i] = tap.gain * inputs[tap.column] + tap.offset;
  }
  return u;
}

std::variant<PlantModel, hal::ConfigFault> make_model(const PlantSpec& plant,
                                                      const TermLibrary& library) {
  std::vector<hal::ConfigFault> faults = check_plant(plant, library);
  if (!faults.empty()) return std::move(faults.front());
  PlantModel model;
  const auto n = static_cast<Eigen::Index>(plant.bodies.size());
  model.inertia.resize(n);
  model.start_position.resize(n);
  model.start_speed.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const BodySpec& body = plant.bodies[static_cast<std::size_t>(i)];
    model.inertia[i] = body.inertia.value;
    model.start_position[i] = body.start_position;
    model.start_speed[i] = body.start_speed;
  }
  for (std::size_t i = 0; i < plant.terms.size(); ++i) {
    const TermSpec& spec = plant.terms[i];
    try {
      model.terms.push_back(make_term(plant, spec, *library.find(spec.type), model));
    } catch (const std::invalid_argument& refused) {
      return hal::ConfigFault{0, "/terms/" + std::to_string(i), refused.what()};
    }
  }
  place_memories(model);
  wire_inputs(plant, model);
  return model;
}

double substeps_wanted(const PlantModel& model, double rate_Hz) {
  double fastest_rad_s = 0;
  bool dry = false, linear = true;
  for (const auto& term : model.terms) {
    if (term->is_affine()) continue;
    if (dynamic_cast<const DryFriction*>(term.get()) != nullptr) {
      dry = true;
      continue;
    }
    linear = false;
    fastest_rad_s = std::max(fastest_rad_s, term->fastest_rad_s(model.inertia));
  }
  const bool stands = model.prescribed.size() == static_cast<std::size_t>(model.inertia.size());
  if (stands && model.memory_size == 0) return 1;
  if (!linear && !stands) fastest_rad_s = std::max(fastest_rad_s, fastest_mode_rad_s(model));
  const double wanted = fastest_rad_s / units::two_pi * steps_per_period / rate_Hz;
  return std::max({1.0, std::ceil(wanted), dry && !stands ? steps_per_sample_of_dry_friction : 1});
}

}  // namespace rvbench::sim
