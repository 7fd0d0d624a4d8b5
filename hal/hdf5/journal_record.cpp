#include "hal/hdf5/journal_record.hpp"

#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

#include "hal/hdf5/hdf5_handle.hpp"

namespace rvbench::hal::hdf5 {
namespace {

enum class Kind : std::uint32_t { layout = 1, acceleration, torque, result, note };

class Packer {
 public:
  explicit Packer(Kind kind) { number(kind); }

  template <typename Number>
  void number(Number value) {
    static_assert(std::is_arithmetic_v<Number> || std::is_enum_v<Number>);
    array(&value, 1);
  }
  void size(std::size_t value) { number(static_cast<std::uint64_t>(value)); }
  void text(const std::string& value) {
    size(value.size());
    bytes_ += value;
  }
  template <typename Item>
  void array(const Item* items, std::size_t count) {
    bytes_.append(reinterpret_cast<const char*>(items), count * sizeof(Item));
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : bytes_(bytes) {}

  template <typename Number>
  Number number() {
    Number value{};
    array(&value, 1);
    return value;
  }
  /// Of items that take at least `bytes_each`: a count that cannot be true is refused before
  /// memory is asked for.
  std::size_t size(std::size_t bytes_each) {
    const auto value = number<std::uint64_t>();
    if (value > bytes_.size() / bytes_each) refuse();
    return static_cast<std::size_t>(value);
  }
  std::string text() {
    const std::size_t length = size(1);
    std::string value(bytes_.substr(0, length));
    bytes_.remove_prefix(length);
    return value;
  }
  template <typename Item>
  void array(Item* items, std::size_t count) {
    if (count > bytes_.size() / sizeof(Item)) refuse();
    if (count == 0) return;
    std::memcpy(items, bytes_.data(), count * sizeof(Item));
    bytes_.remove_prefix(count * sizeof(Item));
  }
  void end() const {
    if (!bytes_.empty()) refuse();
  }

 private:
  [[noreturn]] static void refuse() {
    throw FileFailure(IoErrc::bad_data, "journal: a record of another shape");
  }

  std::string_view bytes_;
};

RecordingLayout unpack_layout(Unpacker& in) {
  RecordingLayout layout;
  layout.points.resize(in.size(2 * sizeof(double)));
  for (PlannedPoint& point : layout.points) {
    point.speed_rpm = in.number<double>();
    point.load_pct = in.number<double>();
    point.repeat = in.number<int>();
  }
  layout.acceleration_channels.resize(in.size(sizeof(double)));
  for (ChannelInfo& channel : layout.acceleration_channels) {
    channel.name = in.text();
    channel.unit = in.text();
    channel.direction = in.text();
    channel.sensitivity = in.number<double>();
  }
  layout.acceleration_rate_Hz = in.number<double>();
  layout.acceleration_range_m_s2 = in.number<double>();
  layout.torque_rate_Hz = in.number<double>();
  layout.software = in.text();
  return layout;
}

AccelerationStep unpack_acceleration(Unpacker& in) {
  AccelerationStep step;
  step.point = in.number<int>();
  step.block.t0_s = in.number<double>();
  const auto channels = in.number<std::uint64_t>();
  std::vector<float> samples(in.size(sizeof(float)));
  in.array(samples.data(), samples.size());
  if (channels == 0 || samples.empty() || samples.size() % channels != 0) {
    throw FileFailure(IoErrc::bad_data, "journal: a block of another shape");
  }
  step.block.scans = Eigen::Map<const AccelerationBlock::Scans>(
      samples.data(), static_cast<Eigen::Index>(samples.size() / channels),
      static_cast<Eigen::Index>(channels));
  return step;
}

TorqueStep unpack_torque(Unpacker& in) {
  TorqueStep step;
  step.point = in.number<int>();
  step.block.t0_s = in.number<double>();
  step.block.samples.resize(in.size(2 * sizeof(double)));
  for (TorqueSample& sample : step.block.samples) {
    sample.torque_Nm = in.number<double>();
    sample.angle_rad = in.number<double>();
  }
  return step;
}

PointResult unpack_result(Unpacker& in) {
  PointResult result;
  result.point = in.number<int>();
  result.t0_s = in.number<double>();
  result.status = in.text();
  result.speed_rpm = in.number<double>();
  result.torque_Nm = in.number<double>();
  result.acceleration_time_uncertainty_s = in.number<double>();
  result.torque_time_uncertainty_s = in.number<double>();
  return result;
}

JournalRecord unpack(Kind kind, Unpacker& in) {
  switch (kind) {
    case Kind::layout: return unpack_layout(in);
    case Kind::acceleration: return unpack_acceleration(in);
    case Kind::torque: return unpack_torque(in);
    case Kind::result: return unpack_result(in);
    case Kind::note: {
      const auto time_s = in.number<double>();
      return NoteStep{time_s, in.text()};
    }
  }
  throw FileFailure(IoErrc::bad_data, "journal: a record of another kind");
}

}  // namespace

std::string bytes_of(const RecordingLayout& layout) {
  Packer out(Kind::layout);
  out.size(layout.points.size());
  for (const PlannedPoint& point : layout.points) {
    out.number(point.speed_rpm);
    out.number(point.load_pct);
    out.number(point.repeat);
  }
  out.size(layout.acceleration_channels.size());
  for (const ChannelInfo& channel : layout.acceleration_channels) {
    out.text(channel.name);
    out.text(channel.unit);
    out.text(channel.direction);
    out.number(channel.sensitivity);
  }
  out.number(layout.acceleration_rate_Hz);
  out.number(layout.acceleration_range_m_s2);
  out.number(layout.torque_rate_Hz);
  out.text(layout.software);
  return out.take();
}

std::string bytes_of(int point, const AccelerationBlock& block) {
  Packer out(Kind::acceleration);
  out.number(point);
  out.number(block.t0_s);
  out.size(static_cast<std::size_t>(block.scans.cols()));
  const auto count = static_cast<std::size_t>(block.scans.size());
  out.size(count);
  out.array(block.scans.data(), count);
  return out.take();
}

std::string bytes_of(int point, const TorqueBlock& block) {
  Packer out(Kind::torque);
  out.number(point);
  out.number(block.t0_s);
  out.size(block.samples.size());
  for (const TorqueSample& sample : block.samples) {
    out.number(sample.torque_Nm);
    out.number(sample.angle_rad);
  }
  return out.take();
}

std::string bytes_of(const PointResult& result) {
  Packer out(Kind::result);
  out.number(result.point);
  out.number(result.t0_s);
  out.text(result.status);
  out.number(result.speed_rpm);
  out.number(result.torque_Nm);
  out.number(result.acceleration_time_uncertainty_s);
  out.number(result.torque_time_uncertainty_s);
  return out.take();
}

std::string bytes_of(double time_s, const std::string& event) {
  Packer out(Kind::note);
  out.number(time_s);
  out.text(event);
  return out.take();
}

JournalRecord record_of(std::string_view bytes) {
  Unpacker in(bytes);
  const Kind kind = in.number<Kind>();
  JournalRecord record = unpack(kind, in);
  in.end();
  return record;
}

}  // namespace rvbench::hal::hdf5
