#include "analysis/explain/repeat_against_repeat.hpp"

#include <algorithm>
#include <map>

namespace rvbench::analysis {
namespace {

constexpr std::size_t parts_of_one_programme = 4;

// The units of each record of a programme, in the order in which they were recorded.
using Programme = std::vector<std::vector<const ObservedUnit*>>;

std::vector<Programme> programmes_of(const ForwardModel& model) {
  std::vector<Programme> all;
  std::map<std::string, std::size_t> known;
  std::string record;
  for (const ObservedUnit& unit : model.units()) {
    if (unit.programme.empty()) continue;
    const auto [at, is_new] = known.try_emplace(unit.programme, all.size());
    if (is_new) all.emplace_back();
    Programme& programme = all[at->second];
    if (programme.empty() || unit.record != record) programme.emplace_back();
    record = unit.record;
    programme.back().push_back(&unit);
  }
  std::erase_if(all, [](const Programme& p) { return p.size() < 2; });
  return all;
}

// From where the fit stands, one number of the model moves alone.
Candidate drift_of(const ModelParameter& p, double value) {
  Candidate drift;
  drift.name = "drift of " + p.name;
  drift.where = p.name;
  ModelParameter change = p;
  change.nominal = 0;
  change.low = p.low - value;
  change.high = p.high - value;
  drift.starts = {{p.scale}, {-p.scale}};
  drift.parameters = {std::move(change)};
  return drift;
}

}  // namespace

std::optional<RepeatAgainstRepeat> RepeatAgainstRepeat::make(const ForwardModel& model,
                                                             const Fit& fit) {
  RepeatAgainstRepeat repeats(model, fit);
  repeats.pair_records();
  if (repeats.pairs_.size() < fewest_units) return std::nullopt;
  repeats.make_library();
  return repeats;
}

void RepeatAgainstRepeat::pair_records() {
  const std::vector<Programme> programmes = programmes_of(model_);
  Eigen::Index at = 0;
  for (const Programme& programme : programmes) {
    const std::size_t count = std::min(programme.front().size(), programme.back().size());
    for (std::size_t i = 0; i < count; ++i) {
      const ObservedUnit& first = *programme.front()[i];
      const ObservedUnit& last = *programme.back()[i];
      ObservedUnit unit = last;
      unit.condition = unit.programme;
      if (programmes.size() == 1) {
        unit.condition = std::to_string(parts_of_one_programme * i / count);
        unit.speed = unit.load = "";
      }
      unit.first = at;
      unit.size = std::min(first.size, last.size);
      at += unit.size;
      pairs_.emplace_back(&first, &last);
      units_.push_back(std::move(unit));
    }
  }
}

void RepeatAgainstRepeat::make_library() {
  const std::vector<ModelParameter> parameters = parameters_of(model_, fit_.effects);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    library_.push_back(drift_of(parameters[i], fit_.values[i]));
  }
  for (std::size_t e = 0; e < model_.library().size(); ++e) {
    if (std::ranges::find(fit_.effects, e) != fit_.effects.end()) continue;
    others_.push_back(e);
    library_.push_back(model_.library()[e]);
  }
}

std::optional<Eigen::VectorXd> RepeatAgainstRepeat::residuals(
    const std::vector<std::size_t>& effects, const std::vector<double>& values,
    const std::vector<bool>&) const {
  std::vector<std::size_t> all = fit_.effects;
  std::vector<double> moved = fit_.values;
  std::size_t at = 0;
  for (const std::size_t effect : effects) {
    if (effect < fit_.values.size()) {
      moved[effect] += values[at++];
      continue;
    }
    const std::size_t other = others_[effect - fit_.values.size()];
    const std::size_t count = model_.library()[other].parameters.size();
    all.push_back(other);
    moved.insert(moved.end(), values.begin() + std::ptrdiff_t(at),
                 values.begin() + std::ptrdiff_t(at + count));
    at += count;
  }
  const std::vector<bool> everything(model_.units().size(), true);
  const auto later = model_.residuals(all, moved, everything);
  if (!later) return std::nullopt;
  Eigen::VectorXd out(units_.back().first + units_.back().size);
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const auto& [first, last] = pairs_[i];
    const Eigen::Index size = units_[i].size;
    out.segment(units_[i].first, size) =
        later->segment(last->first, size) - fit_.residuals.segment(first->first, size);
  }
  return out;
}

}  // namespace rvbench::analysis
