#include "sim/term_rhythms.hpp"

#include <algorithm>
#include <array>

#include "sim/term_memory.hpp"

namespace rvbench::sim {
namespace {

constexpr std::array<double, 4> quarter_periods{0, 0.25, 0.5, 0.75};

}  // namespace

TermRhythms::TermRhythms(const PlantModel& model, PlantState still, const Eigen::VectorXd& turns)
    : model_(model),
      still_(std::move(still)),
      turns_(turns),
      clock_rates_(Eigen::VectorXd::Zero(model.memory_size)) {
  still_.z = clock_rates_;
  for (const auto& term : model.terms) {
    const double rhythm_Hz = term->rhythm_Hz(still_);
    if (rhythm_Hz != 0) rhythmic_.emplace_back(term.get(), rhythm_Hz);
  }
  PlantState s = still_;
  s.v = turns_;
  keep_at(s);
  const auto at_speed = std::pair(rhythmic_, clock_rates_);
  keep_at(still_);
  follows_speed_ = at_speed != std::pair(rhythmic_, clock_rates_);
}

bool TermRhythms::is_one(const PhysicsTerm* term) const {
  return std::ranges::any_of(rhythmic_, [&](const auto& one) { return one.first == term; });
}

void TermRhythms::keep(double speed_rad_s) {
  if (!follows_speed_) return;
  PlantState s = still_;
  s.v = turns_ * speed_rad_s;
  keep_at(s);
}

void TermRhythms::keep_at(const PlantState& s) {
  for (auto& [term, rhythm_Hz] : rhythmic_) rhythm_Hz = term->rhythm_Hz(s);
  clock_rates_.setZero();
  for (const auto& term : model_.terms) {
    const auto* memory = dynamic_cast<const TermMemory*>(term.get());
    if (memory != nullptr) memory->add_rates(s, clock_rates_);
  }
}

void TermRhythms::set_clocks(PlantState& s, double t_s) const {
  s.t_s = t_s;
  s.z = clock_rates_ * t_s;
}

void TermRhythms::mean_forces(PlantState& s, bool remainder_only, Eigen::VectorXd& f) const {
  f.setZero();
  if (rhythmic_.empty()) return;
  for (const auto& [term, rhythm_Hz] : rhythmic_) {
    for (const double part : quarter_periods) {
      set_clocks(s, rhythm_Hz == 0 ? 0 : part / rhythm_Hz);
      remainder_only ? term->add_remainder(s, f) : term->add_force(s, f);
    }
  }
  set_clocks(s, 0);
  f /= double(quarter_periods.size());
}

}  // namespace rvbench::sim
