#include "sim/random_vibration.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "hal/types/units.hpp"
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
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(n, n), damping = stiffness;
  for (const auto& term : model.terms) term->add_linear(stiffness, damping);
  const Eigen::VectorXd mobility = model.inertia.cwiseInverse();
  Eigen::MatrixXd flow = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  flow.topRightCorner(n, n).setIdentity();
  flow.bottomLeftCorner(n, n) = -(mobility.asDiagonal() * stiffness);
  flow.bottomRightCorner(n, n) = -(mobility.asDiagonal() * damping);
  const Eigen::EigenSolver<Eigen::MatrixXd> modes(flow);
  vibration.poles_rad_s_ = modes.eigenvalues();
  const double fastest_rad_s = vibration.poles_rad_s_.cwiseAbs().maxCoeff();
  if (!(vibration.poles_rad_s_.real().maxCoeff() < told_apart * fastest_rad_s)) {
    return hal::ConfigFault{0, "/terms", "not stable: a vibration grows without end"};
  }
  const Eigen::MatrixXcd vectors = modes.eigenvectors();
  const Eigen::PartialPivLU<Eigen::MatrixXcd> inverse(vectors);
  if (!(inverse.rcond() > told_apart * told_apart)) {
    return hal::ConfigFault{0, "/terms", "two modes are one and the same: they have no shapes"};
  }
  vibration.shapes_ = vectors.topRows(n);
  Eigen::MatrixXcd pushes = Eigen::MatrixXcd::Zero(2 * n, n);
  pushes.bottomRows(n).diagonal() = mobility.cast<Complex>();
  vibration.participation_ = inverse.solve(pushes);
  return vibration;
}

// What each output shows of a push with each frequency, one row for each output.
Eigen::MatrixXcd RandomVibration::responses(const Eigen::VectorXd& push,
                                            const Eigen::VectorXd& frequency_Hz) const {
  const Eigen::VectorXcd excited = participation_ * push.cast<Complex>();
  Eigen::MatrixXcd shown = Eigen::MatrixXcd::Zero(Eigen::Index(seen_.size()), frequency_Hz.size());
  for (std::size_t o = 0; o < seen_.size(); ++o) {
    const Eigen::VectorXcd residue = shapes_.row(seen_[o]).transpose().cwiseProduct(excited);
    for (Eigen::Index i = 0; i < frequency_Hz.size(); ++i) {
      const double omega_rad_s = units::two_pi * frequency_Hz[i];
      Complex way = 0;
      for (Eigen::Index p = 0; p < residue.size(); ++p) {
        way += residue[p] / (Complex(0, omega_rad_s) - poles_rad_s_[p]);
      }
      shown(Eigen::Index(o), i) = way * sensed(plant_->outputs[o], omega_rad_s);
    }
  }
  return shown;
}

std::vector<Vibration> RandomVibration::under(const Eigen::VectorXd& inputs,
                                              const FrequencyBand& band) const {
  Eigen::VectorXd u(inputs.size());
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    const SignalTap& tap = model_.taps[static_cast<std::size_t>(i)];
    u[i] = tap.gain * inputs[i] + tap.offset;
  }
  std::vector<RandomForce> forces;
  for (const auto& term : model_.terms) {
    if (const auto* source = dynamic_cast<const RandomSource*>(term.get())) {
      source->add_random(u, model_.inertia.size(), forces);
    }
  }
  Eigen::VectorXd frequency_Hz(band.size());
  for (Eigen::Index i = 0; i < band.size(); ++i) frequency_Hz[i] = band.frequency_Hz(i);
  std::vector<Vibration> all(seen_.size(), {Eigen::VectorXd::Zero(band.size()), {}});
  for (const RandomForce& force : forces) {
    const Eigen::MatrixXcd excited =
        responses(force.push, frequency_Hz) * roots_of_density(force, frequency_Hz).asDiagonal();
    for (std::size_t o = 0; o < all.size(); ++o) {
      all[o].density += excited.row(Eigen::Index(o)).cwiseAbs2().transpose();
    }
    for (const RandomForce::Swell& swell : force.swells) {
      const auto within = static_cast<Eigen::Index>(
          std::max(0.0, (band.high_Hz - swell.frequency_Hz - band.low_Hz) / band.step_Hz + 1));
      if (within == 0 || swell.depth == 0) continue;
      const Eigen::VectorXd beside_Hz = frequency_Hz.head(within).array() + swell.frequency_Hz;
      const Eigen::MatrixXcd beside =
          responses(force.push, beside_Hz) * roots_of_density(force, beside_Hz).asDiagonal();
      for (std::size_t o = 0; o < all.size(); ++o) {
        const auto row = static_cast<Eigen::Index>(o);
        const Complex together =
            (beside.row(row).array() * excited.row(row).head(within).array().conjugate()).sum();
        add_swell(all[o].swells, {swell.frequency_Hz, swell.depth * std::abs(together)});
      }
    }
  }
  for (Vibration& vibration : all) {
    const double power = vibration.density.sum();
    if (!(power > 0)) vibration.swells.clear();
    for (RandomForce::Swell& swell : vibration.swells) swell.depth /= power;
  }
  return all;
}

}  // namespace rvbench::sim
