#pragma once

#include <memory>
#include <vector>

#include "hal/clock.hpp"
#include "hal/daq/scan_source.hpp"
#include "hal/daq/scan_stream.hpp"
#include "hal/device_thread.hpp"

namespace rvbench::hal {

/// The role over any ScanSource: a thread of its own waits for the device, so that read() never
/// does.
///
/// Errors   timeout: no scan within the deadline; overrun: scans are missing, and where is not
///          known; disconnected: something was thrown in that thread; whatever else the source
///          says. After an error start() goes on
/// Holes    that the front end does not tell are found by SampleClock, which says how small ones
///          and when
/// Time     t0_s by SampleClock: how sure, a block tells from the third second on. The DAQ's own
/// delay, which
///          stays in, is that of its converter and of the transport
class StreamedAccelerometers final : public Accelerometers {
 public:
  /// @param where     of errors: "accelerometers ip:192.168.1.5"
  /// @param channels  of the source's inputs, in their order
  /// @param clock     must outlive it
  /// @throws std::invalid_argument if there is no channel, or the deadline is not positive
  StreamedAccelerometers(std::string where, std::unique_ptr<ScanSource> source,
                         std::vector<ChannelInfo> channels, double deadline_s, Clock& clock);
  ~StreamedAccelerometers() override;

  const std::vector<ChannelInfo>& channels() const override { return channels_; }
  double range_m_s2() const override { return source_->range_m_s2(); }
  double rate_Hz() const override { return source_->rate_Hz(); }
  double hole_told_after_s() const override { return SampleClock::hole_found_within_s; }
  Status connect() override;
  Status start() override;
  Result<AccelerationBlock> read() override;
  void stop() noexcept override;

 private:
  void pump(const std::stop_token& stop);
  IoError failure(const IoError& error) const;

  const std::string where_;
  std::unique_ptr<ScanSource> source_;
  std::vector<ChannelInfo> channels_;
  double deadline_s_;
  Clock& clock_;
  bool is_connected_ = false;
  double fresh_s_ = 0;
  std::unique_ptr<ScanStream> stream_;
  DeviceThread pump_;
};

}  // namespace rvbench::hal
