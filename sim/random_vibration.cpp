#include "sim/random_vibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "hal/types/linear_algebra.hpp"
#include "hal/types/units.hpp"
#include "sim/linear_flow.hpp"
#include "sim/named.hpp"

namespace rvbench::sim {
namespace {

using Complex = std::complex<double>;

constexpr double same_frequency = 1e-9;  // relative: swells that are one line
constexpr double told_apart = 1e-6;      // relative: poles closer than that give no shapes

std::optional<hal::ConfigFault> fault_of(const PlantSpec& plant, const PlantModel& model) {
  for (std::size_t i = 0; i < model.terms.size(); ++i) {
    const PhysicsTerm* term = model.terms[i].get();
    if (!term->is_linear() && dynamic_cast<const RandomSource*>(term) == nullptr) {
      return hal::ConfigFault{
          0, fmt::format("/terms/{}", i),
          fmt::format("what {} makes of a random vibration is not known", term->name())};
    }
  }
  if (!model.prescribed.empty()) {
    return hal::ConfigFault{0, "/inputs", "a vibration is not solved about a prescribed motion"};
  }
  for (std::size_t o = 0; o < plant.outputs.size(); ++o) {
    if (plant.outputs[o].kind > OutputKind::acceleration) {
      return hal::ConfigFault{0, fmt::format("/outputs/{}/is", o),
                              "of a random vibration only ways, speeds and accelerations are told"};
    }
  }
  return std::nullopt;
}

// What a sensor makes of a way that turns at this rate.
Complex sensed(const OutputSpec& output, double omega_rad_s) {
  const Complex rate(0, omega_rad_s);
  switch (output.kind) {
    case OutputKind::speed: return output.gain.value * rate;
    case OutputKind::acceleration: return output.gain.value * rate * rate;
    default: return output.gain.value;
  }
}

void add_swell(std::vector<RandomForce::Swell>& all, const RandomForce::Swell& swell) {
  const auto known = std::ranges::find_if(all, [&](const RandomForce::Swell& other) {
    return std::abs(other.frequency_Hz - swell.frequency_Hz) <= same_frequency * swell.frequency_Hz;
  });
  if (known == all.end()) {
    all.push_back(swell);
  } else {
    known->depth += swell.depth;
  }
}

Eigen::VectorXd roots_of_density(const RandomForce& force, const Eigen::VectorXd& frequency_Hz) {
  return frequency_Hz.unaryExpr(
      [&](double f_Hz) { return std::sqrt(std::max(0.0, force.density_per_Hz(f_Hz))); });
}

}  // namespace

std::variant<RandomVibration, hal::ConfigFault> RandomVibration::make(const PlantSpec& plant,
                                                                      const TermLibrary& library) {
  auto made = make_model(plant, library);
  if (const auto* fault = std::get_if<hal::ConfigFault>(&made)) return *fault;
  RandomVibration vibration(plant, std::get<PlantModel>(std::move(made)));
  const PlantModel& model = vibration.model_;
  if (auto fault = fault_of(plant, model)) return *std::move(fault);
  for (const OutputSpec& output : plant.outputs) {
    vibration.seen_.push_back(index_of(plant.bodies, output.of));
  }
  const Eigen::Index n = model.inertia.size();
  const auto [stiffness, damping] = linear_parts(model);
  const LinearBodies bodies(model.inertia, stiffness, damping);
  const algebra::EigenPairs modes = algebra::eigen_pairs(bodies.a);
  vibration.poles_rad_s_ = modes.values;
  const double fastest_rad_s = vibration.poles_rad_s_.cwiseAbs().maxCoeff();
  if (!(vibration.poles_rad_s_.real().maxCoeff() < told_apart * fastest_rad_s)) {
    return hal::ConfigFault{0, "/terms", "not stable: a vibration grows without end"};
  }
  const algebra::ComplexLu inverse(modes.vectors);
  if (!(inverse.reciprocal_condition() > told_apart * told_apart)) {
    return hal::ConfigFault{0, "/terms", "two modes are one and the same: they have no shapes"};
  }
  vibration.shapes_ = modes.vectors.topRows(n);
  vibration.participation_ = inverse.solve(Eigen::MatrixXcd(bodies.b.cast<Complex>()));
  return vibration;
}

// What an output shows of a push with each frequency.
Eigen::VectorXcd RandomVibration::response(std::size_t output, const Eigen::VectorXd& push,
                                           const Eigen::VectorXd& frequency_Hz) const {
  const Eigen::VectorXcd residue =
      shapes_.row(seen_[output]).transpose().cwiseProduct(participation_ * push.cast<Complex>());
  return frequency_Hz.cast<Complex>().unaryExpr([&](const Complex& f_Hz) {
    const double omega_rad_s = units::two_pi * f_Hz.real();
    Complex way = 0;
    for (Eigen::Index p = 0; p < residue.size(); ++p) {
      way += residue[p] / (Complex(0, omega_rad_s) - poles_rad_s_[p]);
    }
    return way * sensed(plant_->outputs[output], omega_rad_s);
  });
}

Vibration RandomVibration::under(const Eigen::VectorXd& inputs, std::size_t output,
                                 const FrequencyBand& band) const {
  const Eigen::VectorXd u = si_inputs(model_, inputs);
  std::vector<RandomForce> forces;
  for (const auto& term : model_.terms) {
    if (const auto* source = dynamic_cast<const RandomSource*>(term.get())) {
      source->add_random(u, model_.inertia.size(), forces);
    }
  }
  const auto frequency_Hz = Eigen::VectorXd::NullaryExpr(band.size(), [&](Eigen::Index i) {
                              return band.frequency_Hz(i);
                            }).eval();
  Vibration vibration{Eigen::VectorXd::Zero(band.size()), {}};
  for (const RandomForce& force : forces) {
    const auto excited_at = [&](const Eigen::VectorXd& at_Hz) {
      return response(output, force.push, at_Hz)
          .cwiseProduct(roots_of_density(force, at_Hz).cast<Complex>())
          .eval();
    };
    const Eigen::VectorXcd excited = excited_at(frequency_Hz);
    vibration.density += excited.cwiseAbs2();
    for (const RandomForce::Swell& swell : force.swells) {
      const auto within = static_cast<Eigen::Index>(
          std::max(0.0, (band.high_Hz - swell.frequency_Hz - band.low_Hz) / band.step_Hz + 1));
      if (within == 0 || swell.depth == 0) continue;
      const Eigen::VectorXcd beside =
          excited_at(frequency_Hz.head(within).array() + swell.frequency_Hz);
      const Complex together = excited.head(within).dot(beside);
      add_swell(vibration.swells, {swell.frequency_Hz, swell.depth * std::abs(together)});
    }
  }
  const double power = vibration.density.sum();
  if (!(power > 0)) vibration.swells.clear();
  for (RandomForce::Swell& swell : vibration.swells) swell.depth /= power;
  return vibration;
}

}  // namespace rvbench::sim
