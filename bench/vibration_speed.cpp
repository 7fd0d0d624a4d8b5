#include "bench/vibration_speed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>
#include <variant>

#include "analysis/shaft_speed.hpp"
#include "bench/kinematics_file.hpp"

namespace rvbench::bench {
namespace {

constexpr double half_the_rate = 0.5;
constexpr double most_bridged = 0.1;         // of the blocks
constexpr Eigen::Index fewest_samples = 64;  // of a block

// The lines of the meshes, or of all that turns where there is none, with harmonics as far as a
// recording can hold them.
std::vector<double> orders_of(const analysis::Kinematics& kinematics, const VibrationSpeed& how) {
  const bool has_mesh =
      std::ranges::any_of(kinematics.orders, &analysis::CharacteristicOrder::mesh);
  const double fastest = how.turns_per_sample * (1 + how.within_pct / 100);
  std::set<double> orders;
  for (const analysis::CharacteristicOrder& line : kinematics.orders) {
    for (int harmonic = 1; harmonic <= how.harmonics; ++harmonic) {
      const double order = harmonic * line.order;
      const bool known = std::ranges::any_of(
          orders, [&](double other) { return std::abs(other / order - 1) < 1e-9; });
      if (line.mesh == has_mesh && !known && order * fastest < half_the_rate) orders.insert(order);
    }
  }
  return {orders.begin(), orders.end()};
}

struct Speeds {
  Eigen::VectorXd turns_per_sample = {};
  double standard_error = 0;  // RMS of the blocks', relative
  std::size_t bridged = 0;    // blocks that do not show the lines
  std::string fault = {};     // why there are no speeds
};

// Puts straight lines over what is not known, between its neighbours.
void bridge(Eigen::VectorXd& x) {
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    if (!std::isnan(x[i])) continue;
    const Eigen::Index before = i - 1;
    Eigen::Index after = i;
    while (after < x.size() && std::isnan(x[after])) ++after;
    if (before < 0 || after == x.size()) {
      x[i] = x[before < 0 ? after : before];
    } else {
      x[i] = x[before] + (x[after] - x[before]) / static_cast<double>(after - before);
    }
  }
}

Speeds speeds_of(const Recording& recording, const std::vector<double>& orders,
                 const VibrationSpeed& how, Eigen::Index block) {
  const auto blocks = analysis::shaft_speeds(
      recording.channels, {orders, how.turns_per_sample, how.within_pct / 100}, block);
  const auto count = static_cast<double>(blocks.size());
  if (count < 2) return {.fault = fmt::format("is shorter than {} turns", how.block_turns)};
  Speeds speeds{Eigen::VectorXd(static_cast<Eigen::Index>(blocks.size()))};
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const analysis::ShaftSpeed& speed = blocks[i];
    speeds.turns_per_sample[static_cast<Eigen::Index>(i)] = speed.turns_per_sample;
    if (std::isnan(speed.turns_per_sample)) {
      ++speeds.bridged;
    } else {
      speeds.standard_error += std::pow(speed.standard_error / speed.turns_per_sample, 2);
    }
  }
  const auto bridged = static_cast<double>(speeds.bridged);
  if (bridged > most_bridged * count) {
    return {.fault =
                fmt::format("{} of {} blocks do not show the lines of {} near {} turns per sample",
                            speeds.bridged, blocks.size(), how.kinematics, how.turns_per_sample)};
  }
  bridge(speeds.turns_per_sample);
  speeds.standard_error = std::sqrt(speeds.standard_error / (count - bridged));
  return speeds;
}

std::string file_name(const Recording& recording) {
  return std::filesystem::path(recording.source).filename().string();
}

}  // namespace

VibrationSpeed parse_vibration_speed(hal::ConfigReader& json, const std::filesystem::path& folder) {
  VibrationSpeed how;
  how.kinematics = json.text("kinematics");
  how.harmonics = json.integer("harmonics", {1, 20}, how.harmonics);
  how.turns_per_sample = json.number("turns_per_sample", {1e-9, half_the_rate});
  how.within_pct = json.number("within_pct", {0.1, 20}, how.within_pct);
  how.block_turns = json.number("block_turns", {1, 1e6}, how.block_turns);
  how.relative_to = json.text("relative_to", "");
  how.nominal_Hz = json.number("nominal_Hz", {1e-3, 1e5}, 0);
  const std::filesystem::path in_folder = folder / how.kinematics;
  if (std::filesystem::is_regular_file(in_folder)) how.kinematics = in_folder.string();
  if (!how.relative_to.empty()) {
    how.relative_to = (folder / how.relative_to).string();
  }
  return how;
}

std::string use_vibration_speed(Recording& recording, const Recording* reference,
                                const VibrationSpeed& how, std::vector<std::string>& notes) {
  const double rate_Hz = recording.channels.front().rate_Hz;
  const bool has_rate = rate_Hz > 0;
  if (reference == nullptr && !has_rate) {
    return "NOT_RESOLVABLE: its speed itself, for no sample rate is documented; what can be had is "
           "the speed relative_to another recording";
  }
  if (!has_rate && !(how.nominal_Hz > 0))
    return "states no sample rate: give rate_Hz or nominal_Hz";
  const auto read = read_kinematics(how.kinematics);
  if (const auto* faults = std::get_if<1>(&read)) {
    return fmt::format("kinematics {}: {}", how.kinematics, faults->front().message);
  }
  const std::vector<double> orders = orders_of(std::get<0>(read), how);
  if (orders.empty()) return how.kinematics + " has no line below half the sample rate";
  const auto half = static_cast<Eigen::Index>(how.block_turns / how.turns_per_sample / 2);
  if (2 * half < fewest_samples)
    return fmt::format("{} turns are too few samples", how.block_turns);
  const Speeds own = speeds_of(recording, orders, how, 2 * half);
  if (!own.fault.empty()) return own.fault;

  Channel speed{{"speed", reference == nullptr ? "rad/s" : "1", "", not_known},
                rate_Hz / double(half),
                0,
                {}};
  if (reference == nullptr) {
    speed.samples = 2 * std::numbers::pi * rate_Hz * own.turns_per_sample;
  } else {
    const Speeds other = speeds_of(*reference, orders, how, 2 * half);
    if (!other.fault.empty()) return fmt::format("{} {}", file_name(*reference), other.fault);
    const double unit = other.turns_per_sample.mean();
    speed.samples = own.turns_per_sample / unit;
    if (!has_rate) speed.rate_Hz = how.nominal_Hz / unit / double(half);
  }
  if (own.bridged > 0) {
    notes.push_back(
        fmt::format("{}: {} of {} blocks do not show the lines: bridged by straight lines",
                    file_name(recording), own.bridged, own.turns_per_sample.size()));
  }
  notes.push_back(fmt::format(
      "{}: speed from {} lines of vibration in {} blocks of {:g} turns, each with a standard error "
      "of {:.2g} %{}",
      file_name(recording), orders.size(), own.turns_per_sample.size(), how.block_turns,
      100 * own.standard_error,
      has_rate ? ""
               : fmt::format("; no sample rate is documented: times are as if the shaft of {} "
                             "turned at {:g} Hz, and its speed in rad/s is NOT_RESOLVABLE",
                             file_name(*reference), how.nominal_Hz)));
  recording.channels = {std::move(speed)};
  return {};
}

}  // namespace rvbench::bench
