#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "hal/config_reader.hpp"
#include "sim/period_orders.hpp"
#include "sim/plant_model.hpp"
#include "sim/push_response.hpp"
#include "sim/term_library.hpp"

namespace rvbench::sim {

/// One output of a plant that turns steadily: mean + Re Σ lines·e^(jωt).
struct SteadyOutput {
  double mean = 0;               ///< in the output's unit
  Eigen::VectorXcd shaft_lines;  ///< element k: of order k of the period; element 0 is unused
  Eigen::VectorXcd timed_lines;  ///< one for each of SteadyState::rhythms_Hz
};

/// A plant whose bodies turn together, each at its own constant speed but for small oscillations.
struct SteadyState {
  double period_Hz = 0;               ///< turns per second of the slowest body: everything repeats
  Eigen::VectorXd speed_rad_s;        ///< mean, of each body
  Eigen::MatrixXcd motion;            ///< bodies x orders: oscillation; column 0 is the mean
  double slowest_rad_s = 0;           ///< speed of the slowest body, with its sign
  std::vector<double> rhythms_Hz;     ///< of terms that follow time, not motion; then of hums
  std::vector<std::string> slip_of;   ///< of these: the motor whose slip it follows; "": of none
  std::vector<SteadyOutput> outputs;  ///< in order of the plant's
};

/// Solves a plant's steady rotation under constant inputs, in the order domain.
///
/// The bodies' common motion is the one that the linear springs let pass; its speed is where the
/// power balances. Around it, the motion x answers the terms' forces over one period of the slowest
/// body, at the orders that PeriodOrders tells: (K + jωC − ω²M)·x = f, with f taken from the terms
/// themselves at the motion found so far, until no force line was open by more than 1e-5 of the
/// largest before the last round; 1e-7 from a state that is near, so that slopes can be taken by
/// differences. What follows time is taken as small beside the rest: one line for each such term,
/// and one at twice its frequency.
///
/// What swings all bodies together, and slowly beside the fast ones, is left out of the angles that
/// terms see: the fast lines are those over the angle, as order tracking shows them. Over time they
/// would have sidebands. Slow is up to an eighth of the turns of the next faster body.
///
/// Leaves out: what outlasts a period (memories of terms, chaos), lines at and between other
/// orders, modulation of the timed lines by the shaft
///
/// Source  Cameron & Griffin, J. Appl. Mech. 56(1), 149-154 (1989): alternating frequency and time
class SteadyPlant {
 public:
  /// @param plant  outlives the result
  /// @return a fault if bodies can turn by themselves or have no common period, if a term has a
  ///         past or holds on to one turn, or if a motion is prescribed
  static std::variant<SteadyPlant, hal::ConfigFault> make(
      const PlantSpec& plant, const TermLibrary& library = standard_terms());

  /// Turns that each body makes, with its sign, while the slowest makes one: the motion that the
  /// plant's linear springs let pass. 0 of a body that is held.
  const Eigen::VectorXd& turns_per_period() const { return common_; }

  /// The orders 1 .. highest that the plant's terms can bring, whatever drives it.
  PeriodOrders orders_up_to(int highest) const;

  /// @param inputs  of the channels of plant.inputs, in their order; all of them force or signal
  /// @param orders  see orders_up_to(): lines of these are solved
  /// @param near    a state of a plant much like this one: where to begin; nullptr: nowhere
  /// @return the steady state; a fault if there is none: nothing drives the bodies, or the lines do
  ///         not come to rest
  std::variant<SteadyState, hal::ConfigFault> under(const Eigen::VectorXd& inputs,
                                                    const PeriodOrders& orders,
                                                    const SteadyState* near = nullptr) const;

  /// What small forces on its bodies do to the outputs of the plant in a state that was found.
  /// @param inputs, orders  it was found with
  /// @return empty if the state is none of this plant's
  std::optional<PushResponse> response(const SteadyState& state, const Eigen::VectorXd& inputs,
                                       const PeriodOrders& orders,
                                       const std::vector<double>& frequencies_Hz) const;

 private:
  SteadyPlant(const PlantSpec& plant, PlantModel model, Eigen::VectorXd common)
      : plant_(&plant), model_(std::move(model)), common_(std::move(common)) {}

  const PlantSpec* plant_;
  PlantModel model_;
  Eigen::VectorXd common_;
};

}  // namespace rvbench::sim
