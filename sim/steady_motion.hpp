#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <variant>
#include <vector>

#include "hal/config_reader.hpp"
#include "sim/anderson.hpp"
#include "sim/period_orders.hpp"
#include "sim/plant_model.hpp"
#include "sim/term_rhythms.hpp"

namespace rvbench::sim {

/// How the bodies of a plant move when they turn steadily: see SteadyPlant.
class SteadyMotion {
 public:
  /// When the bodies' oscillation counts as found.
  struct Rest {
    int rounds = 1;      ///< at least
    double lines = 0;    ///< of the largest force line: what may be open before the last round,
    double balance = 0;  ///< of the largest force: in the mean; a tenth of it is after that round
  };

  /// @param model   outlives the motion
  /// @param common  see common_motion()
  /// @param orders  outlive the motion
  SteadyMotion(const PlantModel& model, Eigen::VectorXd common, const Eigen::VectorXd& inputs,
               const PeriodOrders& orders);

  /// Starts from rest lines and the fastest speed that holds itself.
  std::optional<hal::ConfigFault> solve();
  /// Starts from a motion that is near, of the same bodies or of all but the last ones.
  /// @param by_orders  bodies x orders
  /// @return whether it led there
  bool solve_near(double speed_rad_s, const Eigen::MatrixXcd& by_orders);

  double speed_rad_s() const { return speed_rad_s_; }  ///< of the slowest body
  const Eigen::VectorXd& common() const { return common_; }
  const PeriodOrders& orders() const { return orders_; }
  /// Bodies x lines; column 0: the mean, column 1 + i: of orders().orders()[i].
  const Eigen::MatrixXcd& lines() const { return lines_; }
  double omega_rad_s(Eigen::Index line) const;
  Eigen::MatrixXcd differentiated(const Eigen::MatrixXcd& lines) const;
  Eigen::MatrixXcd impedance(double omega_rad_s) const;  ///< about the mean motion

  /// Angles at zero, mean deflections, mean speeds, at this time.
  PlantState mean_state(double t_s) const;
  /// Angles of the slowest body, evenly over the period: what a force does on average over these
  /// counts as what it does to the mean motion.
  std::vector<double> mean_angles_rad() const;
  Eigen::Index samples() const { return orders_.samples(); }
  /// Calls see(sample, state) around one period.
  void go_round(const std::function<void(Eigen::Index, PlantState&)>& see) const;

 private:
  void add_forces(PlantState& s, bool remainder_only, Eigen::VectorXd& f) const;
  Eigen::MatrixXcd without_slow_swing() const;
  double drive_at(double speed_rad_s);
  bool find_speed();
  void find_slopes();
  Eigen::MatrixXcd unbalanced(const Eigen::MatrixXcd& remainder) const;
  bool come_to_rest(const Rest& rest);
  void move(AndersonMixing& mixing, const Eigen::MatrixXcd& step, double speed_step_rad_s);

  const PlantModel& model_;
  Eigen::VectorXd common_;
  Eigen::Index n_;
  const PeriodOrders& orders_;
  Eigen::Index count_;  // of lines
  Eigen::VectorXd u_;
  TermRhythms rhythms_;
  // Terms without a rhythm, and those of them with a remainder.
  std::vector<const PhysicsTerm*> steady_, curved_;
  int mean_angles_, slow_orders_;
  LinearParts linear_;
  Eigen::MatrixXd stiffness_, damping_;  // mean slopes of all forces
  double speed_rad_s_ = 0;
  Eigen::MatrixXcd lines_;
};

}  // namespace rvbench::sim
