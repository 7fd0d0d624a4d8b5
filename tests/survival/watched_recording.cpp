#include "tests/survival/watched_recording.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <stdexcept>

#include "tests/survival/disk_calls.hpp"

namespace rvbench::test {
namespace {

template <typename Number>
void add_number(SampleSum& sum, Number number) {
  sum.sum = static_cast<std::uint32_t>(
      crc32(sum.sum, reinterpret_cast<const Bytef*>(&number), sizeof(number)));
}

class WatchedRecording final : public hal::RecordingWriter {
 public:
  explicit WatchedRecording(std::unique_ptr<hal::RecordingWriter> writer)
      : writer_(std::move(writer)) {}

  Status append(int point, const hal::AccelerationBlock& block) override {
    accelerations_.add(block);
    tell(fmt::format("handed {} a {} {}", point, accelerations_.count, accelerations_.sum));
    return writer_->append(point, block);
  }
  Status append(int point, const hal::TorqueBlock& block) override {
    torques_.add(block);
    tell(fmt::format("handed {} t {} {}", point, torques_.count, torques_.sum));
    return writer_->append(point, block);
  }
  Status end_point(const hal::PointResult& result) override {
    const Status status = writer_->end_point(result);
    if (status) {
      tell(fmt::format("ended {} {} {} {} {} {}", result.point, accelerations_.count,
                       accelerations_.sum, torques_.count, torques_.sum, result.status));
    }
    accelerations_ = torques_ = {};
    return status;
  }
  Status note(double time_s, const std::string& event) override {
    return writer_->note(time_s, event);
  }
  Status close() override { return writer_->close(); }

 private:
  std::unique_ptr<hal::RecordingWriter> writer_;
  SampleSum accelerations_, torques_;
};

const Channel& channel_of(const Recording& record, std::string_view name) {
  const Channel* found = record.find(name);
  if (found == nullptr) throw std::runtime_error("survival: no channel " + std::string(name));
  return *found;
}

}  // namespace

void SampleSum::add(const hal::AccelerationBlock& block) {
  count += static_cast<std::uint32_t>(block.scans.rows());
  for (Eigen::Index i = 0; i < block.scans.size(); ++i) add_number(*this, block.scans.data()[i]);
}

void SampleSum::add(const hal::TorqueBlock& block) {
  count += static_cast<std::uint32_t>(block.samples.size());
  for (const hal::TorqueSample& sample : block.samples) {
    add_number(*this, static_cast<float>(sample.torque_Nm));
    add_number(*this, sample.angle_rad);
  }
}

SampleSum accelerations_in(const Recording& record) {
  std::vector<const Channel*> channels;
  for (const Channel& channel : record.channels) {
    if (!is_of_shaft(channel.info)) channels.push_back(&channel);
  }
  SampleSum sum;
  const Eigen::Index scans = channels.empty() ? 0 : channels.front()->samples.size();
  for (; sum.count < scans; ++sum.count) {
    for (const Channel* channel : channels) {
      add_number(sum, static_cast<float>(channel->samples[sum.count]));
    }
  }
  return sum;
}

SampleSum torques_in(const Recording& record) {
  const Eigen::VectorXd& torques = channel_of(record, channel_names::input_torque).samples;
  const Eigen::VectorXd& angles = channel_of(record, channel_names::input_angle).samples;
  if (torques.size() != angles.size()) throw std::runtime_error("survival: torque without angle");
  SampleSum sum;
  for (; sum.count < torques.size(); ++sum.count) {
    add_number(sum, static_cast<float>(torques[sum.count]));
    add_number(sum, angles[sum.count]);
  }
  return sum;
}

std::unique_ptr<hal::RecordingWriter> watched(std::unique_ptr<hal::RecordingWriter> writer,
                                              const std::filesystem::path& file) {
  tell("begun " + file.filename().string());
  return std::make_unique<WatchedRecording>(std::move(writer));
}

}  // namespace rvbench::test
