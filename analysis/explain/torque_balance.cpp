#include "analysis/explain/torque_balance.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "analysis/statistics.hpp"
#include "hal/types/linear_algebra.hpp"

namespace rvbench::analysis {
namespace {

constexpr double chance = 0.01;
constexpr double least_apart = 1e-9;          // sine of the angle between two answers
constexpr std::size_t fewest_conditions = 5;  // two more than a law has numbers
constexpr Eigen::Index constant = 0, of_load = 1, of_speed = 2;

// A torque under each condition, over columns of the regression.
struct Regression {
  std::vector<Eigen::Index> columns;
  Eigen::VectorXd value, standard_error;  // of each column's factor
  double freedom = 0;

  double p_value(Eigen::Index i) const { return t_p_value(value[i] / standard_error[i], freedom); }
};

Regression regression(const Eigen::MatrixXd& laws, const Eigen::VectorXd& torque_Nm,
                      const Eigen::VectorXd& error_Nm, std::vector<Eigen::Index> columns) {
  const Eigen::VectorXd weight = error_Nm.cwiseInverse();
  const Eigen::MatrixXd x = weight.asDiagonal() * laws(Eigen::all, columns);
  const Eigen::VectorXd y = weight.cwiseProduct(torque_Nm);
  const Eigen::MatrixXd covariance = algebra::SymmetricFactors(algebra::gram(x)).inverse();
  Regression result{std::move(columns), covariance * x.transpose() * y, {}, 0};
  result.freedom = static_cast<double>(x.rows() - x.cols());
  const double scatter = (y - x * result.value).squaredNorm() / result.freedom;
  result.standard_error = (std::max(scatter, 1.0) * covariance.diagonal()).cwiseSqrt();
  return result;
}

// Load and speed from their means, so that the constant is the mean; what does not change is left
// out.
Eigen::MatrixXd centred_laws(const std::vector<TransducerMeans>& conditions,
                             std::vector<Eigen::Index>& columns) {
  Eigen::MatrixXd laws = Eigen::MatrixXd::Ones(Eigen::Index(conditions.size()), 3);
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    laws(Eigen::Index(i), of_load) = conditions[i].torque_Nm;
    laws(Eigen::Index(i), of_speed) = conditions[i].speed_rad_s;
  }
  columns = {constant};
  for (const Eigen::Index column : {of_load, of_speed}) {
    // A load that does not change is drag that grows with speed, a speed that does not is slip.
    const double largest = laws.col(column).cwiseAbs().maxCoeff();
    const double least = laws.col(column).cwiseAbs().minCoeff();
    if (largest - least > 0.5 * largest) columns.push_back(column);
    laws.col(column).array() -= laws.col(column).mean();
  }
  return laws;
}

Regression without_chance(const Eigen::MatrixXd& laws, const Eigen::VectorXd& torque_Nm,
                          const Eigen::VectorXd& error_Nm, std::vector<Eigen::Index> columns) {
  while (true) {
    Regression found = regression(laws, torque_Nm, error_Nm, columns);
    Eigen::Index weakest = 0;
    for (Eigen::Index i = 1; i < found.value.size(); ++i) {
      if (weakest == 0 || found.p_value(i) > found.p_value(weakest)) weakest = i;
    }
    if (weakest == 0 || found.p_value(weakest) <= chance) return found;
    columns.erase(columns.begin() + weakest);
  }
}

// Whether torque and speed answer a torque on the left otherwise than one on the right.
bool parts_sides(const Eigen::Matrix2d& response) {
  const double largest = response.col(0).norm() * response.col(1).norm();
  return largest > 0 && std::abs(response.determinant()) > least_apart * largest;
}

}  // namespace

std::vector<SideBalance> torque_balances(const std::vector<TransducerMeans>& conditions) {
  const bool are_parted = std::ranges::all_of(
      conditions, [](const TransducerMeans& c) { return parts_sides(c.response); });
  if (conditions.size() < fewest_conditions || !are_parted) return {};
  std::vector<Eigen::Index> columns;
  const Eigen::MatrixXd laws = centred_laws(conditions, columns);
  std::vector<SideBalance> all;
  for (const Side side : {Side::left, Side::right}) {
    const Eigen::Index row = side == Side::left ? 0 : 1;
    Eigen::VectorXd torque_Nm(laws.rows()), error_Nm(laws.rows());
    for (std::size_t i = 0; i < conditions.size(); ++i) {
      const TransducerMeans& c = conditions[i];
      const Eigen::RowVector2d of_side = c.response.inverse().row(row);
      torque_Nm[Eigen::Index(i)] = of_side.dot(c.apart);
      error_Nm[Eigen::Index(i)] = of_side.transpose().cwiseProduct(c.standard_error).norm();
    }
    const Regression law = without_chance(laws, torque_Nm, error_Nm, columns);
    if (law.columns.size() == 1 && !(law.p_value(0) <= chance)) continue;
    const Eigen::VectorXd told = laws(Eigen::all, law.columns) * law.value;
    SideBalance balance{side, law.value[0], law.standard_error[0], told.minCoeff(),
                        told.maxCoeff()};
    for (std::size_t i = 1; i < law.columns.size(); ++i) {
      const auto at = Eigen::Index(i);
      (law.columns[i] == of_load ? balance.per_load : balance.per_speed) = law.value[at];
      (law.columns[i] == of_load ? balance.per_load_error : balance.per_speed_error) =
          law.standard_error[at];
    }
    all.push_back(balance);
  }
  return all;
}

const char* to_string(Side side) noexcept { return side == Side::left ? "left" : "right"; }

std::string law_text(const SideBalance& balance) {
  std::string text;
  const auto add = [&](double slope, const char* with) {
    if (slope == 0) return;
    text += std::string(text.empty() ? "" : ", ") + (slope > 0 ? "rises" : "falls") + with;
  };
  add(balance.per_load, " with load");
  add(balance.per_speed, " with speed");
  return text.empty() ? "the same at all loads and speeds" : text;
}

}  // namespace rvbench::analysis
