#include "hal/daq/streamed_accelerometers.hpp"

#include <stdexcept>
#include <string_view>
#include <utility>

#include "hal/real_time.hpp"
#include "hal/types/require_positive.hpp"

namespace rvbench::hal {
namespace {

constexpr double most_waiting_s = 5;  // for read(), which comes every few milliseconds

}  // namespace

StreamedAccelerometers::StreamedAccelerometers(std::string where,
                                               std::unique_ptr<ScanSource> source,
                                               std::vector<ChannelInfo> channels, double deadline_s,
                                               Clock& clock)
    : where_(std::move(where)),
      source_(std::move(source)),
      channels_(std::move(channels)),
      deadline_s_(deadline_s),
      clock_(clock) {
  require_positive(deadline_s, "StreamedAccelerometers", "deadline_s");
  if (channels_.empty()) throw std::invalid_argument("StreamedAccelerometers: no channel");
}

StreamedAccelerometers::~StreamedAccelerometers() { stop(); }

Status StreamedAccelerometers::connect() {
  stop();
  const Status connected = source_->connect();
  is_connected_ = bool(connected);
  if (!connected) return failure(connected.error());
  return Done{};
}

Status StreamedAccelerometers::start() {
  if (!is_connected_) return failure({IoErrc::disconnected, "start: not connected"});
  stop();
  if (const Status started = source_->start(); !started) return failure(started.error());
  const double rate_Hz = source_->rate_Hz();
  stream_ = std::make_unique<ScanStream>(rate_Hz, Eigen::Index(rate_Hz * most_waiting_s));
  fresh_s_ = clock_.now_s();
  pump_.start([this](const std::stop_token& stop) { pump(stop); });
  return Done{};
}

// What a device cannot hand on in time it drops: reading comes before all that can wait.
void StreamedAccelerometers::pump(const std::stop_token& stop) {
  (void)make_this_thread_urgent();  // so is who reads, and would wait for it at the stream's lock
  while (!stop.stop_requested()) {
    AccelerationBlock::Scans scans;
    if (const Status waited = source_->wait(scans); !waited) return stream_->fail(waited.error());
    stream_->push(std::move(scans), clock_.now_s());
  }
}

Result<AccelerationBlock> StreamedAccelerometers::read() {
  if (!stream_) return failure({IoErrc::disconnected, "read: not started"});
  auto taken = stream_->take();
  if (!taken) return failure(taken.error());
  AccelerationBlock block;
  block.t0_s = taken.value().t0_s;
  block.time_uncertainty_s = stream_->uncertainty_s();
  block.scans = std::move(taken).value().scans;
  if (block.scans.rows() > 0) {
    fresh_s_ = clock_.now_s();
  } else if (const std::string_view thrown = pump_.thrown(); !thrown.empty()) {
    return failure({IoErrc::disconnected, "read: nobody listens: " + std::string(thrown)});
  } else if (clock_.now_s() - fresh_s_ > deadline_s_) {
    return failure({IoErrc::timeout, "read: no scan"});
  } else {
    block.scans.resize(0, Eigen::Index(channels_.size()));
  }
  return block;
}

void StreamedAccelerometers::stop() noexcept {
  if (pump_.is_started()) {
    pump_.request_stop();
    source_->interrupt();
    pump_.stop();
  }
  source_->stop();
  stream_.reset();
}

IoError StreamedAccelerometers::failure(const IoError& error) const {
  return {error.code, where_ + ": " + error.where};
}

}  // namespace rvbench::hal
