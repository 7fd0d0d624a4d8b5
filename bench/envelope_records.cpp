#include "bench/envelope_records.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "bench/channel_fault.hpp"
#include "bench/order_features.hpp"
#include "hal/did_you_mean.hpp"

namespace rvbench::bench {
namespace {

constexpr double most_blocks = 8;  // of a record
constexpr double level_error_dB = 3;
constexpr double depth_error = 0.25;    // of the depth
constexpr double most_shaft_Hz = 1000;  // 60 000 rpm: of a number that is larger, another unit

std::optional<hal::ConfigFault> speed_fault(const Channel& speed, std::size_t input,
                                            double shaft_Hz) {
  const std::string place = fmt::format("/inputs/{}", input);
  if (!(shaft_Hz > 0 && shaft_Hz < most_shaft_Hz)) {
    return hal::ConfigFault{0, place,
                            fmt::format("a shaft does not turn {:g} times a second", shaft_Hz)};
  }
  const double low = speed.samples.minCoeff(), high = speed.samples.maxCoeff();
  if (high - low > slip_width_Hz(shaft_Hz)) {
    return hal::ConfigFault{
        0, place,
        fmt::format("the shaft turns between {:g} and {:g} times a second: its lines smear", low,
                    high)};
  }
  return std::nullopt;
}

std::optional<hal::ConfigFault> output_fault(const sim::PlantSpec& plant, std::size_t o,
                                             const CampaignRecord& of) {
  const sim::OutputSpec& output = plant.outputs[o];
  const std::string place = fmt::format("/outputs/{}", o);
  if (std::string fault = channel_fault(of.recording, output); !fault.empty()) {
    return hal::ConfigFault{0, place + "/channel", std::move(fault)};
  }
  const double rate_Hz = of.recording.find(output.channel)->rate_Hz;
  if (output.to_Hz > rate_Hz / 2) {
    return hal::ConfigFault{0, place + "/to_Hz",
                            fmt::format("{} is sampled at {:g} Hz: it holds nothing above {:g} Hz",
                                        hal::in_quotes(output.channel), rate_Hz, rate_Hz / 2)};
  }
  return std::nullopt;
}

VibrationBlock block_of(const sim::PlantSpec& plant, const CampaignRecord& of, double from_s,
                        double length_s) {
  VibrationBlock block;
  for (const sim::OutputSpec& output : plant.outputs) {
    const Channel& channel = *of.recording.find(output.channel);
    const auto first = of.lead_in + static_cast<Eigen::Index>(from_s * channel.rate_Hz);
    const auto size = std::min(static_cast<Eigen::Index>(length_s * channel.rate_Hz),
                               channel.samples.size() - first);
    block.push_back(analysis::band_vibration(channel.samples.segment(first, size), channel.rate_Hz,
                                             output.from_Hz, output.to_Hz, level_parts));
  }
  return block;
}

}  // namespace

std::variant<EnvelopeRecord, std::vector<hal::ConfigFault>> measure_envelopes(
    const sim::PlantSpec& plant, std::size_t shaft, const CampaignRecord& of) {
  std::vector<hal::ConfigFault> faults;
  auto inputs = steady_inputs(plant, of.recording);
  if (auto* fault = std::get_if<hal::ConfigFault>(&inputs)) return std::vector{std::move(*fault)};
  EnvelopeRecord record;
  record.about = of;
  record.inputs = std::get<Eigen::VectorXd>(std::move(inputs));
  record.shaft_Hz = std::abs(record.inputs[Eigen::Index(shaft)]);
  const Channel& speed = *of.recording.find(plant.inputs[shaft].channel);
  if (auto fault = speed_fault(speed, shaft, record.shaft_Hz))
    return std::vector{*std::move(fault)};
  double turns = std::numeric_limits<double>::infinity();
  for (std::size_t o = 0; o < plant.outputs.size(); ++o) {
    if (auto fault = output_fault(plant, o, of)) {
      faults.push_back(*std::move(fault));
      continue;
    }
    const Channel& channel = *of.recording.find(plant.outputs[o].channel);
    turns = std::min(
        turns, double(channel.samples.size() - of.lead_in) / channel.rate_Hz * record.shaft_Hz);
  }
  if (!faults.empty()) return faults;
  const auto blocks = static_cast<std::size_t>(std::min(turns / turns_per_block, most_blocks));
  if (blocks == 0) {
    return std::vector{
        hal::ConfigFault{0, "",
                         fmt::format("{:.1f} turns of the shaft are too few: {:g} at least", turns,
                                     turns_per_block)}};
  }
  const double block_s = turns / record.shaft_Hz / static_cast<double>(blocks);
  for (std::size_t b = 0; b < blocks; ++b) {
    record.blocks.push_back(block_of(plant, of, static_cast<double>(b) * block_s, block_s));
  }
  return record;
}

void read_features(const std::vector<std::vector<double>>& orders, EnvelopeRecord& record) {
  const auto blocks = static_cast<double>(record.blocks.size());
  Eigen::VectorXd mean, squares;
  Eigen::VectorXd chance, good_for;
  for (const VibrationBlock& block : record.blocks) {
    std::vector<double> values, by_chance;
    std::vector<analysis::DepthNear> depths;
    for (std::size_t o = 0; o < orders.size(); ++o) {
      for (const double level_dB : levels_dB(block[o].mean_square)) values.push_back(level_dB);
      by_chance.resize(values.size(), 0);
      for (const double order : orders[o]) {
        const double frequency_Hz = order * record.shaft_Hz;
        depths.push_back(analysis::depth_near(block[o].depth, frequency_Hz,
                                              line_width_Hz(frequency_Hz, record.shaft_Hz)));
        values.push_back(depths.back().depth);
        by_chance.push_back(depths.back().noise_sigma);
      }
    }
    record.values.push_back(
        Eigen::Map<Eigen::VectorXd>(values.data(), Eigen::Index(values.size())));
    const Eigen::Map<Eigen::VectorXd> sigma(by_chance.data(), Eigen::Index(by_chance.size()));
    record.depths.push_back(std::move(depths));
    if (mean.size() == 0) mean = squares = chance = Eigen::VectorXd::Zero(sigma.size());
    mean += record.values.back() / blocks;
    chance += sigma.cwiseAbs2() / blocks;
  }
  for (const Eigen::VectorXd& values : record.values) {
    squares += (values - mean).cwiseAbs2() / std::max(blocks - 1, 1.0);
  }
  good_for = depth_error * mean;
  Eigen::Index at = 0;
  for (const auto& of_output : orders) {
    good_for.segment(at, level_parts).setConstant(level_error_dB);
    at += level_parts + static_cast<Eigen::Index>(of_output.size());
  }
  record.errors = (squares.cwiseMax(chance) + blocks * good_for.cwiseAbs2()).cwiseSqrt();
}

}  // namespace rvbench::bench
