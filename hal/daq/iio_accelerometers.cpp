#include "hal/daq/iio_accelerometers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iio.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <limits>
#include <utility>

#include "hal/daq/captured_complaints.hpp"
#include "hal/daq/iio_input.hpp"
#include "hal/daq/no_pipe_signal.hpp"
#include "hal/daq/require_inputs.hpp"
#include "hal/did_you_mean.hpp"

namespace rvbench::hal {
namespace {

constexpr double least_patience_s = 0.25;
constexpr unsigned connect_ms = 2000;
constexpr double kernel_buffer_s = 1;  // libiio's own four blocks are lost on a busy computer

struct DestroyContext {
  void operator()(iio_context* context) const noexcept {
    const NoPipeSignal quiet;
    iio_context_destroy(context);
  }
};
struct DestroyBuffer {
  void operator()(iio_buffer* buffer) const noexcept {
    const NoPipeSignal quiet;
    iio_buffer_destroy(buffer);
  }
};

IoErrc code_of(ssize_t error) {
  switch (-error) {
    case ETIMEDOUT:
    case EAGAIN: return IoErrc::timeout;
    case EOVERFLOW:
    case ENOBUFS: return IoErrc::overrun;
    default: return IoErrc::disconnected;
  }
}

std::vector<std::string> device_names(const iio_context* context) {
  std::vector<std::string> names;
  for (unsigned i = 0; i < iio_context_get_devices_count(context); ++i) {
    const iio_device* device = iio_context_get_device(context, i);
    const char* name = iio_device_get_name(device);
    names.emplace_back(name != nullptr ? name : iio_device_get_id(device));
  }
  return names;
}

std::vector<std::string> input_names(const iio_device* device) {
  std::vector<std::string> names;
  for (unsigned i = 0; i < iio_device_get_channels_count(device); ++i) {
    const iio_channel* channel = iio_device_get_channel(device, i);
    if (!iio_channel_is_output(channel) && iio_channel_is_scan_element(channel)) {
      names.emplace_back(iio_channel_get_id(channel));
    }
  }
  return names;
}

std::string there_is(const std::string& wrong, const std::vector<std::string>& names) {
  return fmt::format("{} (there is: {})", did_you_mean(wrong, names), fmt::join(names, ", "));
}

class IioSource final : public ScanSource {
 public:
  explicit IioSource(IioOptions options) : options_(std::move(options)) {}

  Status connect() override;
  double rate_Hz() const override { return rate_Hz_ > 0 ? rate_Hz_ : options_.rate_Hz; }
  double range_m_s2() const override { return std::min(options_.range_m_s2, converter_m_s2_); }
  Status start() override;
  Status wait(AccelerationBlock::Scans& scans) override;
  // A block comes soon, or the time-out does. (iio_buffer_cancel() would be quicker where a device
  // is silent, and makes libiio complain on standard error.)
  void interrupt() noexcept override {}
  void stop() noexcept override { buffer_.reset(); }

 private:
  Status find_inputs();
  Status set_rate();

  IioOptions options_;
  std::unique_ptr<iio_context, DestroyContext> context_;
  iio_device* device_ = nullptr;  // the context's
  std::vector<IioInput> inputs_;
  std::unique_ptr<iio_buffer, DestroyBuffer> buffer_;
  double rate_Hz_ = 0;
  double converter_m_s2_ = std::numeric_limits<double>::infinity();
};

Status IioSource::connect() {
  const NoPipeSignal quiet;
  buffer_.reset();
  inputs_.clear();
  std::string uri = options_.uri;  // libiio 0.24 cuts the port off the very text it is given
  {
    const CapturedComplaints complaints;
    context_.reset(iio_create_context_from_uri(uri.data()));
    const std::string why = context_ ? "" : iio_reason(errno);
    const std::string more = context_ ? "" : complaints.text();
    if (!context_) {
      return IoError{IoErrc::disconnected, "connect: " + why + (more.empty() ? "" : ": ") + more};
    }
  }
  (void)iio_context_set_timeout(context_.get(), connect_ms);
  device_ = iio_context_find_device(context_.get(), options_.device.c_str());
  if (device_ == nullptr) {
    return IoError{IoErrc::refused, "no device " + in_quotes(options_.device) +
                                        there_is(options_.device, device_names(context_.get()))};
  }
  if (const Status found = find_inputs(); !found) return found;
  return set_rate();
}

Status IioSource::find_inputs() {
  converter_m_s2_ = std::numeric_limits<double>::infinity();
  for (unsigned i = 0; i < iio_device_get_channels_count(device_); ++i) {
    iio_channel_disable(iio_device_get_channel(device_, i));
  }
  for (const DaqInput& input : options_.inputs) {
    iio_channel* channel = iio_device_find_channel(device_, input.device_channel.c_str(), false);
    if (channel == nullptr || !iio_channel_is_scan_element(channel)) {
      return IoError{IoErrc::refused, options_.device + " has no input " +
                                          in_quotes(input.device_channel) +
                                          there_is(input.device_channel, input_names(device_))};
    }
    iio_channel_enable(channel);
    const auto read = read_iio_input(channel, input.info.sensitivity);
    if (!read) return read.error();
    inputs_.push_back(read.value());
    converter_m_s2_ = std::min(converter_m_s2_, read.value().full_scale_m_s2());
  }
  return Done{};
}

// Of the device, or where it has none, of each channel.
Status IioSource::set_rate() {
  const char* const name = "sampling_frequency";
  const bool is_of_device = iio_device_find_attr(device_, name) != nullptr;
  int failed = 0;
  if (is_of_device) {
    failed = iio_device_attr_write_double(device_, name, options_.rate_Hz);
    if (failed == 0) failed = iio_device_attr_read_double(device_, name, &rate_Hz_);
  } else {
    iio_channel* first = inputs_.front().channel;
    failed = iio_channel_attr_write_double(first, name, options_.rate_Hz);
    if (failed == 0) failed = iio_channel_attr_read_double(first, name, &rate_Hz_);
  }
  if (failed < 0 || !(rate_Hz_ > 0)) {
    return IoError{
        failed < 0 ? IoErrc::refused : IoErrc::bad_reply,
        fmt::format("{} of {:g} Hz: {}", name, options_.rate_Hz,
                    failed < 0 ? iio_reason(failed) : fmt::format("now {:g} Hz", rate_Hz_))};
  }
  return Done{};
}

Status IioSource::start() {
  const NoPipeSignal quiet;
  buffer_.reset();
  // libiio lets the other side wait half as long as itself: its answer must come first. A buffer
  // has the time-out of its beginning.
  const double patience_s = std::max(least_patience_s, options_.deadline_s);
  (void)iio_context_set_timeout(context_.get(), unsigned(2e3 * patience_s));
  const double scans = std::max(1.0, std::round(rate_Hz_ * options_.block_s));
  const double blocks = std::ceil(kernel_buffer_s * rate_Hz_ / scans);
  (void)iio_device_set_kernel_buffers_count(device_, unsigned(std::max(4.0, blocks)));
  buffer_.reset(iio_device_create_buffer(device_, std::size_t(scans), false));
  if (!buffer_) return IoError{IoErrc::refused, "start: " + iio_reason(errno)};
  return Done{};
}

Status IioSource::wait(AccelerationBlock::Scans& scans) {
  const NoPipeSignal quiet;
  const ssize_t bytes = iio_buffer_refill(buffer_.get());
  if (bytes < 0) return IoError{code_of(bytes), "read: " + iio_reason(bytes)};
  const std::ptrdiff_t step = iio_buffer_step(buffer_.get());
  if (step <= 0) return IoError{IoErrc::bad_reply, "read: scans of no size"};
  const auto rows = Eigen::Index(bytes / step);
  scans.resize(rows, Eigen::Index(inputs_.size()));
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    const IioInput& input = inputs_[i];
    const auto* sample = static_cast<const char*>(iio_buffer_first(buffer_.get(), input.channel));
    for (Eigen::Index row = 0; row < rows; ++row, sample += step) {
      scans(row, Eigen::Index(i)) = float(input.m_s2_of(sample));
    }
  }
  return Done{};
}

void check(const IioOptions& options) {
  constexpr Require require{"make_iio_accelerometers"};
  require(!options.uri.empty(), "no uri");
  require(!options.device.empty(), "no device");
  require(options.rate_Hz > 0 && std::isfinite(options.rate_Hz),
          fmt::format("rate_Hz is {}", options.rate_Hz));
  require_inputs(require, options.inputs, options.range_m_s2, options.block_s);
}

}  // namespace

std::unique_ptr<StreamedAccelerometers> make_iio_accelerometers(IioOptions options, Clock& clock) {
  check(options);
  std::vector<ChannelInfo> channels;
  for (const DaqInput& input : options.inputs) channels.push_back(input.info);
  const std::string where = "accelerometers " + options.uri;
  const double deadline_s = options.deadline_s;
  return std::make_unique<StreamedAccelerometers>(where,
                                                  std::make_unique<IioSource>(std::move(options)),
                                                  std::move(channels), deadline_s, clock);
}

}  // namespace rvbench::hal
