#include "hal/formats/losses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hal/formats/start_time.hpp"

namespace rvbench::hal::formats {
namespace {

using Fault = std::optional<std::string>;

template <typename Has>
bool any_channel(const std::vector<Recording>& recordings, Has has) {
  return std::ranges::any_of(recordings, [&has](const Recording& recording) {
    return std::ranges::any_of(recording.channels, has);
  });
}

bool has_facts(const Recording& recording) {
  return std::isfinite(recording.speed_rpm) || std::isfinite(recording.planned_speed_rpm) ||
         std::isfinite(recording.load_pct) || std::isfinite(recording.torque_Nm) ||
         recording.repeat > 0 || recording.status != "ok";
}

bool is_along_axis(std::string_view direction) {
  if (!direction.starts_with('+') && !direction.starts_with('-')) return false;
  direction.remove_prefix(1);
  if (direction.starts_with('R')) direction.remove_prefix(1);
  return direction == "X" || direction == "Y" || direction == "Z";
}

bool has_start(const Recording& recording) { return std::isfinite(noted_start_s(recording)); }

bool is_rounded(double value, int digits) {
  const double kept = std::stod(fmt::format("{:.{}E}", value, digits - 1));
  return std::abs(kept - value) > 1e-12 * std::abs(value);
}

Fault fault_of(const Channel& channel, const Writer& writer) {
  const std::string& name = channel.info.name;
  if (!(channel.rate_Hz > 0)) {
    return fmt::format("{}: its sample rate is not known; give it with --rate HZ", name);
  }
  if (!writer.holds.any_rate && channel.rate_Hz != std::round(channel.rate_Hz)) {
    return fmt::format(
        "{}: {} takes a rate of whole Hz only, and this is {:.10g} Hz: write HDF5, "
        "TDMS or MAT instead",
        name, writer.name, channel.rate_Hz);
  }
  constexpr double most = std::numeric_limits<float>::max();
  const double peak =
      channel.samples.array().isFinite().select(channel.samples, 0).cwiseAbs().maxCoeff();
  if (!writer.holds.doubles && peak > most) {
    return fmt::format(
        "{}: a sample of {:.6g} is beyond single precision: write HDF5, TDMS or MAT instead", name,
        peak);
  }
  if (!writer.holds.lost_samples && !channel.samples.allFinite()) {
    const Eigen::Index lost = channel.samples.size() - channel.samples.array().isFinite().count();
    return fmt::format(
        "{}: {} of its samples are lost, for which {} has no value: write HDF5, "
        "TDMS, MAT or WAV instead",
        name, lost, writer.name);
  }
  return std::nullopt;
}

void tell_of_cut_status(const std::vector<Recording>& recordings, const Writer& writer,
                        std::vector<std::string>& lost) {
  const std::size_t most = writer.holds.status_bytes;
  const auto is_cut = [most](const Recording& recording) { return recording.status.size() > most; };
  if (std::ranges::none_of(recordings, is_cut)) return;
  lost.push_back(fmt::format("{} holds {} bytes of the status: it is cut", writer.name, most));
}

void tell_of_rounded_times(const std::vector<Recording>& recordings, const Writer& writer,
                           std::vector<std::string>& lost) {
  const int digits = writer.holds.time_digits;
  const auto is_off = [digits](const Channel& c) {
    return is_rounded(1 / c.rate_Hz, digits) || is_rounded(c.start_s, digits);
  };
  if (!any_channel(recordings, is_off)) return;
  lost.push_back(
      fmt::format("{} holds {} digits of the sample interval and of the first sample's time: they "
                  "are rounded",
                  writer.name, digits));
}

}  // namespace

std::optional<std::string> unwritable(const Recording& recording, const Writer& writer) {
  for (const Channel& channel : recording.channels) {
    if (auto fault = fault_of(channel, writer)) return fault;
  }
  return std::nullopt;
}

std::vector<std::string> losses(const std::vector<Recording>& recordings, const Writer& writer) {
  const Holds& holds = writer.holds;
  std::vector<std::string> lost;
  const auto tell = [&](bool held, bool is_there, const char* what) {
    if (held || !is_there) return;
    lost.push_back(fmt::format("{} has no place for {}: left out", writer.name, what));
  };
  const auto any = [&](auto has) { return any_channel(recordings, has); };
  tell(holds.names, any([](const Channel& c) { return !c.info.name.empty(); }),
       "names of channels");
  tell(holds.units, any([](const Channel& c) { return !c.info.unit.empty(); }), "units");
  tell(holds.directions, any([](const Channel& c) { return !c.info.direction.empty(); }),
       "directions");
  tell(!holds.directions || holds.any_direction, any([](const Channel& c) {
    return !c.info.direction.empty() && !is_along_axis(c.info.direction);
  }),
       "directions other than along or about an axis");
  tell(holds.sensitivities, any([](const Channel& c) { return !std::isnan(c.info.sensitivity); }),
       "sensitivities of sensors");
  tell(holds.channel_start, any([](const Channel& c) { return c.start_s != 0; }),
       "the time of the first sample");
  tell(holds.start_time, std::ranges::any_of(recordings, has_start), "the start time");
  tell(holds.facts, std::ranges::any_of(recordings, has_facts),
       "speed, load, torque, repeat and status");
  tell_of_cut_status(recordings, writer, lost);
  tell_of_rounded_times(recordings, writer, lost);
  if (!holds.floats) {
    lost.push_back(
        fmt::format("{} holds whole steps, 2^23 - 1 of them up to the peak of each "
                    "channel: no sample is clipped, each is rounded to half a step",
                    writer.name));
  } else if (!holds.doubles && any([](const Channel& c) { return !are_single(c.samples); })) {
    lost.push_back(
        fmt::format("{} holds single precision: samples are rounded to 24 bits", writer.name));
  }
  return lost;
}

bool is_one_clock(const Channel& a, const Channel& b) {
  return a.rate_Hz == b.rate_Hz && a.start_s == b.start_s && a.samples.size() == b.samples.size();
}

bool are_single(const Eigen::VectorXd& samples) {
  return std::all_of(samples.begin(), samples.end(), [](double sample) {
    return std::isnan(sample) || static_cast<double>(static_cast<float>(sample)) == sample;
  });
}

}  // namespace rvbench::hal::formats
