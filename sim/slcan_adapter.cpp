#include "sim/slcan_adapter.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <charconv>
#include <chrono>
#include <mutex>
#include <optional>
#include <string_view>
#include <thread>

#include "sim/pseudo_terminal.hpp"

namespace rvbench::sim {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t queue_bytes = 4096;
constexpr std::size_t longest_command = 30;
constexpr std::chrono::milliseconds ack_delay{500};

constexpr unsigned queue_full_flag = 0x01;
constexpr unsigned bus_off_flags = 0xA4;  // bus error, error passive, error warning

const std::string bell = "\a";

std::optional<unsigned> number_from(std::string_view digits) {
  unsigned value = 0;
  const char* const end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, value, 16);
  if (digits.empty() || error != std::errc() || stop != end) return std::nullopt;
  return value;
}

// The frame of "t1232AABB"; nothing if that is none.
std::optional<hal::CanFrame> frame_from(std::string_view command) {
  if (command.size() < 5 || command[4] < '0' || command[4] > '8') return std::nullopt;
  const auto id = number_from(command.substr(1, 3));
  const auto length = static_cast<std::size_t>(command[4] - '0');
  if (!id || *id > 0x7FF || command.size() != 5 + 2 * length) return std::nullopt;
  hal::CanFrame frame{.id = *id, .length = static_cast<std::uint8_t>(length)};
  for (std::size_t i = 0; i < length; ++i) {
    const auto byte = number_from(command.substr(5 + 2 * i, 2));
    if (!byte) return std::nullopt;
    frame.data[i] = static_cast<std::uint8_t>(*byte);
  }
  return frame;
}

std::string line_from(const hal::CanFrame& frame) {
  std::string line = fmt::format("t{:03X}{:d}", frame.id, frame.length);
  for (std::size_t i = 0; i < frame.length; ++i) line += fmt::format("{:02X}", frame.data[i]);
  return line;
}

// The clock of an adapter: milliseconds within the minute.
std::string time_stamp() {
  const auto ms =
      std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now().time_since_epoch());
  return fmt::format("{:04X}", ms.count() % 60000);
}

}  // namespace

class SlcanAdapter::Service {
 public:
  explicit Service(hal::CanTransport& bus) : bus_(bus) {
    ::fcntl(terminal_.master(), F_SETFL, O_NONBLOCK);
    thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
  }
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;
  ~Service() = default;

  const std::string& device() const { return terminal_.device(); }

  void say(const std::string& bytes) {
    const std::lock_guard lock(unasked_mutex_);
    unasked_ += bytes;
  }

  std::atomic<SlcanFault> fault = SlcanFault::none;
  std::atomic<unsigned> flags = 0;
  std::atomic<int> bitrate_code = -1;
  std::atomic<bool> is_open = false;
  std::atomic<int> frames_to_bus = 0;
  std::atomic<int> frames_from_bus = 0;

 private:
  void serve(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      pollfd line{terminal_.master(), POLLIN, 0};
      (void)::poll(&line, 1, 1);
      take_commands();
      take_frames();
      if (ack_due_ && Clock::now() >= *ack_due_) {
        ack_due_.reset();
        put("z\r");
      }
      flush();
    }
  }

  void take_commands() {
    std::array<char, 256> chunk{};
    const auto count = ::read(terminal_.master(), chunk.data(), chunk.size());
    for (ssize_t i = 0; i < count; ++i) {
      const char c = chunk[static_cast<std::size_t>(i)];
      if (c != '\r') {
        if (command_.size() <= longest_command) command_ += c;
        continue;
      }
      const std::string answer = obey(command_);
      command_.clear();
      if (fault != SlcanFault::silent) put(answer);
    }
  }

  // What is answered.
  std::string obey(std::string_view command) {
    if (fault == SlcanFault::silent || command.empty()) return bell;
    const std::string_view rest = command.substr(1);
    switch (command[0]) {
      case 'S': return set_bitrate(rest);
      case 'Z': return set_time_stamps(rest);
      case 'O':
      case 'L': return rest.empty() ? open_channel(command[0] == 'L') : bell;
      case 'C': return rest.empty() && is_open.exchange(false) ? "\r" : bell;
      case 't': return send(command);
      case 'r': return is_sending() ? "z\r" : bell;
      case 'T':
      case 'R': return is_sending() ? "Z\r" : bell;
      case 'F': return rest.empty() && is_open ? fmt::format("F{:02X}\r", take_flags()) : bell;
      case 'V': return rest.empty() ? "V1013\r" : bell;
      case 'N': return rest.empty() ? "NRV01\r" : bell;
      default: return bell;
    }
  }

  std::string set_bitrate(std::string_view code) {
    if (is_open || code.size() != 1 || code[0] < '0' || code[0] > '8') return bell;
    bitrate_code = code[0] - '0';
    return "\r";
  }

  std::string set_time_stamps(std::string_view on) {
    if (is_open || (on != "0" && on != "1")) return bell;
    stamps_ = on == "1";
    return "\r";
  }

  std::string open_channel(bool listens_only) {
    if (is_open || bitrate_code < 0) return bell;
    flags = 0;
    listens_only_ = listens_only;
    while (bus_.receive()) continue;  // a channel that opens has heard nothing yet
    is_open = true;
    return "\r";
  }

  bool is_sending() const { return is_open && !listens_only_; }

  std::string send(std::string_view command) {
    const auto frame = frame_from(command);
    if (!frame || !is_sending()) return bell;
    if (fault != SlcanFault::bus_off && bus_.send(*frame)) ++frames_to_bus;
    if (fault != SlcanFault::slow_ack) return "z\r";
    ack_due_ = Clock::now() + ack_delay;
    return {};
  }

  unsigned take_flags() {
    return flags.exchange(0) | (fault == SlcanFault::bus_off ? bus_off_flags : 0);
  }

  void take_frames() {
    for (auto frame = bus_.receive(); frame; frame = bus_.receive()) {
      ++frames_from_bus;
      if (!is_open || fault == SlcanFault::silent || fault == SlcanFault::bus_off) continue;
      const std::string line = line_from(frame.value()) + (stamps_ ? time_stamp() : "") + '\r';
      if (queue_.size() + line.size() > queue_bytes) flush();
      if (queue_.size() + line.size() <= queue_bytes) {
        put(line);
      } else {
        flags |= queue_full_flag;
      }
    }
  }

  void put(std::string line) {
    if (fault == SlcanFault::garbled && !line.empty()) line.insert(line.size() / 2, "?");
    queue_ += line;
  }

  void flush() {
    {
      const std::lock_guard lock(unasked_mutex_);
      queue_ += std::exchange(unasked_, {});
    }
    const auto count = ::write(terminal_.master(), queue_.data(), queue_.size());
    if (count > 0) queue_.erase(0, static_cast<std::size_t>(count));
  }

  hal::CanTransport& bus_;
  PseudoTerminal terminal_;
  bool listens_only_ = false;
  bool stamps_ = false;
  std::string command_;  // as far as it has come
  std::string queue_;    // to be said
  std::optional<Clock::time_point> ack_due_;
  std::mutex unasked_mutex_;
  std::string unasked_;
  std::jthread thread_;  // last: it ends before what it uses
};

SlcanAdapter::SlcanAdapter(hal::CanTransport& bus) : service_(std::make_unique<Service>(bus)) {}

SlcanAdapter::~SlcanAdapter() = default;

const std::string& SlcanAdapter::device() const { return service_->device(); }

void SlcanAdapter::inject(SlcanFault fault) { service_->fault = fault; }

void SlcanAdapter::raise_flags(unsigned flags) { service_->flags |= flags; }

void SlcanAdapter::say(const std::string& bytes) { service_->say(bytes); }

int SlcanAdapter::bitrate_code() const { return service_->bitrate_code; }

bool SlcanAdapter::is_channel_open() const { return service_->is_open; }

int SlcanAdapter::frames_to_bus() const { return service_->frames_to_bus; }

int SlcanAdapter::frames_from_bus() const { return service_->frames_from_bus; }

}  // namespace rvbench::sim
