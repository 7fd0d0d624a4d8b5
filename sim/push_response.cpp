#include "sim/push_response.hpp"

#include <complex>

#include "hal/types/linear_algebra.hpp"
#include "hal/types/units.hpp"
#include "sim/named.hpp"
#include "sim/steady_sensors.hpp"

namespace rvbench::sim {
namespace {

using Complex = std::complex<double>;

constexpr double way_step = 1e-7;  // m or rad
constexpr double speed_step_of_speed = 1e-6;

// What the outputs gain with each body's coordinate, speed and acceleration: outputs x bodies.
struct Slopes {
  Eigen::MatrixXd of_way, of_speed, of_acceleration;
};

Slopes slopes_of(const SteadySensors& sensors, const SteadyMotion& motion) {
  const Eigen::Index n = motion.common().size();
  PlantState s = motion.mean_state(0);
  Eigen::VectorXd acceleration = Eigen::VectorXd::Zero(n);
  const auto slopes = [&](Eigen::VectorXd& x, double step) {
    std::vector<Eigen::VectorXd> columns;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double middle = x[i];
      x[i] = middle + step;
      const Eigen::VectorXd above = sensors.values(s, acceleration);
      x[i] = middle - step;
      columns.emplace_back((above - sensors.values(s, acceleration)) / (2 * step));
      x[i] = middle;
    }
    Eigen::MatrixXd all(columns.front().size(), n);
    for (Eigen::Index i = 0; i < n; ++i) all.col(i) = columns[std::size_t(i)];
    return all;
  };
  return {slopes(s.q, way_step),
          slopes(s.v, speed_step_of_speed * motion.common().cwiseAbs().maxCoeff() *
                          std::abs(motion.speed_rad_s())),
          slopes(acceleration, 1)};
}

bool joins_bodies(const PlantSpec& plant, const TermSpec& term, const PhysicsTerm& model) {
  const int a = index_of(plant.bodies, term.body_a);
  if (a < 0 || index_of(plant.bodies, term.body_b) < 0) return false;
  const auto n = static_cast<Eigen::Index>(plant.bodies.size());
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(n, n), damping = stiffness;
  model.add_linear(stiffness, damping);
  return stiffness(a, a) > 0;
}

// What 1 N or N·m at each site is on the bodies, and what of it sensors are passed.
struct Pushes {
  Eigen::MatrixXcd on_bodies, passed;
};

Pushes pushes_at(const std::vector<PushSite>& sites, const PlantSpec& plant,
                 const PlantModel& model) {
  const auto n = static_cast<Eigen::Index>(plant.bodies.size());
  const auto count = static_cast<Eigen::Index>(sites.size());
  Pushes pushes{Eigen::MatrixXcd::Identity(n, count),
                Eigen::MatrixXcd::Zero(Eigen::Index(plant.outputs.size()), count)};
  for (Eigen::Index i = n; i < count; ++i) {
    const int term = index_of(plant.terms, sites[std::size_t(i)].name);
    const TermSpec& spec = plant.terms[std::size_t(term)];
    const int a = index_of(plant.bodies, spec.body_a);
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(n, n), damping = stiffness;
    model.terms[std::size_t(term)]->add_linear(stiffness, damping);
    pushes.on_bodies.col(i) = (-stiffness.col(a) / stiffness(a, a)).cast<Complex>();
    for (std::size_t o = 0; o < plant.outputs.size(); ++o) {
      const OutputSpec& output = plant.outputs[o];
      const TermSpec* seen = plant.find_term(output.of);
      if (output.kind != OutputKind::effort || !seen->is_between(spec.body_a, spec.body_b))
        continue;
      pushes.passed(Eigen::Index(o), i) =
          seen->body_a == spec.body_a ? output.gain.value : -output.gain.value;
    }
  }
  return pushes;
}

}  // namespace

std::vector<PushSite> push_sites(const PlantSpec& plant, const PlantModel& model) {
  std::vector<PushSite> sites;
  for (const BodySpec& body : plant.bodies) sites.push_back({body.name, body.name, false});
  for (std::size_t i = 0; i < plant.terms.size(); ++i) {
    const TermSpec& term = plant.terms[i];
    if (!joins_bodies(plant, term, *model.terms[i])) continue;
    sites.push_back({term.name, term.body_a, true});
  }
  return sites;
}

std::optional<PushResponse> push_response(const PlantSpec& plant, const PlantModel& model,
                                          const SteadyMotion& motion,
                                          const std::vector<double>& frequencies_Hz) {
  const Slopes slopes = slopes_of(SteadySensors(plant, model), motion);
  const Eigen::Index n = motion.common().size();
  PushResponse response;
  response.sites = push_sites(plant, model);
  const Pushes pushes = pushes_at(response.sites, plant, model);
  for (const double frequency_Hz : frequencies_Hz) {
    const double omega_rad_s = units::two_pi * frequency_Hz;
    const Eigen::MatrixXcd shown = slopes.of_way.cast<Complex>() +
                                   Complex(0, omega_rad_s) * slopes.of_speed.cast<Complex>() -
                                   omega_rad_s * omega_rad_s * slopes.of_acceleration;
    response.lines.emplace_back(
        shown * algebra::ComplexLu(motion.impedance(omega_rad_s)).solve(pushes.on_bodies) +
        pushes.passed);
  }
  const Eigen::VectorXd drag = motion.impedance(1).imag() * motion.common();
  Eigen::MatrixXd balance = Eigen::MatrixXd::Zero(n + 1, n + 1);
  balance.topLeftCorner(n, n) = motion.impedance(0).real();
  balance.topRightCorner(n, 1) = drag;
  balance.bottomLeftCorner(1, n) = motion.common().transpose();
  const std::optional<Eigen::MatrixXd> inverse = algebra::inverse_if_regular(balance);
  if (!inverse) return std::nullopt;
  const Eigen::MatrixXd answer = inverse->leftCols(n);
  response.slowest_rad_s = answer.row(n);
  response.means =
      slopes.of_way * answer.topRows(n) + slopes.of_speed * motion.common() * answer.row(n);
  return response;
}

}  // namespace rvbench::sim
