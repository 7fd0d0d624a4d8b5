#include "hal/daq/comedi_accelerometers.hpp"

#include <comedilib.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "hal/daq/require_inputs.hpp"

namespace rvbench::hal {
namespace {

constexpr double buffer_s = 1;  // of the driver: as long as this computer may be busy elsewhere

struct CloseDevice {
  void operator()(comedi_t* device) const noexcept { comedi_close(device); }
};

std::optional<unsigned> channel_number(const std::string& text) {
  unsigned number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

// m/s² of a count: base + gain * count.
struct Input {
  double base_m_s2 = 0, gain_m_s2 = 0;
};

class ComediSource final : public ScanSource {
 public:
  explicit ComediSource(ComediOptions options)
      : options_(std::move(options)), interrupted_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}
  ~ComediSource() override {
    stop();
    ::close(interrupted_);
  }
  ComediSource(const ComediSource&) = delete;
  ComediSource& operator=(const ComediSource&) = delete;

  Status connect() override;
  double rate_Hz() const override { return rate_Hz_ > 0 ? rate_Hz_ : options_.rate_Hz; }
  double range_m_s2() const override { return std::min(options_.range_m_s2, board_m_s2_); }
  Status start() override;
  Status wait(AccelerationBlock::Scans& scans) override;
  void interrupt() noexcept override { (void)::eventfd_write(interrupted_, 1); }
  void stop() noexcept override;

 private:
  Status find_inputs();
  Status find_rate();
  void ask_for_buffer();
  void fetch();
  double count_at(std::size_t sample) const;

  ComediOptions options_;
  int interrupted_;
  std::unique_ptr<comedi_t, CloseDevice> device_;
  unsigned subdevice_ = 0;
  std::size_t sample_bytes_ = 2;
  std::vector<Input> inputs_;
  std::vector<unsigned> scan_list_;
  comedi_cmd command_{};
  std::vector<char> fetched_;   // from the last whole scan on
  std::optional<IoError> end_;  // of the stream
  double rate_Hz_ = 0;
  double board_m_s2_ = std::numeric_limits<double>::infinity();
};

IoError refused(const std::string& why) { return {IoErrc::refused, "connect: " + why}; }

Status ComediSource::connect() {
  stop();
  comedi_loglevel(0);  // it would write to standard error by itself
  device_.reset(comedi_open(options_.device.c_str()));
  if (!device_) {
    return IoError{IoErrc::disconnected,
                   std::string("connect: ") + comedi_strerror(comedi_errno())};
  }
  const int found = comedi_get_read_subdevice(device_.get());
  if (found < 0) return refused(options_.device + " has no inputs that scan");
  subdevice_ = unsigned(found);
  const int flags = comedi_get_subdevice_flags(device_.get(), subdevice_);
  sample_bytes_ = (unsigned(flags) & SDF_LSAMPL) != 0 ? sizeof(lsampl_t) : sizeof(sampl_t);
  if (const Status inputs = find_inputs(); !inputs) return inputs;
  return find_rate();
}

Status ComediSource::find_inputs() {
  inputs_.clear();
  scan_list_.clear();
  board_m_s2_ = std::numeric_limits<double>::infinity();
  const int channels = comedi_get_n_channels(device_.get(), subdevice_);
  for (const DaqInput& input : options_.inputs) {
    const unsigned channel = *channel_number(input.device_channel);
    if (channel >= unsigned(std::max(channels, 0))) {
      return refused(fmt::format("{} has no input {} (there is: 0 to {})", options_.device, channel,
                                 channels - 1));
    }
    const int range = comedi_find_range(device_.get(), subdevice_, channel, UNIT_volt,
                                        -options_.range_V, options_.range_V);
    if (range < 0) {
      return refused(fmt::format("input {} has no range of ±{:g} V", channel, options_.range_V));
    }
    const comedi_range* volts =
        comedi_get_range(device_.get(), subdevice_, channel, unsigned(range));
    const lsampl_t most = comedi_get_maxdata(device_.get(), subdevice_, channel);
    if (volts == nullptr || most == 0) return refused(fmt::format("input {}: no range", channel));
    const double scale = 1 / input.info.sensitivity;
    inputs_.push_back({volts->min * scale, (volts->max - volts->min) / double(most) * scale});
    scan_list_.push_back(CR_PACK(channel, unsigned(range), AREF_GROUND));
    board_m_s2_ = std::min(board_m_s2_,
                           std::min(std::abs(volts->min), std::abs(volts->max)) * std::abs(scale));
  }
  return Done{};
}

// A test of the command replaces its times by those that the board can do.
Status ComediSource::find_rate() {
  const auto inputs = unsigned(inputs_.size());
  const auto period_ns = unsigned(std::lround(1e9 / options_.rate_Hz));
  command_ = {};
  int tested =
      comedi_get_cmd_generic_timed(device_.get(), subdevice_, &command_, inputs, period_ns);
  command_.chanlist = scan_list_.data();
  command_.chanlist_len = inputs;
  command_.scan_end_arg = inputs;
  command_.stop_src = TRIG_NONE;
  command_.stop_arg = 0;
  for (int i = 0; i < 4 && tested >= 0; ++i) {
    tested = comedi_command_test(device_.get(), &command_);
    if (tested == 0) break;
  }
  const double scan_ns = command_.scan_begin_src == TRIG_TIMER
                             ? double(command_.scan_begin_arg)
                             : double(command_.convert_arg) * double(inputs);
  if (tested != 0 || !(scan_ns > 0)) {
    return refused(
        fmt::format("{} inputs at {:g} Hz: {}", inputs, options_.rate_Hz,
                    tested < 0 ? comedi_strerror(comedi_errno()) : "the board cannot do that"));
  }
  rate_Hz_ = 1e9 / scan_ns;
  ask_for_buffer();
  return Done{};
}

// More than the administrator allows is not given; then it stays as it is.
void ComediSource::ask_for_buffer() {
  const double bytes = buffer_s * rate_Hz_ * double(inputs_.size() * sample_bytes_);
  const auto page = double(::sysconf(_SC_PAGESIZE));
  const auto wanted = unsigned(std::ceil(bytes / page) * page);
  if (comedi_get_buffer_size(device_.get(), subdevice_) >= int(wanted)) return;
  (void)comedi_set_max_buffer_size(device_.get(), subdevice_, wanted);
  (void)comedi_set_buffer_size(device_.get(), subdevice_, wanted);
}

Status ComediSource::start() {
  const int file = comedi_fileno(device_.get());
  (void)::fcntl(file, F_SETFL, ::fcntl(file, F_GETFL) | O_NONBLOCK);
  eventfd_t ignored = 0;
  (void)::eventfd_read(interrupted_, &ignored);
  fetched_.clear();
  end_.reset();
  if (comedi_command(device_.get(), &command_) < 0) {
    return IoError{IoErrc::refused, std::string("start: ") + comedi_strerror(comedi_errno())};
  }
  return Done{};
}

// Fetched by the clock, not whenever the driver has some: few boards tell of more than a sample.
Status ComediSource::wait(AccelerationBlock::Scans& scans) {
  pollfd interrupted{interrupted_, POLLIN, 0};
  if (::poll(&interrupted, 1, int(std::ceil(1e3 * options_.block_s))) > 0) return Done{};
  (void)comedi_poll(device_.get(),
                    subdevice_);  // boards without interrupts hand on only when asked
  fetch();
  const std::size_t columns = inputs_.size();
  const std::size_t rows = fetched_.size() / sample_bytes_ / columns;
  if (rows == 0 && end_) return *end_;
  scans.resize(Eigen::Index(rows), Eigen::Index(columns));
  for (std::size_t i = 0; i < rows * columns; ++i) {
    const Input& input = inputs_[i % columns];
    scans.data()[i] = float(input.base_m_s2 + input.gain_m_s2 * count_at(i));
  }
  fetched_.erase(fetched_.begin(),
                 fetched_.begin() + std::ptrdiff_t(rows * columns * sample_bytes_));
  return Done{};
}

// All that has come, behind what is left of a scan. How the stream ended is told once by the
// driver, and often right behind the last scans.
void ComediSource::fetch() {
  constexpr std::size_t chunk = 1U << 16U;
  while (!end_) {
    const std::size_t have = fetched_.size();
    fetched_.resize(have + chunk);
    const ssize_t come = ::read(comedi_fileno(device_.get()), fetched_.data() + have, chunk);
    const int error = errno;
    fetched_.resize(have + std::size_t(std::max<ssize_t>(come, 0)));
    if (come > 0) continue;
    if (come < 0 && (error == EAGAIN || error == EINTR)) return;
    if (come == 0) {
      end_ = IoError{IoErrc::disconnected, "read: the board stopped by itself"};
    } else if (error == EPIPE) {
      end_ = IoError{IoErrc::overrun, "read: the board's buffer ran over"};
    } else {
      end_ = IoError{IoErrc::disconnected, std::string("read: ") + std::strerror(error)};
    }
  }
}

double ComediSource::count_at(std::size_t sample) const {
  const char* at = fetched_.data() + sample * sample_bytes_;
  if (sample_bytes_ == sizeof(lsampl_t)) {
    lsampl_t count = 0;
    std::memcpy(&count, at, sizeof count);
    return double(count);
  }
  sampl_t count = 0;
  std::memcpy(&count, at, sizeof count);
  return double(count);
}

void ComediSource::stop() noexcept {
  if (device_) (void)comedi_cancel(device_.get(), subdevice_);
}

void check(const ComediOptions& options) {
  constexpr Require require{"make_comedi_accelerometers"};
  require(!options.device.empty(), "no device");
  require(options.rate_Hz >= 1 && options.rate_Hz <= 1e6,
          fmt::format("rate_Hz is {}, must be 1 to 1e6", options.rate_Hz));
  require(options.range_V > 0 && std::isfinite(options.range_V),
          fmt::format("range_V is {}", options.range_V));
  require_inputs(require, options.inputs, options.range_m_s2, options.block_s);
  std::set<unsigned> used;
  for (const DaqInput& input : options.inputs) {
    const auto channel = channel_number(input.device_channel);
    require(channel.has_value(), "channel '" + input.device_channel + "' is no number");
    require(std::isfinite(input.info.sensitivity),
            fmt::format("sensitivity of {} is {}", *channel, input.info.sensitivity));
    require(used.insert(*channel).second, fmt::format("channel {} comes twice", *channel));
  }
}

}  // namespace

std::unique_ptr<StreamedAccelerometers> make_comedi_accelerometers(ComediOptions options,
                                                                   Clock& clock) {
  check(options);
  std::vector<ChannelInfo> channels;
  for (const DaqInput& input : options.inputs) channels.push_back(input.info);
  const std::string where = "accelerometers " + options.device;
  const double deadline_s = options.deadline_s;
  return std::make_unique<StreamedAccelerometers>(
      where, std::make_unique<ComediSource>(std::move(options)), std::move(channels), deadline_s,
      clock);
}

}  // namespace rvbench::hal
