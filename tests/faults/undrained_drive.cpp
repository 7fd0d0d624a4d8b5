#include "tests/faults/undrained_drive.hpp"

#include <poll.h>

#include <cmath>
#include <vector>

#include "hal/modbus/drive_profile_json.hpp"
#include "hal/modbus/drive_words.hpp"
#include "tests/support/loopback.hpp"

namespace rvbench::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t header = 7;  // transaction, protocol, length, unit
constexpr std::uint8_t read_registers = 3;
constexpr std::uint8_t write_registers = 16;

std::uint8_t high(unsigned word) { return std::uint8_t(word >> 8U); }
std::uint8_t low(unsigned word) { return std::uint8_t(word & 0xFFU); }

class UndrainedDrive final : public hal::Drive {
 public:
  UndrainedDrive(std::uint16_t port, hal::Clock& clock, double response_timeout_s,
                 double patience_s)
      : profile_(hal::drive_profile("rvbench_generic")),
        port_(port),
        clock_(clock),
        response_timeout_s_(response_timeout_s),
        patience_s_(patience_s) {}

  hal::DriveLimits limits() const override { return {.max_speed_rpm = 3000}; }

  Status connect() override {
    if (!socket_) socket_ = connected_to(port_);
    if (!socket_) return IoError{IoErrc::disconnected, "undrained drive: connect"};
    return write(hal::words_for_stop(profile_));
  }

  Result<hal::DriveWatchdog> read_watchdog() override {
    hal::DriveWords words;
    const Status status = read_words(hal::watchdog_blocks(profile_), words);
    if (!status) return status.error();
    return hal::drive_watchdog(profile_, words);
  }

  Status set_speed(double speed_rpm) override {
    return write(hal::words_for_speed(profile_, speed_rpm, motor_));
  }

  Result<hal::DriveStatus> read() override {
    hal::DriveWords words;
    Status status = read_words(hal::status_blocks(profile_), words);
    if (!status) status = read_words(hal::status_blocks(profile_), words);
    if (!status) return status.error();
    const auto told = hal::drive_status(profile_, words, motor_);
    if (!told) return IoError{IoErrc::bad_reply, "undrained drive: read"};
    return *told;
  }

  void stop() noexcept override {
    try {
      (void)write(hal::words_for_stop(profile_));
    } catch (...) {  // out of memory: the drive's watchdog does the rest
    }
  }

  int retries() const override { return 0; }

 private:
  Status read_words(const std::vector<hal::DriveBlock>& blocks, hal::DriveWords& words) {
    for (const hal::DriveBlock& block : blocks) {
      const auto count = unsigned(block.count);
      const auto reply = exchange(
          {read_registers, high(block.address), low(block.address), high(count), low(count)});
      if (!reply) return reply.error();
      const Bytes& pdu = reply.value();
      if (pdu.size() != 2 + 2 * count || pdu[0] != read_registers) {
        return IoError{IoErrc::bad_reply, "undrained drive: not such a reply"};
      }
      for (unsigned i = 0; i < count; ++i) {
        words[std::uint16_t(block.address + i)] =
            std::uint16_t(pdu[2 + 2 * i] << 8U | pdu[3 + 2 * i]);
      }
    }
    return Done{};
  }

  // Control word and reference are neighbours. Any reply will do.
  Status write(const std::vector<hal::DriveWrite>& words) {
    for (const hal::DriveWrite& write : words) {
      const auto reply = exchange({write_registers, high(write.address), low(write.address), 0, 1,
                                   2, high(write.word), low(write.word)});
      if (!reply) return reply.error();
    }
    return Done{};
  }

  Result<Bytes> exchange(const Bytes& pdu) {
    ++transaction_;
    Bytes request{high(transaction_), low(transaction_), 0, 0, 0, std::uint8_t(1 + pdu.size()), 1};
    request.insert(request.end(), pdu.begin(), pdu.end());
    const bool sent = ::send(socket_.number(), request.data(), request.size(), MSG_NOSIGNAL) ==
                      ssize_t(request.size());
    pollfd line{socket_.number(), POLLIN, 0};
    if (!sent || ::poll(&line, 1, int(std::lround(1000 * patience_s_))) != 1) {
      clock_.wait_until(clock_.now_s() + response_timeout_s_);
      return IoError{IoErrc::timeout, "undrained drive"};
    }
    Bytes reply(header);
    if (!receive(reply.data(), header)) return IoError{IoErrc::disconnected, "undrained drive"};
    reply.resize(std::size_t(reply[5]) - 1);
    if (!receive(reply.data(), reply.size())) {
      return IoError{IoErrc::disconnected, "undrained drive"};
    }
    return reply;
  }

  bool receive(std::uint8_t* to, std::size_t count) const {
    return ::recv(socket_.number(), to, count, MSG_WAITALL) == ssize_t(count);
  }

  hal::DriveProfile profile_;
  hal::MotorPlate motor_{.pole_pairs = 2};
  std::uint16_t port_;
  hal::Clock& clock_;
  double response_timeout_s_;
  double patience_s_;
  Socket socket_;
  unsigned transaction_ = 0;
};

}  // namespace

std::unique_ptr<hal::Drive> make_undrained_drive(std::uint16_t port, hal::Clock& clock,
                                                 double response_timeout_s, double patience_s) {
  return std::make_unique<UndrainedDrive>(port, clock, response_timeout_s, patience_s);
}

}  // namespace rvbench::test
