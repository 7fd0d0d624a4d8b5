#include "bench/twin_candidates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "hal/types/units.hpp"
#include "sim/named.hpp"

namespace rvbench::bench {
namespace {

constexpr double part_of_value = 0.05;  // of a parameter: a noticeable change
constexpr std::array beside_a_line{0.95, 1.05};
constexpr double beyond_lines = 1.5;
constexpr double part_of_mains = 0.001;  // of a frequency: more loses step within seconds
constexpr double most_delay_samples = 2;
constexpr double widest_shape = 5;  // times its usual scale, and its fifth

double bound(double card) {
  if (card >= sim::unbounded) return std::numeric_limits<double>::infinity();
  return card <= -sim::unbounded ? -std::numeric_limits<double>::infinity() : card;
}

const sim::ParameterCard* card_of(const sim::TermType& type, std::string_view name) {
  const auto found = std::ranges::find(type.parameters, name, &sim::ParameterCard::name);
  return found == type.parameters.end() ? nullptr : &*found;
}

// The leading parameters without which the effect is nothing: the first, and those that may be
// zero.
std::size_t sizes_of(const sim::TermType& type) {
  std::size_t sizes = 1;
  while (sizes < type.parameters.size() && type.parameters[sizes].fitted &&
         type.parameters[sizes].fallback == 0.0) {
    ++sizes;
  }
  return sizes;
}

// The same start with each shape wider and narrower.
void add_other_shapes(const std::vector<analysis::ModelParameter>& parameters,
                      std::size_t first_shape, const std::vector<double>& first,
                      std::vector<std::vector<double>>& starts) {
  for (std::size_t i = first_shape; i < parameters.size(); ++i) {
    for (const double factor : {3.0, 1.0 / 3}) {
      starts.push_back(first);
      starts.back()[i] = std::clamp(first[i] * factor, parameters[i].low, parameters[i].high);
    }
  }
}

std::vector<double> scales_of(const std::vector<analysis::ModelParameter>& parameters) {
  std::vector<double> scales;
  for (const analysis::ModelParameter& p : parameters) scales.push_back(p.scale);
  return scales;
}

// Three that are a third of a turn apart, the same of a tenth the size, and the first one in other
// shapes.
std::vector<std::vector<double>> starts_of_wave(
    const std::vector<analysis::ModelParameter>& parameters) {
  const std::vector<double> scales = scales_of(parameters);
  std::vector<std::vector<double>> starts;
  for (const double part : {1.0, 0.1}) {
    for (const double turned : {0.0, 1.0 / 3, 2.0 / 3}) {
      starts.push_back(scales);
      starts.back()[0] = part * scales[0] * std::cos(units::two_pi * turned);
      starts.back()[1] = part * scales[0] * std::sin(units::two_pi * turned);
    }
  }
  const std::vector<double> first = starts.front();
  add_other_shapes(parameters, 2, first, starts);
  return starts;
}

// As the cards say, smaller, the other way round, and in other shapes.
std::vector<std::vector<double>> starts_of(
    const std::vector<analysis::ModelParameter>& parameters) {
  const std::vector<double> first = scales_of(parameters);
  std::vector<std::vector<double>> starts{first, first};
  starts[1][0] *= 0.2;
  if (parameters[0].low < 0) {
    starts.push_back(first);
    starts[2][0] *= -1;
  }
  add_other_shapes(parameters, 1, first, starts);
  return starts;
}

// The place of a frequency among what shapes the candidate.
std::optional<std::size_t> shape_in_Hz(const analysis::Candidate& candidate) {
  for (std::size_t i = candidate.sizes; i < candidate.parameters.size(); ++i) {
    if (candidate.parameters[i].unit == "Hz") return i;
  }
  return std::nullopt;
}

// A resonance does little to lines that are far from it: starts to both sides of each.
void start_beside_lines(const std::vector<double>& lines_Hz, std::size_t frequency,
                        analysis::Candidate& candidate) {
  analysis::ModelParameter& p = candidate.parameters[frequency];
  const auto [lowest, highest] = std::ranges::minmax(lines_Hz);
  p.low = lowest / beyond_lines;
  p.high = highest * beyond_lines;
  p.scale = part_of_value * lines_Hz.front();
  for (const double line_Hz : lines_Hz) {
    for (const double part : beside_a_line) {
      candidate.starts.push_back(scales_of(candidate.parameters));
      candidate.starts.back()[frequency] = part * line_Hz;
    }
  }
  candidate.has_far_starts = true;
}

// A size that is followed by its phase: both become the parts of a phasor.
void make_wave(analysis::Candidate& candidate, const std::string& phase) {
  analysis::ModelParameter& size = candidate.parameters.front();
  candidate.phasor = {size.name, phase};
  candidate.sizes = 2;
  size.low = -size.high;
  candidate.parameters.push_back(size);
  candidate.parameters[0].name += ", cosine part";
  candidate.parameters[1].name += ", sine part";
}

// Narrows what may be by what the card of the parameter's term says.
void bound_by_card(analysis::ModelParameter& p, const sim::PlantSpec& plant,
                   const sim::NaturalScales& natural, const sim::TermLibrary& terms) {
  for (std::size_t t = 0; t < plant.terms.size(); ++t) {
    const std::string prefix = fmt::format("/terms/{}/parameters/", t);
    if (!p.name.starts_with(prefix)) continue;
    const sim::ParameterCard* card =
        card_of(*terms.find(plant.terms[t].type), p.name.substr(prefix.size()));
    if (card == nullptr) return;
    p.low = std::max(p.low, bound(card->min));
    p.high = std::min(p.high, bound(card->max));
    if (p.scale == 0) p.scale = part_of_value * sim::natural_scale(card->unit, natural);
  }
}

// Of what turns faster, less force and more way and speed: the same power.
sim::NaturalScales natural_at(const sim::EffectSite& site, const sim::PlantSpec& plant,
                              const ParameterScales& scales) {
  if (scales.turns.empty()) return scales.natural;
  const auto turns_of = [&](const std::string& name) {
    const int body = sim::index_of(plant.bodies, name);
    return body < 0 ? 0.0 : scales.turns[static_cast<std::size_t>(body)];
  };
  const double against = std::abs(turns_of(site.body_a) - turns_of(site.body_b));
  const double turns = against > 0 ? against : std::abs(turns_of(site.body_a));
  if (turns == 0) return scales.natural;
  const sim::NaturalScales& one = scales.natural;
  return {one.force / turns, one.coordinate * turns, one.speed * turns};
}

// @param given  parameters that are known, and not fitted
TwinCandidate candidate_at(const sim::PlantSpec& plant, const sim::TermType& type,
                           const sim::EffectSite& site, const ParameterScales& scales,
                           const std::map<std::string, double>& given) {
  const sim::NaturalScales natural = natural_at(site, plant, scales);
  TwinCandidate made{{}, given};
  analysis::Candidate& candidate = made.candidate;
  candidate.name = type.card.name;
  candidate.where = sim::describe(site);
  candidate.mimics = type.card.mimics;
  candidate.experiment = type.card.experiment;
  using WhenSmall = analysis::Candidate::WhenSmall;
  candidate.when_small = type.make || type.adds       ? WhenSmall::in_proportion
                         : !type.gate.retunes.empty() ? WhenSmall::drowns
                                                      : WhenSmall::structural;
  candidate.sizes = sizes_of(type);
  for (const sim::ParameterCard& card : type.parameters) {
    if (given.contains(card.name)) continue;
    const double size = sim::natural_scale_at(plant, site, card.unit, natural) * card.start;
    if (!card.fitted) {
      made.chosen[card.name] = size;
      continue;
    }
    if (card.is_phase) {
      make_wave(candidate, card.name);
      continue;
    }
    analysis::ModelParameter p;
    p.name = card.name;
    p.unit = sim::unit_at(plant, site, card.unit);
    p.low = bound(card.min);
    p.high = bound(card.max);
    p.scale = size != 0 ? std::abs(size) : 1;
    const bool may_be_anything = card.min == -sim::unbounded || card.same_law;  // as a phase may
    if (candidate.parameters.size() >= candidate.sizes && size != 0 && !may_be_anything) {
      // A shape far from what the motion covers is another law in disguise.
      p.scale = std::clamp(p.scale, p.low, p.high);
      p.low = std::max(p.low, p.scale / widest_shape);
      p.high = std::min(p.high, p.scale * widest_shape);
    }
    candidate.parameters.push_back(std::move(p));
  }
  if (candidate.phasor) {
    candidate.starts = starts_of_wave(candidate.parameters);
  } else if (const auto frequency = shape_in_Hz(candidate); frequency && !scales.lines_Hz.empty()) {
    start_beside_lines(scales.lines_Hz, *frequency, candidate);
  } else if (!candidate.parameters.empty()) {
    candidate.starts = starts_of(candidate.parameters);
  }
  return made;
}

}  // namespace

analysis::ModelParameter model_parameter(const sim::PlantSpec& plant,
                                         const sim::PlacedQuantity& placed,
                                         const ParameterScales& scales,
                                         const sim::TermLibrary& terms) {
  const sim::Quantity& quantity = *placed.quantity;
  analysis::ModelParameter p;
  p.name = placed.pointer;
  p.unit = quantity.unit;
  p.nominal = quantity.value;
  p.scale = part_of_value * std::abs(quantity.value);
  p.nuisance = p.name.starts_with("/outputs") || p.name.starts_with("/inputs");
  const bool is_delay = p.name.ends_with("/delay");
  const bool of_hum = p.name.find("/hums/") != std::string::npos;
  const bool is_phase = p.name.ends_with("/phase");
  const bool is_hum_frequency = of_hum && p.name.ends_with("/frequency");
  if (std::isfinite(quantity.tolerance_pct)) {
    const double width = std::abs(quantity.value) * quantity.tolerance_pct / 100;
    p.low = quantity.value - width;
    p.high = quantity.value + width;
  } else if (is_delay) {
    p.low = -most_delay_samples * scales.sample_s;
    p.high = most_delay_samples * scales.sample_s;
  } else if (p.name.starts_with("/bodies") || is_hum_frequency) {
    p.low = 1e-3 * quantity.value;
  } else if (of_hum && !is_phase) {
    p.low = 0;
  }
  p.is_known = is_delay || std::isfinite(quantity.tolerance_pct);
  if (is_delay) p.scale = 0.1 * scales.sample_s;
  if (of_hum && is_phase) p.scale = part_of_value;
  if (is_hum_frequency) p.scale = part_of_mains * quantity.value;
  bound_by_card(p, plant, scales.natural, terms);
  // An offset of a channel that is nominally none.
  if (p.scale == 0) p.scale = part_of_value * scales.deviation;
  if (p.scale == 0) p.scale = 1;
  return p;
}

std::vector<TwinCandidate> candidates_at(const sim::PlantSpec& plant, const sim::TermType& type,
                                         const sim::EffectSite& site,
                                         const ParameterScales& scales) {
  const auto chosen = std::ranges::find_if(
      type.parameters, [](const sim::ParameterCard& card) { return !card.choices.empty(); });
  if (chosen != type.parameters.end()) {
    std::vector<TwinCandidate> all;
    for (const auto& [value, what] : chosen->choices) {
      all.push_back(candidate_at(plant, type, site, scales, {{chosen->name, value}}));
      all.back().candidate.where += ", " + what;
    }
    return all;
  }
  const auto frequency =
      std::ranges::find(type.parameters, sim::UnitKind::frequency, &sim::ParameterCard::unit);
  // A resonance has a frequency, too, but only a wave has a phase.
  const bool is_wave = std::ranges::any_of(type.parameters, &sim::ParameterCard::is_phase);
  const bool keeps_its_time = is_wave && !type.card.touches.empty() &&
                              type.card.touches.front().ledger == sim::Ledger::fixed_frequency;
  if (frequency == type.parameters.end() || !keeps_its_time || scales.rhythms_Hz.empty()) {
    return {candidate_at(plant, type, site, scales, {})};
  }
  std::vector<TwinCandidate> all;
  if (scales.fits_rhythms) all.push_back(candidate_at(plant, type, site, scales, {}));
  for (const double rhythm_Hz : scales.rhythms_Hz) {
    all.push_back(candidate_at(plant, type, site, scales, {{frequency->name, rhythm_Hz}}));
    all.back().candidate.where += fmt::format(", at {:g} Hz", rhythm_Hz);
  }
  return all;
}

}  // namespace rvbench::bench
