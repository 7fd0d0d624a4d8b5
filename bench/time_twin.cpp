#include "bench/time_twin.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "analysis/quality.hpp"
#include "hal/did_you_mean.hpp"
#include "sim/effect_edits.hpp"
#include "sim/interpolation.hpp"
#include "sim/plant_check.hpp"
#include "sim/simulate.hpp"

namespace rvbench::bench {
namespace {

constexpr double unit_length_s = 0.25;
constexpr int units_per_record = 12;
constexpr double coming_into_step_s = 1;  // of a free motion: not compared
constexpr double filter_edges = 3;        // periods of the band: not compared
constexpr double thinned_to = 2.5;        // samples per period of the band

double rms(const Eigen::VectorXd& x) {
  return x.size() > 0 ? std::sqrt(x.squaredNorm() / static_cast<double>(x.size())) : 0;
}

double deviation(const Eigen::VectorXd& x) { return x.size() > 0 ? rms(x.array() - x.mean()) : 0; }

// Why a recording cannot be compared with this output; empty if it can. A way may rest at its end
// for long: only a force or an acceleration that does has lost its top.
std::string output_fault(const Recording& recording, const sim::OutputSpec& output,
                         const sim::Excitation& inputs) {
  const std::string name = hal::in_quotes(output.channel);
  const Channel* channel = recording.find(output.channel);
  if (channel == nullptr) return name + " is no channel of the recording";
  if (!channel->info.unit.empty() && channel->info.unit != output.unit) {
    return fmt::format("{} is in {}, the plant shows {}", name, channel->info.unit, output.unit);
  }
  const bool in_step = channel->rate_Hz == inputs.rate_Hz() &&
                       channel->start_s == inputs.start_s() &&
                       channel->samples.size() == inputs.samples();
  if (!in_step) return name + " has another rate, start or length than the inputs";
  if (!channel->samples.allFinite()) return name + " has samples that are not finite";
  const bool may_rest =
      output.kind == sim::OutputKind::position || output.kind == sim::OutputKind::speed;
  if (may_rest) return {};
  for (const analysis::QualityNote& note : analysis::channel_quality(*channel, not_known)) {
    if (note.invalidates) return name + " is " + note.what;
  }
  return {};
}

}  // namespace

struct TimeTwin::Record {
  RecordLabels about;
  Eigen::Index lead_in = 0;
  sim::Excitation excitation;
  std::vector<Eigen::VectorXd> measured;  // per output of the plant
  Eigen::Index into_step = 0;             // samples that the model needs to come into step
  Eigen::Index first = 0, last = 0;       // what is compared
  Eigen::Index thin = 1;                  // of these, each so many-th
};

TimeTwin::TimeTwin(sim::PlantSpec plant, const sim::TermLibrary& library)
    : Twin(std::move(plant), library) {
  for (const sim::InputSpec& input : plant_.inputs) band_Hz_ = std::max(band_Hz_, input.band_Hz);
}

TwinOrRefusal TimeTwin::make(sim::PlantSpec plant, const Campaign& campaign,
                             const sim::TermLibrary& library) {
  if (auto faults = sim::check_plant(plant, library); !faults.empty()) {
    return Refusal{std::move(faults), false};
  }
  std::unique_ptr<TimeTwin> twin(new TimeTwin(std::move(plant), library));
  if (Refusal refusal = twin->load(campaign); !refusal.faults.empty()) return refusal;
  twin->align_repeats();
  const ParameterScales scales{twin->natural_scales(),
                               1 / twin->first_learned().excitation.rate_Hz(),
                               twin->largest_deviation()};
  twin->family_.emplace(twin->plant_, scales, library);
  twin->base_ = twin->family_->base();
  twin->cut_units();
  return std::unique_ptr<Twin>(std::move(twin));
}

Refusal TimeTwin::load(const Campaign& campaign) {
  Refusal refusal{{}, true};
  for (const CampaignRecord& of : campaign.records) {
    const auto steps = sim::substeps_for(plant_, of.recording.channels.front().rate_Hz, terms_);
    if (const auto* fault = std::get_if<hal::ConfigFault>(&steps)) return {{*fault}, false};
    for (hal::ConfigFault& fault : load_record(of, std::get<int>(steps))) {
      fault.message = of.name + ": " + fault.message;
      refusal.faults.push_back(std::move(fault));
    }
  }
  if (!refusal.faults.empty()) return refusal;
  for (const auto& record : records_) {
    const auto run = sim::simulate(plant_, record->excitation, terms_);
    if (const auto* fault = std::get_if<hal::ConfigFault>(&run)) return {{*fault}, false};
  }
  if (std::ranges::none_of(records_, [](const auto& r) { return r->about.learned_from; })) {
    return {{{0, "", "there is no recording to learn from"}}, true};
  }
  refusal.faults = find_spreads();
  return refusal;
}

std::vector<hal::ConfigFault> TimeTwin::load_record(const CampaignRecord& of, int steps) {
  const double rate_Hz = of.recording.channels.front().rate_Hz;
  if (2 * band_Hz_ > rate_Hz) {
    return {{0, "/inputs",
             fmt::format("a motion below {:g} Hz needs a rate above {:g} Hz, not {:g}", band_Hz_,
                         2 * band_Hz_, rate_Hz)}};
  }
  auto made = sim::Excitation::make(plant_, of.recording.channels, steps);
  if (auto* fault = std::get_if<hal::ConfigFault>(&made)) return {*fault};
  auto record = std::make_shared<Record>(
      Record{of, of.lead_in, std::get<sim::Excitation>(std::move(made)), {}});
  std::vector<hal::ConfigFault> faults;
  for (std::size_t i = 0; i < plant_.outputs.size(); ++i) {
    const std::string fault = output_fault(of.recording, plant_.outputs[i], record->excitation);
    if (fault.empty()) {
      record->measured.push_back(of.recording.find(plant_.outputs[i].channel)->samples);
    } else {
      faults.push_back({0, fmt::format("/outputs/{}/channel", i), fault});
    }
  }
  const Eigen::Index size = record->excitation.samples();
  const double edge_s = band_Hz_ > 0 ? filter_edges / band_Hz_ : 0;
  const double into_step_s = band_Hz_ > 0 ? edge_s : coming_into_step_s;
  record->into_step = static_cast<Eigen::Index>(into_step_s * rate_Hz);
  record->first = std::max(record->lead_in, record->into_step);
  record->last = size - static_cast<Eigen::Index>(edge_s * rate_Hz);
  if (band_Hz_ > 0) {
    record->thin =
        std::max<Eigen::Index>(1, static_cast<Eigen::Index>(rate_Hz / (thinned_to * band_Hz_)));
  }
  if (record->last - record->first < 2 * units_per_record * record->thin) {
    faults.push_back({0, "", "too short to be compared"});
  }
  records_.push_back(std::move(record));
  return faults;
}

// Repeats are compared over the same part of their programme: one that begins its file has no
// samples before it for the model to come into step.
void TimeTwin::align_repeats() {
  std::map<std::string, Eigen::Index> lengths;
  for (const auto& record : records_) {
    const std::string& programme = record->about.programme;
    if (programme.empty()) continue;
    record->first = record->lead_in + record->into_step;
    const auto [at, is_new] = lengths.try_emplace(programme, record->last - record->first);
    if (!is_new) at->second = std::min(at->second, record->last - record->first);
  }
  for (const auto& record : records_) {
    const auto length = lengths.find(record->about.programme);
    if (length != lengths.end()) record->last = record->first + length->second;
  }
}

std::vector<hal::ConfigFault> TimeTwin::find_spreads() {
  std::vector<hal::ConfigFault> faults;
  for (std::size_t o = 0; o < plant_.outputs.size(); ++o) {
    double sum = 0, count = 0;
    for (const auto& record : records_) {
      if (!record->about.learned_from) continue;
      sum += std::pow(deviation(record->measured[o]), 2);
      ++count;
    }
    spread_.push_back(std::sqrt(sum / count));
    if (!(spread_.back() > 0)) {
      faults.push_back({0, fmt::format("/outputs/{}/channel", o),
                        hal::in_quotes(plant_.outputs[o].channel) + " never changes"});
    }
  }
  return faults;
}

// What is only to be predicted tells nothing, not even how large things are.
const TimeTwin::Record& TimeTwin::first_learned() const {
  return **std::ranges::find_if(records_, [](const auto& r) { return r->about.learned_from; });
}

sim::NaturalScales TimeTwin::natural_scales() const {
  const sim::BodySpec& body = plant_.bodies.front();
  const bool driven = std::ranges::any_of(plant_.inputs, [&](const sim::InputSpec& input) {
    return input.kind >= sim::InputKind::position && input.body == body.name;
  });
  const sim::PlantSpec probe =
      sim::with_probes(plant_, body.name,
                       {sim::OutputKind::position, sim::OutputKind::speed,
                        driven ? sim::OutputKind::drive : sim::OutputKind::acceleration});
  sim::NaturalScales scales;
  const auto run = sim::simulate(probe, first_learned().excitation, terms_);
  const auto* shown = std::get_if<sim::Simulated>(&run);
  if (shown == nullptr) return scales;
  const auto size = [&](std::size_t i) {
    const double value = deviation(shown->channels[i].samples);
    return value > 0 ? value : 1;
  };
  scales = {driven ? size(2) : size(2) * body.inertia.value, size(0), size(1)};
  return scales;
}

double TimeTwin::largest_deviation() const {
  double largest = 0;
  for (const Eigen::VectorXd& x : first_learned().measured) {
    largest = std::max(largest, deviation(x));
  }
  return largest;
}

void TimeTwin::cut_units() {
  Eigen::Index at = 0;
  const auto outputs = static_cast<Eigen::Index>(plant_.outputs.size());
  for (const auto& record : records_) {
    if (!record->about.learned_from) continue;
    const double rate_Hz = record->excitation.rate_Hz();
    const Eigen::Index size = (record->last - record->first) / record->thin;
    const double length_s = static_cast<double>(record->last - record->first) / rate_Hz;
    const auto count = static_cast<Eigen::Index>(
        std::clamp(length_s / unit_length_s, 1.0, double(units_per_record)));
    for (Eigen::Index i = 0; i < count; ++i) {
      const Eigen::Index own = (size * (i + 1) / count - size * i / count) * outputs;
      units_.push_back({record->about.name, record->about.condition, record->about.speed,
                        record->about.load, at, own, record->about.programme});
      at += own;
    }
  }
}

// Where the record is compared, below the band, each `step`-th sample.
Eigen::VectorXd TimeTwin::below_band(const Record& record, const Eigen::VectorXd& x,
                                     Eigen::Index step) const {
  Eigen::VectorXd out((record.last - record.first) / step);
  const double rate_Hz = record.excitation.rate_Hz();
  if (band_Hz_ == 0 || 2 * band_Hz_ >= rate_Hz) {
    for (Eigen::Index i = 0; i < out.size(); ++i) out[i] = x[record.first + i * step];
    return out;
  }
  const sim::Interpolation filter(0, 0, band_Hz_ / rate_Hz);
  for (Eigen::Index i = 0; i < out.size(); ++i) out[i] = filter(x, record.first + i * step);
  return out;
}

// @param show  of a record, one signal per output of the plant
// @return what it shows of the records that are learned from, in order of the units
std::optional<Eigen::VectorXd> TimeTwin::by_units(
    const std::function<std::optional<std::vector<Eigen::VectorXd>>(const Record&)>& show) const {
  const analysis::ObservedUnit& last = units_.back();
  Eigen::VectorXd out(last.first + last.size);
  auto unit = units_.begin();
  for (const auto& record : records_) {
    if (!record->about.learned_from) continue;
    auto shown = show(*record);
    if (!shown) return std::nullopt;
    for (Eigen::VectorXd& signal : *shown) {
      signal = below_band(*record, signal, record->thin);
    }
    Eigen::Index from = 0;
    while (unit != units_.end() && unit->record == record->about.name &&
           from < shown->front().size()) {
      const Eigen::Index each = unit->size / static_cast<Eigen::Index>(shown->size());
      for (std::size_t o = 0; o < shown->size(); ++o) {
        out.segment(unit->first + static_cast<Eigen::Index>(o) * each, each) =
            (*shown)[o].segment(from, each);
      }
      from += each;
      ++unit;
    }
  }
  return out;
}

std::optional<Eigen::VectorXd> TimeTwin::residuals(const std::vector<std::size_t>& effects,
                                                   const std::vector<double>& values,
                                                   const std::vector<bool>&) const {
  stop_if_asked();
  const sim::PlantSpec plant = plant_with(effects, values);
  return by_units([&](const Record& record) -> std::optional<std::vector<Eigen::VectorXd>> {
    const auto run = sim::simulate(plant, record.excitation, terms_);
    const auto* shown = std::get_if<sim::Simulated>(&run);
    if (shown == nullptr) return std::nullopt;
    std::vector<Eigen::VectorXd> apart;
    for (std::size_t o = 0; o < plant_.outputs.size(); ++o) {
      apart.emplace_back((record.measured[o] - shown->channels[o].samples) / spread_[o]);
    }
    return apart;
  });
}

Eigen::MatrixXd TimeTwin::states() const {
  const sim::OutputSpec& seen = plant_.outputs.front();
  const sim::TermSpec* term = plant_.find_term(seen.of);
  const std::string body = term != nullptr ? term->body_a : seen.of;
  const sim::PlantSpec probe =
      sim::with_probes(plant_, body, {sim::OutputKind::position, sim::OutputKind::speed});
  std::vector<Channel> shown;  // position and speed of each record in turn
  for (const auto& record : records_) {
    if (!record->about.learned_from) continue;
    auto run = sim::simulate(probe, record->excitation, terms_);
    auto* simulated = std::get_if<sim::Simulated>(&run);
    if (simulated == nullptr) return {};
    std::ranges::move(simulated->channels, std::back_inserter(shown));
  }
  const std::size_t columns = probe.outputs.size();
  Eigen::MatrixXd states(units_.back().first + units_.back().size, Eigen::Index(columns));
  for (std::size_t column = 0; column < columns; ++column) {
    std::size_t at = column;
    states.col(Eigen::Index(column)) = *by_units([&](const Record&) {
      const Eigen::VectorXd& state = shown[at].samples;
      at += columns;
      return std::optional(std::vector<Eigen::VectorXd>(plant_.outputs.size(), state));
    });
  }
  return states;
}

std::vector<Twin::Comparison> TimeTwin::compare(const std::vector<std::size_t>& effects,
                                                const std::vector<double>& values) const {
  const sim::PlantSpec plant = plant_with(effects, values);
  std::vector<Comparison> all;
  for (const auto& record : records_) {
    const auto run = sim::simulate(plant, record->excitation, terms_);
    const auto* shown = std::get_if<sim::Simulated>(&run);
    if (shown == nullptr) return {};
    const double rate_Hz = record->excitation.rate_Hz();
    for (std::size_t o = 0; o < plant_.outputs.size(); ++o) {
      all.push_back({record->about.name, plant_.outputs[o].channel, plant_.outputs[o].unit,
                     record->about.learned_from, spread_[o], "time [s]",
                     record->excitation.start_s() + static_cast<double>(record->first) / rate_Hz,
                     1 / rate_Hz, below_band(*record, record->measured[o], 1),
                     below_band(*record, shown->channels[o].samples, 1)});
    }
  }
  return all;
}

}  // namespace rvbench::bench
