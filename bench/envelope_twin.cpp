#include "bench/envelope_twin.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hal/did_you_mean.hpp"
#include "sim/named.hpp"
#include "sim/plant_check.hpp"

namespace rvbench::bench {
namespace {

constexpr double least_lines_per_part = 2;          // of a stretch's spectrum, to tell a level by
constexpr double one_line = 1.5 / turns_per_block;  // orders: neighbours show one another; levels
                                                    // lie farther apart, in Hz

}  // namespace

EnvelopeTwin::EnvelopeTwin(sim::PlantSpec plant, const sim::TermLibrary& library)
    : Twin(std::move(plant), library) {}

TwinOrRefusal EnvelopeTwin::make(sim::PlantSpec plant, const Campaign& campaign,
                                 const sim::TermLibrary& library) {
  if (auto faults = sim::check_plant(plant, library); !faults.empty()) {
    return Refusal{std::move(faults), false};
  }
  std::unique_ptr<EnvelopeTwin> twin(new EnvelopeTwin(std::move(plant), library));
  if (Refusal refusal = twin->load(campaign); !refusal.faults.empty()) return refusal;
  twin->family_.emplace(twin->plant_, twin->scales(), library);
  twin->base_ = twin->family_->base();
  if (Refusal refusal = twin->choose_lines(); !refusal.faults.empty()) return refusal;
  for (EnvelopeRecord& record : twin->records_) read_features(twin->orders_, record);
  twin->cut_units();
  return std::unique_ptr<Twin>(std::move(twin));
}

Refusal EnvelopeTwin::load(const Campaign& campaign) {
  const auto vibration = sim::RandomVibration::make(plant_, terms_);
  if (const auto* fault = std::get_if<hal::ConfigFault>(&vibration)) return {{*fault}, false};
  const auto of_shaft = std::ranges::find(plant_.inputs, "Hz", &sim::InputSpec::unit);
  if (of_shaft == plant_.inputs.end()) {
    return {
        {{0, "/inputs", "a plant that is compared by envelope is told its shaft's speed in Hz"}},
        false};
  }
  const auto shaft = static_cast<std::size_t>(of_shaft - plant_.inputs.begin());
  Refusal refusal{{}, true};
  for (const CampaignRecord& of : campaign.records) {
    auto measured = measure_envelopes(plant_, shaft, of);
    if (auto* record = std::get_if<EnvelopeRecord>(&measured)) {
      records_.push_back(std::move(*record));
      continue;
    }
    for (hal::ConfigFault& fault : std::get<1>(measured)) {
      fault.message = of.name + ": " + fault.message;
      refusal.faults.push_back(std::move(fault));
    }
  }
  if (!refusal.faults.empty()) return refusal;
  if (std::ranges::none_of(records_,
                           [](const EnvelopeRecord& r) { return r.about.learned_from; })) {
    return {{{0, "", "there is no recording to learn from"}}, true};
  }
  return {};
}

// What the first output's body weighs, shaken as much as it was.
ParameterScales EnvelopeTwin::scales() const {
  double mean_square = 0, count = 0;
  for (const EnvelopeRecord& record : records_) {
    if (!record.about.learned_from) continue;
    for (const VibrationBlock& block : record.blocks) {
      mean_square += block.front().mean_square.sum();
      ++count;
    }
  }
  const sim::OutputSpec& output = plant_.outputs.front();
  const double shown = std::sqrt(mean_square / count) / std::abs(output.gain.value);
  const double mass = plant_.find_body(output.of)->inertia.value;
  return {{mass * shown, 1, 1}, 1e-4, shown, {}, {}};
}

Refusal EnvelopeTwin::choose_lines() {
  const EnvelopeRecord& record = records_.front();
  const auto as_it_is = solved(plant_, record);
  if (!as_it_is) return {{{0, "/terms", "the plant's vibration cannot be solved"}}, false};
  std::vector<std::vector<sim::Vibration>> shown(plant_.outputs.size());
  for (std::size_t o = 0; o < shown.size(); ++o) {
    const sim::OutputSpec& output = plant_.outputs[o];
    if (!((*as_it_is)[o].density.sum() > 0)) {
      return {{{0, "/terms", "no random force reaches " + hal::in_quotes(output.channel)}}, false};
    }
    const double least_Hz = least_lines_per_part * level_parts * record.shaft_Hz / turns_per_block;
    if (output.to_Hz - output.from_Hz < least_Hz) {
      return {{{0, fmt::format("/outputs/{}/to_Hz", o),
                fmt::format("a band of {:g} Hz is too narrow at this speed: {:g} Hz at least",
                            output.to_Hz - output.from_Hz, least_Hz)}},
              false};
    }
    shown[o].push_back((*as_it_is)[o]);
  }
  for (std::size_t i = 0; i < library().size(); ++i) {
    const auto with = solved(family_->with_usual(i), record);
    if (!with) {
      family_->cannot_show(i, "what it makes of a random vibration is not known");
      continue;
    }
    for (std::size_t o = 0; o < shown.size(); ++o) shown[o].push_back((*with)[o]);
  }
  for (const auto& of_output : shown) {
    orders_.push_back(orders_of_swells(of_output, record.shaft_Hz));
  }
  return {};
}

void EnvelopeTwin::cut_units() {
  Eigen::Index at = 0;
  for (const EnvelopeRecord& record : records_) {
    if (!record.about.learned_from) continue;
    for (const Eigen::VectorXd& values : record.values) {
      units_.push_back({record.about.name, record.about.condition, record.about.speed,
                        record.about.load, at, values.size(), record.about.programme});
      at += values.size();
    }
  }
}

std::optional<std::vector<sim::Vibration>> EnvelopeTwin::solved(
    const sim::PlantSpec& plant, const EnvelopeRecord& record) const {
  const auto made = sim::RandomVibration::make(plant, terms_);
  if (std::holds_alternative<hal::ConfigFault>(made)) return std::nullopt;
  const auto& vibration = std::get<sim::RandomVibration>(made);
  std::vector<sim::Vibration> shown;
  for (std::size_t o = 0; o < plant.outputs.size(); ++o) {
    shown.push_back(vibration.under(record.inputs, o, solved_band(plant.outputs[o])));
  }
  return shown;
}

Eigen::VectorXd EnvelopeTwin::without_noise(const std::vector<sim::Vibration>& shown,
                                            const EnvelopeRecord& record) const {
  Eigen::VectorXd features(record.errors.size());
  Eigen::Index at = 0;
  for (std::size_t o = 0; o < shown.size(); ++o) {
    features.segment(at, level_parts) =
        levels_dB(mean_square_of(shown[o], solved_band(plant_.outputs[o])));
    at += level_parts;
    for (const double order : orders_[o]) {
      const double frequency_Hz = order * record.shaft_Hz;
      const double width_Hz = line_width_Hz(frequency_Hz, record.shaft_Hz);
      features[at++] = depth_of(shown[o], frequency_Hz, width_Hz);
    }
  }
  return features;
}

// What a stretch of the record would show of them: depths among its noise.
Eigen::VectorXd EnvelopeTwin::shown_by(Eigen::VectorXd features, const EnvelopeRecord& record,
                                       std::size_t block) const {
  auto depth = record.depths[block].begin();
  Eigen::Index at = 0;
  for (const std::vector<double>& orders : orders_) {
    at += level_parts;
    for (std::size_t line = 0; line < orders.size(); ++line, ++at, ++depth) {
      features[at] = std::hypot(features[at], depth->noise);
    }
  }
  return features;
}

bool EnvelopeTwin::for_each_learned(
    const sim::PlantSpec& plant,
    const std::function<void(const EnvelopeRecord&, const Eigen::VectorXd&)>& see) const {
  const EnvelopeRecord* before = nullptr;
  Eigen::VectorXd features;
  for (const EnvelopeRecord& record : records_) {
    if (!record.about.learned_from) continue;
    if (before == nullptr || before->inputs != record.inputs) {
      const auto shown = solved(plant, record);
      if (!shown) return false;
      features = without_noise(*shown, record);
    }
    before = &record;
    see(record, features);
  }
  return true;
}

std::optional<Eigen::VectorXd> EnvelopeTwin::residuals(const std::vector<std::size_t>& effects,
                                                       const std::vector<double>& values,
                                                       const std::vector<bool>&) const {
  stop_if_asked();
  Eigen::VectorXd apart(units_.back().first + units_.back().size);
  Eigen::Index at = 0;
  const bool is_solved = for_each_learned(
      plant_with(effects, values),
      [&](const EnvelopeRecord& record, const Eigen::VectorXd& features) {
        for (std::size_t b = 0; b < record.values.size(); ++b) {
          const Eigen::VectorXd& measured = record.values[b];
          apart.segment(at, measured.size()) =
              (measured - shown_by(features, record, b)).cwiseQuotient(record.errors);
          at += measured.size();
        }
      });
  return is_solved ? std::optional(std::move(apart)) : std::nullopt;
}

Twin::Cells EnvelopeTwin::cells(const std::vector<std::size_t>& effects,
                                const std::vector<double>& values) const {
  Cells cells{{}, one_line};
  for_each_learned(plant_with(effects, values),
                   [&](const EnvelopeRecord& record, const Eigen::VectorXd& features) {
                     const auto blocks = static_cast<double>(record.values.size());
                     Eigen::VectorXd apart = Eigen::VectorXd::Zero(features.size());
                     for (std::size_t b = 0; b < record.values.size(); ++b) {
                       apart += (record.values[b] - shown_by(features, record, b)) / blocks;
                     }
                     add_cells(record, apart, cells);
                   });
  return cells;
}

void EnvelopeTwin::add_cells(const EnvelopeRecord& record, const Eigen::VectorXd& apart,
                             Cells& cells) const {
  const double root = std::sqrt(static_cast<double>(record.values.size()));
  Eigen::Index at = 0;
  const auto add = [&](const std::string& channel, const char* unit, analysis::LockedTo locked_to,
                       double place) {
    cells.all.push_back({channel, unit, record.about.condition, locked_to, place, apart[at],
                         record.errors[at] / root});
    ++at;
  };
  for (std::size_t o = 0; o < plant_.outputs.size(); ++o) {
    const sim::OutputSpec& output = plant_.outputs[o];
    const double part_Hz = (output.to_Hz - output.from_Hz) / double(level_parts);
    for (int part = 0; part < level_parts; ++part) {
      add(output.channel + ", level", "dB", analysis::LockedTo::time,
          output.from_Hz + (part + 0.5) * part_Hz);
    }
    for (const double order : orders_[o]) {
      add(output.channel + ", envelope²", "1", analysis::LockedTo::shaft, order);
    }
  }
}

// Per record and output: levels over frequency, and the squared envelope's spectrum.
std::vector<Twin::Comparison> EnvelopeTwin::compare(const std::vector<std::size_t>& effects,
                                                    const std::vector<double>& values) const {
  const sim::PlantSpec plant = plant_with(effects, values);
  std::vector<Comparison> all;
  for (const EnvelopeRecord& record : records_) {
    const auto shown = solved(plant, record);
    if (!shown) return {};
    const auto blocks = static_cast<double>(record.blocks.size());
    for (std::size_t o = 0; o < plant_.outputs.size(); ++o) {
      const sim::OutputSpec& output = plant_.outputs[o];
      Eigen::VectorXd power = Eigen::VectorXd::Zero(level_parts);
      const analysis::Spectrum& first = record.blocks.front()[o].depth;
      const double highest_Hz =
          1.1 * (orders_[o].empty() ? 1 : orders_[o].back()) * record.shaft_Hz;
      const auto lines = std::min(static_cast<Eigen::Index>(highest_Hz / first.resolution) + 1,
                                  first.amplitude.size());
      Eigen::VectorXd squares = Eigen::VectorXd::Zero(lines);
      for (const VibrationBlock& block : record.blocks) {
        power += block[o].mean_square / blocks;
        squares += block[o].depth.amplitude.head(lines).cwiseAbs2() / blocks;
      }
      squares[0] = 0;
      squares = squares.cwiseSqrt().eval();
      const Eigen::VectorXd depth = drawn_depth((*shown)[o], {first.resolution, squares});
      const double part_Hz = (output.to_Hz - output.from_Hz) / double(level_parts);
      all.push_back({record.about.name, output.channel + ", levels", output.unit,
                     record.about.learned_from, 1, "frequency [Hz]", output.from_Hz + part_Hz / 2,
                     part_Hz, power.cwiseSqrt(),
                     mean_square_of((*shown)[o], solved_band(output)).cwiseSqrt()});
      all.push_back({record.about.name, output.channel + ", envelope²", "1",
                     record.about.learned_from, 1, "envelope frequency [Hz]", 0, first.resolution,
                     squares, depth});
    }
  }
  return all;
}

}  // namespace rvbench::bench
