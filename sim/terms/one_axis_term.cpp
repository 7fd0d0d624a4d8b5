#include "sim/terms/one_axis_term.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace rvbench::sim {

void OneAxisTerm::add_between(Eigen::MatrixXd& m, double value) const {
  const int a = axis_.body_a, b = axis_.body_b;
  m(a, a) += value;
  if (b == housing) return;
  m(b, b) += value;
  m(a, b) -= value;
  m(b, a) -= value;
}

double OneAxisTerm::mobility(const Eigen::VectorXd& inertia) const {
  const double at_a = 1 / inertia[axis_.body_a];
  return axis_.body_b == housing ? at_a : at_a + 1 / inertia[axis_.body_b];
}

LinearAxisTerm::LinearAxisTerm(std::string_view name, Axis axis, double stiffness, double damping)
    : OneAxisTerm(name, axis), stiffness_(stiffness), damping_(damping) {
  if (!std::isfinite(stiffness) || !std::isfinite(damping)) {
    throw std::invalid_argument(std::string(name) + ": stiffness and damping must be finite");
  }
}

}  // namespace rvbench::sim
