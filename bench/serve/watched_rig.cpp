#include "bench/serve/watched_rig.hpp"

#include <utility>

namespace rvbench::bench {
namespace {

using Feed = std::shared_ptr<LiveFeed>;

class WatchedTorqueSensor final : public hal::TorqueSensor {
 public:
  WatchedTorqueSensor(std::unique_ptr<hal::TorqueSensor> sensor, Feed feed)
      : sensor_(std::move(sensor)), feed_(std::move(feed)) {}
  double rate_Hz() const override { return sensor_->rate_Hz(); }
  Status connect() override { return sensor_->connect(); }
  Result<hal::TorqueBlock> read() override {
    auto block = sensor_->read();
    if (block) feed_->take(block.value(), sensor_->rate_Hz());
    return block;
  }

 private:
  std::unique_ptr<hal::TorqueSensor> sensor_;
  Feed feed_;
};

class WatchedAccelerometers final : public hal::Accelerometers {
 public:
  WatchedAccelerometers(std::unique_ptr<hal::Accelerometers> sensors, Feed feed)
      : sensors_(std::move(sensors)), feed_(std::move(feed)) {}
  const std::vector<ChannelInfo>& channels() const override { return sensors_->channels(); }
  double range_m_s2() const override { return sensors_->range_m_s2(); }
  double rate_Hz() const override { return sensors_->rate_Hz(); }
  double hole_told_after_s() const override { return sensors_->hole_told_after_s(); }
  Status connect() override { return sensors_->connect(); }
  Status start() override { return sensors_->start(); }
  void stop() noexcept override { sensors_->stop(); }
  Result<hal::AccelerationBlock> read() override {
    auto block = sensors_->read();
    if (block && !sensors_->channels().empty()) {
      feed_->take(block.value(), sensors_->rate_Hz(), sensors_->channels().front().name);
    }
    return block;
  }

 private:
  std::unique_ptr<hal::Accelerometers> sensors_;
  Feed feed_;
};

class WatchedSafetyInputs final : public hal::SafetyInputs {
 public:
  WatchedSafetyInputs(std::unique_ptr<hal::SafetyInputs> inputs, Feed feed)
      : inputs_(std::move(inputs)), feed_(std::move(feed)) {}
  Status connect() override { return inputs_->connect(); }
  Result<hal::SafetyStatus> read() override {
    auto status = inputs_->read();
    if (status) feed_->take_temperature(status.value().housing_temp_degC);
    return status;
  }

 private:
  std::unique_ptr<hal::SafetyInputs> inputs_;
  Feed feed_;
};

class PointsTold final : public hal::RecordingWriter {
 public:
  PointsTold(std::unique_ptr<hal::RecordingWriter> writer, Feed feed)
      : writer_(std::move(writer)), feed_(std::move(feed)) {}
  Status append(int point, const hal::AccelerationBlock& block) override {
    begin(point);
    return writer_->append(point, block);
  }
  Status append(int point, const hal::TorqueBlock& block) override {
    begin(point);
    return writer_->append(point, block);
  }
  Status end_point(const hal::PointResult& result) override {
    Status ended = writer_->end_point(result);
    feed_->end_point(result.point, ended && result.status == "ok");
    return ended;
  }
  Status note(double time_s, const std::string& event) override {
    return writer_->note(time_s, event);
  }
  Status close() override { return writer_->close(); }

 private:
  void begin(int point) {
    if (point == point_) return;
    point_ = point;
    feed_->begin_point(point);
  }

  std::unique_ptr<hal::RecordingWriter> writer_;
  Feed feed_;
  int point_ = -1;
};

}  // namespace

void watch(hal::Rig& rig, const std::shared_ptr<LiveFeed>& feed) {
  rig.torque_sensor = std::make_unique<WatchedTorqueSensor>(std::move(rig.torque_sensor), feed);
  rig.accelerometers = std::make_unique<WatchedAccelerometers>(std::move(rig.accelerometers), feed);
  rig.safety = std::make_unique<WatchedSafetyInputs>(std::move(rig.safety), feed);
}

RecordingMaker watched_recording(RecordingMaker make, std::shared_ptr<LiveFeed> feed) {
  return [make = std::move(make), feed = std::move(feed)](
             const std::filesystem::path& file,
             const hal::RecordingLayout& layout) -> Result<std::unique_ptr<hal::RecordingWriter>> {
    auto writer = make(file, layout);
    if (!writer) return writer.error();
    return std::unique_ptr<hal::RecordingWriter>(
        std::make_unique<PointsTold>(std::move(writer).value(), feed));
  };
}

}  // namespace rvbench::bench
