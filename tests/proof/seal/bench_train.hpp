#pragma once

#include <memory>
#include <vector>

#include "tests/proof/seal/bench_effect.hpp"
#include "tests/proof/seal/bench_numbers.hpp"
#include "tests/proof/seal/turn_table.hpp"

namespace seal {

/// The bench's train in time: the linear part is stepped exactly, what remains by its present and
/// its last two values (third order; Cox & Matthews, J. Comput. Phys. 176, 430-455 (2002),
/// sec. 2.1).
class BenchTrain {
 public:
  /// @param effects  outlive the train
  BenchTrain(const BenchNumbers& numbers, std::vector<BenchEffect*> effects, double step_s);

  void set_supply_Hz(double supply_Hz) { asked_Hz_ = supply_Hz; }
  void set_brake_Nm(double brake_Nm) { brake_Nm_ = brake_Nm; }
  void set_friction_factor(double factor) { friction_factor_ = factor; }
  void set_error_factor(double factor) { error_factor_ = factor; }
  void step();

  double time_s() const { return time_s_; }
  double sun_rad() const { return q_[sun]; }
  double coupling_Nm() const;  ///< as the transducer shows it

 private:
  void find_remainder();
  void push_meshes();
  void push_stages();

  BenchNumbers numbers_;
  std::vector<BenchEffect*> effects_;
  double step_s_;
  TurnTable errors_[2], ripples_[2];
  Eigen::MatrixXd decay_, by_now_, by_change_, by_bend_;
  Eigen::VectorXd state_, q_, v_, remainder_Nm_, before_Nm_, before_that_Nm_;
  double time_s_ = 0, electrical_rad_ = 0, asked_Hz_ = 0, supply_Hz_ = 0, brake_Nm_ = 0;
  double passed_Nm_ = 0;  // by the coupling, beside its spring and damper
  double friction_factor_ = 1, error_factor_ = 1;
  bool is_first_ = true;
};

}  // namespace seal
