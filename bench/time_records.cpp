#include "bench/time_records.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "bench/channel_fault.hpp"
#include "hal/did_you_mean.hpp"
#include "sim/simulate.hpp"

namespace rvbench::bench {
namespace {

constexpr double coming_into_step_s = 1;  // of a free motion: not compared
constexpr double filter_edges = 3;        // periods of the band: not compared
constexpr double thinned_to = 2.5;        // samples per period of the band

using Faults = std::vector<hal::ConfigFault>;

// Why a recording cannot be compared with this output; empty if it can. A way may rest at its end
// for long: only a force or an acceleration that does has lost its top.
std::string output_fault(const Recording& recording, const sim::OutputSpec& output,
                         const sim::Excitation& inputs) {
  if (std::string misfit = channel_misfit(recording, output); !misfit.empty()) return misfit;
  const Channel& channel = *recording.find(output.channel);
  const std::string name = hal::in_quotes(output.channel);
  const bool in_step = channel.rate_Hz == inputs.rate_Hz() && channel.start_s == inputs.start_s() &&
                       channel.samples.size() == inputs.samples();
  if (!in_step) return name + " has another rate, start or length than the inputs";
  if (const std::string fault = sample_fault(channel); !fault.empty()) return name + ": " + fault;
  const bool may_rest =
      output.kind == sim::OutputKind::position || output.kind == sim::OutputKind::speed;
  return may_rest ? std::string() : quality_fault(channel);
}

// The samples that are compared, and how many of them.
void choose_samples(TimeRecord& record, double band_Hz) {
  const double rate_Hz = record.excitation.rate_Hz();
  const double edge_s = band_Hz > 0 ? filter_edges / band_Hz : 0;
  const double into_step_s = band_Hz > 0 ? edge_s : coming_into_step_s;
  record.into_step = static_cast<Eigen::Index>(into_step_s * rate_Hz);
  record.first = std::max(record.lead_in, record.into_step);
  record.last = record.excitation.samples() - static_cast<Eigen::Index>(edge_s * rate_Hz);
  if (band_Hz > 0) {
    record.thin =
        std::max<Eigen::Index>(1, static_cast<Eigen::Index>(rate_Hz / (thinned_to * band_Hz)));
  }
}

Faults input_faults(const sim::PlantSpec& plant, const Recording& recording) {
  Faults faults;
  for (std::size_t i = 0; i < plant.inputs.size(); ++i) {
    const Channel* channel = recording.find(plant.inputs[i].channel);
    const std::string fault = channel == nullptr ? "" : sample_fault(*channel);
    if (fault.empty()) continue;
    faults.push_back({0, fmt::format("/inputs/{}/channel", i),
                      hal::in_quotes(plant.inputs[i].channel) + ": " + fault});
  }
  return faults;
}

// Adds one record. @return why not; empty if it did
Faults add_record(const sim::PlantSpec& plant, const CampaignRecord& of, int steps,
                  TimeRecords& records) {
  const double rate_Hz = of.recording.channels.front().rate_Hz;
  if (2 * records.band_Hz > rate_Hz) {
    return {{0, "/inputs",
             fmt::format("a motion below {:g} Hz needs a rate above {:g} Hz, not {:g}",
                         records.band_Hz, 2 * records.band_Hz, rate_Hz)}};
  }
  auto made = sim::Excitation::make(plant, of.recording.channels, steps);
  if (auto* fault = std::get_if<hal::ConfigFault>(&made)) return {*fault};
  Faults faults = input_faults(plant, of.recording);
  TimeRecord record{of, of.lead_in, std::get<sim::Excitation>(std::move(made)), {}};
  for (std::size_t i = 0; i < plant.outputs.size(); ++i) {
    const std::string fault = output_fault(of.recording, plant.outputs[i], record.excitation);
    if (fault.empty()) {
      record.measured.push_back(of.recording.find(plant.outputs[i].channel)->samples);
    } else {
      faults.push_back({0, fmt::format("/outputs/{}/channel", i), fault});
    }
  }
  choose_samples(record, records.band_Hz);
  records.all.push_back(std::move(record));
  return faults;
}

double compared_s(const TimeRecord& record) {
  return static_cast<double>(record.last - record.first) / record.excitation.rate_Hz();
}

// Repeats are compared over the same part of their programme: one that begins its file has no
// samples before it for the model to come into step.
void align_repeats(std::vector<TimeRecord>& records) {
  std::map<std::string, double> lengths_s;
  for (TimeRecord& record : records) {
    if (record.about.programme.empty()) continue;
    record.first = record.lead_in + record.into_step;
    const auto [at, is_new] = lengths_s.try_emplace(record.about.programme, compared_s(record));
    if (!is_new) at->second = std::min(at->second, compared_s(record));
  }
  for (TimeRecord& record : records) {
    const auto length_s = lengths_s.find(record.about.programme);
    if (length_s == lengths_s.end()) continue;
    record.last = record.first + std::lround(length_s->second * record.excitation.rate_Hz());
  }
}

Faults find_spreads(const sim::PlantSpec& plant, TimeRecords& records) {
  Faults faults;
  for (std::size_t o = 0; o < plant.outputs.size(); ++o) {
    double sum = 0, count = 0;
    for (const TimeRecord& record : records.all) {
      if (!record.about.learned_from) continue;
      sum += std::pow(deviation(record.measured[o]), 2);
      ++count;
    }
    records.spread.push_back(std::sqrt(sum / count));
    if (!(records.spread.back() > 0)) {
      faults.push_back({0, fmt::format("/outputs/{}/channel", o),
                        hal::in_quotes(plant.outputs[o].channel) + " never changes"});
    }
  }
  return faults;
}

bool is_learned(const TimeRecord& record) { return record.about.learned_from; }

}  // namespace

double deviation(const Eigen::VectorXd& x) {
  if (x.size() == 0) return 0;
  return std::sqrt((x.array() - x.mean()).square().sum() / static_cast<double>(x.size()));
}

const TimeRecord& TimeRecords::first_learned() const {
  return *std::ranges::find_if(all, is_learned);
}

std::variant<TimeRecords, Refusal> time_records(const sim::PlantSpec& plant,
                                                const Campaign& campaign,
                                                const sim::TermLibrary& library) {
  TimeRecords records;
  for (const sim::InputSpec& input : plant.inputs) {
    records.band_Hz = std::max(records.band_Hz, input.band_Hz);
  }
  Refusal refusal{{}, true};
  for (const CampaignRecord& of : campaign.records) {
    const auto steps = sim::substeps_for(plant, of.recording.channels.front().rate_Hz, library);
    if (const auto* fault = std::get_if<hal::ConfigFault>(&steps)) return Refusal{{*fault}, false};
    for (hal::ConfigFault& fault : add_record(plant, of, std::get<int>(steps), records)) {
      fault.message = of.name + ": " + fault.message;
      refusal.faults.push_back(std::move(fault));
    }
  }
  align_repeats(records.all);
  for (const TimeRecord& record : records.all) {
    if (record.last - record.first >= 2 * units_per_record * record.thin) continue;
    refusal.faults.push_back({0, "", record.about.name + ": too short to be compared"});
  }
  if (!refusal.faults.empty()) return refusal;
  for (const TimeRecord& record : records.all) {
    const auto run = sim::simulate(plant, record.excitation, library);
    if (const auto* fault = std::get_if<hal::ConfigFault>(&run)) {
      return Refusal{{{0, fault->pointer, record.about.name + ": " + fault->message}}, false};
    }
  }
  if (std::ranges::none_of(records.all, is_learned)) {
    return Refusal{{{0, "", "there is no recording to learn from"}}, true};
  }
  refusal.faults = find_spreads(plant, records);
  if (!refusal.faults.empty()) return refusal;
  return records;
}

}  // namespace rvbench::bench
