#pragma once

#include <Eigen/Core>
#include <catch2/catch.hpp>

#include "sim/draw.hpp"
#include "sim/physics_term.hpp"

namespace rvbench::test {

/// A state of n bodies somewhere in the middle of a run.
inline sim::PlantState some_state(Eigen::Index n, std::uint64_t seed) {
  sim::Draw draw(seed);
  sim::PlantState s{Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (double& q : s.q) q = draw.uniform(-3, 3);
  for (double& v : s.v) v = draw.uniform(-100, 100);
  return s;
}

inline Eigen::VectorXd force_of(const sim::PhysicsTerm& term, const sim::PlantState& s) {
  Eigen::VectorXd f = Eigen::VectorXd::Zero(s.q.size());
  term.add_force(s, f);
  return f;
}

/// −dV/dq by central differences.
inline Eigen::VectorXd minus_slope_of_stored_energy(const sim::PhysicsTerm& term,
                                                    const sim::PlantState& s) {
  constexpr double h = 1e-4;
  Eigen::VectorXd slope(s.q.size());
  for (Eigen::Index i = 0; i < s.q.size(); ++i) {
    sim::PlantState up = s, down = s;
    up.q[i] += h;
    down.q[i] -= h;
    slope[i] = (term.stored_energy_J(down) - term.stored_energy_J(up)) / (2 * h);
  }
  return slope;
}

/// What every term owes the plant, whatever its physics.
inline void check_plumbing(const sim::PhysicsTerm& term, const sim::PlantState& s) {
  INFO(term.name());
  const Eigen::Index n = s.q.size();
  const Eigen::VectorXd force = force_of(term, s);
  REQUIRE(force.norm() > 0);
  const double margin = 1e-9 * force.norm();

  const Eigen::VectorXd before = Eigen::VectorXd::LinSpaced(n, 1, 5);
  Eigen::VectorXd after = before;
  term.add_force(s, after);
  CHECK((after - before - force).norm() < margin);  // adds, never assigns

  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Constant(n, n, 7);
  Eigen::MatrixXd damping = Eigen::MatrixXd::Constant(n, n, 9);
  term.add_linear(stiffness, damping);
  stiffness.array() -= 7;
  damping.array() -= 9;
  Eigen::VectorXd split = -stiffness * s.q - damping * s.v;
  term.add_remainder(s, split);
  CHECK((split - force).norm() < margin);  // linear part and remainder make the whole

  CHECK(term.dissipated_power_W(s) >= 0);
}

/// The power a term takes from the bodies goes into store or heat, or it was supplied. Holds for
/// terms whose parameters do not change with the angle.
inline void check_energy_book(const sim::PhysicsTerm& term, const sim::PlantState& s) {
  INFO(term.name());
  const double given_W = force_of(term, s).dot(s.v);
  const double released_W = minus_slope_of_stored_energy(term, s).dot(s.v);
  const double book_W = released_W + term.supplied_power_W(s) - term.dissipated_power_W(s);
  CHECK(given_W == Approx(book_W).epsilon(1e-6));

  sim::PlantState at_rest = s;
  at_rest.v.setZero();
  const Eigen::VectorXd force = force_of(term, at_rest);
  CHECK((force - minus_slope_of_stored_energy(term, at_rest)).norm() <= 1e-6 * force.norm());
  CHECK(term.dissipated_power_W(at_rest) == 0);
}

}  // namespace rvbench::test
