#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "analysis/explain/fit.hpp"
#include "analysis/explain/forward_model.hpp"
#include "analysis/explain/held_out.hpp"

namespace rvbench::analysis {

/// One repeat as the model of another: where a search for left-out effects finds something between
/// two records of the same programme, that is what drifted from one to the other, or what it finds
/// by chance.
///
/// Values   those of the last repeat less those of the first, both against the same fit
/// Units    those of the model's residuals. Errors  none thrown. Source  ours
/// Library  each number of the model as a drift, then the effects that the fit does not hold
class RepeatAgainstRepeat final : public ForwardModel {
 public:
  /// @param model  outlives it  @param fit  evaluated; both repeats are compared with it first
  /// @return nothing if no two records repeat each other for 8 units at least
  static std::optional<RepeatAgainstRepeat> make(const ForwardModel& model, const Fit& fit);

  const std::vector<ObservedUnit>& units() const override { return units_; }
  const std::vector<ModelParameter>& base() const override { return none_; }
  const std::vector<Candidate>& library() const override { return library_; }
  bool counts_standard_errors() const override { return model_.counts_standard_errors(); }
  std::optional<Eigen::VectorXd> residuals(const std::vector<std::size_t>& effects,
                                           const std::vector<double>& values,
                                           const std::vector<bool>& trained) const override;

 private:
  RepeatAgainstRepeat(const ForwardModel& model, const Fit& fit) : model_(model), fit_(fit) {}
  void pair_records();
  void make_library();

  const ForwardModel& model_;
  Fit fit_;
  std::vector<std::pair<const ObservedUnit*, const ObservedUnit*>> pairs_;  ///< first, last
  std::vector<ObservedUnit> units_;
  std::vector<ModelParameter> none_;
  std::vector<Candidate> library_;   ///< the first fit_.values.size() ones are drifts
  std::vector<std::size_t> others_;  ///< of model_.library(), those that follow
};

}  // namespace rvbench::analysis
