#include "bench/plant_family.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

namespace rvbench::bench {
namespace {

constexpr double tolerance_spreads = 2;  // standard deviations that a tolerance is wide

// What no record shows stays where it was; what records show may go as far as twice the tolerance.
analysis::ModelParameter by_tolerance(analysis::ModelParameter p, const sim::Quantity& quantity) {
  if (!std::isfinite(quantity.tolerance_pct)) return p;
  const double tolerance = 0.5 * (p.high - p.low);
  p.spread = tolerance / tolerance_spreads;
  p.low = std::max(p.nominal - 2 * tolerance, p.nominal > 0 ? p.nominal / 10 : p.low);
  p.high = p.nominal + 2 * tolerance;
  return p;
}

}  // namespace

PlantFamily::PlantFamily(sim::PlantSpec plant, const ParameterScales& scales,
                         const sim::TermLibrary& library)
    : plant_(std::move(plant)), terms_(library) {
  const std::vector<sim::PlacedQuantity> all = sim::quantities(plant_);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].quantity->tolerance_pct == 0) continue;
    moved_.push_back(i);
    base_.push_back(
        by_tolerance(model_parameter(plant_, all[i], scales, terms_), *all[i].quantity));
  }
  for (std::size_t t = 0; t < terms_.types().size(); ++t) {
    const sim::TermType& type = terms_.types()[t];
    if (!type.card.effect) continue;
    for (const sim::EffectSite& site : sim::sites_of(plant_, type, terms_)) {
      add_candidates(t, site, scales);
    }
  }
}

void PlantFamily::add_candidates(std::size_t type, const sim::EffectSite& site,
                                 const ParameterScales& scales) {
  for (TwinCandidate& made : candidates_at(plant_, terms_.types()[type], site, scales)) {
    if (made.candidate.parameters.empty()) continue;
    acts_.emplace_back(type, site);
    chosen_.push_back(std::move(made.chosen));
    candidates_.push_back(std::move(made.candidate));
  }
}

const sim::TermGate& PlantFamily::gate_of(std::size_t candidate) const {
  return terms_.types()[acts_.at(candidate).first].gate;
}

std::optional<double> PlantFamily::chosen_frequency_Hz(std::size_t candidate) const {
  for (const sim::ParameterCard& card : terms_.types()[acts_.at(candidate).first].parameters) {
    const auto chosen = chosen_[candidate].find(card.name);
    const bool is_frequency = card.unit == sim::UnitKind::frequency;
    if (is_frequency && chosen != chosen_[candidate].end()) return chosen->second;
  }
  return std::nullopt;
}

void PlantFamily::stands_for(std::size_t candidate, std::size_t other) {
  analysis::Candidate& tried = candidates_.at(candidate);
  tried.alike.push_back({candidates_.at(other).name, candidates_.at(other).where});
  cannot_show(other, "looks like " + tried.name + " (" + tried.where + ")");
}

void PlantFamily::never_reverses(std::size_t candidate) {
  const std::string& name = gate_of(candidate).one_way_like;
  const std::string& where = candidates_.at(candidate).where;
  const auto is_it = [&](const auto& other) { return other.name == name && other.where == where; };
  const auto like = std::ranges::find_if(candidates_, [&](const analysis::Candidate& other) {
    return other.not_exercised.empty() && (is_it(other) || std::ranges::any_of(other.alike, is_it));
  });
  if (like != candidates_.end()) stands_for(std::size_t(like - candidates_.begin()), candidate);
  cannot_show(candidate, "the direction of motion never changes");
}

sim::PlantSpec PlantFamily::with_usual(std::size_t candidate) const {
  std::vector<double> values;
  for (const analysis::ModelParameter& p : base_) values.push_back(p.nominal);
  const std::vector<double>& own = candidates_.at(candidate).starts.front();
  values.insert(values.end(), own.begin(), own.end());
  return with({candidate}, values);
}

sim::PlantSpec PlantFamily::with(const std::vector<std::size_t>& effects,
                                 const std::vector<double>& values) const {
  sim::PlantSpec plant = plant_;
  const std::vector<sim::PlacedQuantity> all = sim::quantities(plant);
  for (std::size_t i = 0; i < moved_.size(); ++i) all[moved_[i]].quantity->value = values[i];
  std::size_t at = moved_.size();
  for (const std::size_t effect : effects) {
    const auto& [t, site] = acts_[effect];
    const sim::TermType& type = terms_.types()[t];
    sim::Parameters parameters;
    const auto& phasor = candidates_[effect].phasor;
    const std::complex<double> wave =
        phasor ? std::complex<double>(values[at], values[at + 1]) : std::complex<double>();
    for (const sim::ParameterCard& card : type.parameters) {
      const auto chosen = chosen_[effect].find(card.name);
      double value = chosen != chosen_[effect].end() ? chosen->second : values[at++];
      if (phasor && card.name == phasor->size) value = std::abs(wave);
      if (phasor && card.name == phasor->phase) value = std::arg(wave);
      parameters[card.name] = {value, sim::unit_at(plant_, site, card.unit), 0};
    }
    plant = sim::with_effect(plant, type.card.name, site, parameters, terms_);
  }
  return plant;
}

}  // namespace rvbench::bench
