#include "bench/simulated_recording.hpp"

#include <fmt/format.h>

#include "bench/software_version.hpp"
#include "hal/recording_file.hpp"
#include "hal/types/require.hpp"
#include "hal/types/units.hpp"

namespace rvbench::bench {
namespace {

Status append(hal::RecordingWriter& writer, int point, const Recording& recording) {
  const Channel& torque = *recording.find(channel_names::input_torque);
  const Channel& angle = *recording.find(channel_names::input_angle);
  const Eigen::Index last = torque.samples.size() - 1;
  hal::TorqueBlock block{torque.start_s, {}};
  for (Eigen::Index i = 0; i <= last; ++i) {
    block.samples.push_back({torque.samples[i], angle.samples[i]});
  }
  if (Status written = writer.append(point, block); !written) return written;
  const double turned_rad_s =
      (angle.samples[last] - angle.samples[0]) / static_cast<double>(last) * angle.rate_Hz;
  return writer.end_point({.point = point,
                           .t0_s = torque.start_s,
                           .speed_rpm = units::rpm_from_rad_s(turned_rad_s),
                           .torque_Nm = torque.samples.mean()});
}

hal::AccelerationBlock block_of(const Recording& recording, std::size_t channels) {
  constexpr Require require{"write_vibration_hdf5"};
  require(recording.channels.size() == channels, "recordings of other channels");
  const Channel& first = recording.channels.front();
  hal::AccelerationBlock block{first.start_s, {first.samples.size(), Eigen::Index(channels)}};
  for (std::size_t i = 0; i < channels; ++i) {
    const Channel& channel = recording.channels[i];
    require(channel.rate_Hz == first.rate_Hz && channel.samples.size() == first.samples.size(),
            "channels of other rates or lengths");
    block.scans.col(Eigen::Index(i)) = channel.samples.cast<float>();
  }
  return block;
}

}  // namespace

void drop_lead_in(Channel& channel, Eigen::Index samples) {
  channel.start_s += static_cast<double>(samples) / channel.rate_Hz;
  channel.samples = channel.samples.tail(channel.samples.size() - samples).eval();
}

std::string csv_of(const Recording& recording) {
  const Channel& first = recording.channels.front();
  std::string text = "time_s";
  for (const Channel& channel : recording.channels) text += ',' + channel.info.name;
  text += '\n';
  for (Eigen::Index i = 0; i < first.samples.size(); ++i) {
    text += fmt::format("{:.9g}", first.start_s + static_cast<double>(i) / first.rate_Hz);
    for (const Channel& channel : recording.channels) {
      text += fmt::format(",{:.9g}", channel.samples[i]);
    }
    text += '\n';
  }
  return text;
}

Status write_hdf5(const std::filesystem::path& file, const std::vector<Recording>& recordings) {
  hal::RecordingLayout layout;
  layout.software = "rvbench " + software_version();
  for (const Recording& recording : recordings) {
    const Channel* torque = recording.find(channel_names::input_torque);
    if (torque == nullptr || recording.find(channel_names::input_angle) == nullptr) {
      return IoError{IoErrc::refused,
                     file.string() +
                         ": takes input_torque and input_angle, which the plant does "
                         "not show; write a CSV file"};
    }
    layout.torque_rate_Hz = torque->rate_Hz;
    layout.points.push_back({recording.planned_speed_rpm, recording.load_pct, recording.repeat});
  }
  auto writer = hal::RecordingWriter::create(file, layout);
  if (!writer) return writer.error();
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    if (Status written = append(*writer.value(), static_cast<int>(i), recordings[i]); !written) {
      return written;
    }
  }
  return writer.value()->close();
}

Status write_vibration_hdf5(const std::filesystem::path& file,
                            const std::vector<Recording>& recordings) {
  constexpr Require require{"write_vibration_hdf5"};
  require(!recordings.empty() && !recordings.front().channels.empty(), "nothing to write");
  hal::RecordingLayout layout;
  layout.software = "rvbench " + software_version();
  layout.acceleration_rate_Hz = recordings.front().channels.front().rate_Hz;
  for (const Channel& channel : recordings.front().channels) {
    layout.acceleration_channels.push_back(channel.info);
  }
  for (const Recording& recording : recordings) {
    layout.points.push_back({recording.planned_speed_rpm, recording.load_pct, recording.repeat});
  }
  auto writer = hal::RecordingWriter::create(file, layout);
  if (!writer) return writer.error();
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    const hal::AccelerationBlock block =
        block_of(recordings[i], layout.acceleration_channels.size());
    const int point = static_cast<int>(i);
    if (Status written = writer.value()->append(point, block); !written) return written;
    if (Status ended = writer.value()->end_point({.point = point, .t0_s = block.t0_s}); !ended) {
      return ended;
    }
  }
  return writer.value()->close();
}

}  // namespace rvbench::bench
