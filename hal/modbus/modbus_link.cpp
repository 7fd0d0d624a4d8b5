#include "hal/modbus/modbus_link.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <modbus/modbus.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <new>
#include <string_view>
#include <thread>
#include <utility>

#include "hal/types/require.hpp"

namespace rvbench::hal {
namespace {

using RealClock = std::chrono::steady_clock;

bool is_exception_reply(int error) { return error >= EMBXILFUN && error <= EMBXGTAR; }

IoErrc code_from_errno(int error) {
  if (is_exception_reply(error)) return IoErrc::refused;
  switch (error) {
    case ETIMEDOUT:
    case EINPROGRESS: return IoErrc::timeout;
    case EMBBADCRC:
    case EMBBADDATA:
    case EMBBADEXC:
    case EMBUNKEXC:
    case EMBMDATA:
    case EMBBADSLAVE: return IoErrc::bad_reply;
    default: return IoErrc::disconnected;
  }
}

void check(const ModbusTcp& tcp) {
  constexpr Require require{"ModbusLink"};
  in_addr address{};
  require(::inet_pton(AF_INET, tcp.host.c_str(), &address) == 1,
          "host \"" + tcp.host + "\" is not an IPv4 address");
  require(tcp.port != 0, "port is 0, must be 1 to 65535");
}

void check(const ModbusRtu& rtu) {
  constexpr Require require{"ModbusLink"};
  require(!rtu.device.empty(), "no serial device");
  require(rtu.baud >= 1200 && rtu.baud <= 115200,
          fmt::format("baud is {}, must be 1200 to 115200", rtu.baud));
  require(std::string_view("NEO").find(rtu.parity) != std::string_view::npos,
          fmt::format("parity is {}, must be N, E or O", rtu.parity));
  require(rtu.stop_bits == 1 || rtu.stop_bits == 2,
          fmt::format("stop_bits is {}, must be 1 or 2", rtu.stop_bits));
}

std::string shown(const ModbusTcp& tcp) { return fmt::format("{}:{}", tcp.host, tcp.port); }
std::string shown(const ModbusRtu& rtu) { return rtu.device; }

RealClock::duration duration_of(double duration_s) {
  return std::chrono::duration_cast<RealClock::duration>(std::chrono::duration<double>(duration_s));
}

modbus_t* new_context(const ModbusTcp& tcp) { return modbus_new_tcp(tcp.host.c_str(), tcp.port); }

modbus_t* new_context(const ModbusRtu& rtu) {
  return modbus_new_rtu(rtu.device.c_str(), rtu.baud, rtu.parity, 8, rtu.stop_bits);
}

}  // namespace

struct ModbusLink::Connection {
  explicit Connection(const ModbusPath& path)
      : context(std::visit([](const auto& kind) { return new_context(kind); }, path)) {
    if (context == nullptr) throw std::bad_alloc();
  }
  ~Connection() {
    modbus_close(context);
    modbus_free(context);
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  modbus_t* context;
};

ModbusLink::ModbusLink(ModbusLinkOptions options) : options_(std::move(options)) {
  constexpr Require require{"ModbusLink"};
  std::visit([](const auto& kind) { check(kind); }, options_.path);
  require(options_.timeout_s >= 0.001 && options_.timeout_s <= 10,
          fmt::format("timeout_s is {}, must be 0.001 to 10", options_.timeout_s));
  require(options_.turnaround_s >= 0 && options_.turnaround_s <= 1,
          fmt::format("turnaround_s is {}, must be 0 to 1", options_.turnaround_s));
}

ModbusLink::~ModbusLink() = default;

Status ModbusLink::open() {
  connection_ = std::make_unique<Connection>(options_.path);
  modbus_t* const context = connection_->context;
  modbus_set_slave(context, options_.unit_id);
  const auto timeout_us = static_cast<std::uint32_t>(std::lround(1e6 * options_.timeout_s));
  modbus_set_response_timeout(context, timeout_us / 1'000'000, timeout_us % 1'000'000);
  modbus_set_byte_timeout(context, 0, 0);  // the response time-out bounds the whole reply
  if (modbus_connect(context) == 0) {
    is_in_doubt_ = may_be_late_ && std::holds_alternative<ModbusRtu>(options_.path);
    if (is_in_doubt_) drop_late_bytes();
    may_be_late_ = false;
    return Done{};
  }
  const int error = errno;
  const IoErrc code = code_from_errno(error);
  if (code == IoErrc::timeout) ++timeouts_;
  connection_.reset();
  return failure(code, fmt::format("connect: {}", modbus_strerror(error)));
}

void ModbusLink::close() {
  if (is_open()) may_be_late_ = true;
  connection_.reset();
}

Status ModbusLink::confirm_in_step() {
  if (!std::exchange(is_in_doubt_, false) || !is_open()) return Done{};
  if (!drop_bytes(RealClock::now() + duration_of(options_.timeout_s))) return Done{};
  close();
  return failure(IoErrc::bad_reply, "more answers than questions: an older one came late");
}

// A line that never falls silent is left after three time-outs, and what it tells is refused by
// whoever identifies the device.
void ModbusLink::drop_late_bytes() {
  const auto timeout = duration_of(options_.timeout_s);
  const auto give_up = RealClock::now() + 3 * timeout;
  while (drop_bytes(std::min(RealClock::now() + 2 * timeout, give_up))) continue;
}

// Waits for bytes, and drops them. @return false if none came before the end
bool ModbusLink::drop_bytes(RealClock::time_point end) {
  pollfd line{modbus_get_socket(connection_->context), POLLIN, 0};
  std::array<char, 256> late{};
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - RealClock::now());
    if (left.count() <= 0) return false;
    const int ready = ::poll(&line, 1, static_cast<int>(left.count()));
    if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
    const auto count = ready < 0 ? -1 : ::read(line.fd, late.data(), late.size());
    if (count > 0) {
      dropped_bytes_ += static_cast<int>(count);
      return true;
    }
    const bool is_lost = count == 0 || (errno != EINTR && errno != EAGAIN);
    if (is_lost) return false;  // the next request will say why
  }
}

void ModbusLink::keep_turnaround() const {
  if (options_.turnaround_s == 0) return;
  std::this_thread::sleep_until(quiet_since_ + duration_of(options_.turnaround_s));
}

void ModbusLink::require_writable(std::uint16_t address, std::size_t count) const {
  constexpr Require require{"ModbusLink"};
  for (std::size_t i = 0; i < count; ++i) {
    require(std::ranges::find(options_.writable, address + i) != options_.writable.end(),
            fmt::format("register 0x{:04X} is not to be written", address + i));
  }
}

Status ModbusLink::read(const char* operation, std::uint16_t address,
                        std::span<std::uint16_t> words) {
  if (!is_open()) return failure(IoErrc::disconnected, operation);
  keep_turnaround();
  const int done = modbus_read_registers(connection_->context, address,
                                         static_cast<int>(words.size()), words.data());
  return settle(done, words.size(), operation, address);
}

Status ModbusLink::read_inputs(const char* operation, std::uint16_t address,
                               std::span<std::uint16_t> words) {
  if (!is_open()) return failure(IoErrc::disconnected, operation);
  keep_turnaround();
  const int done = modbus_read_input_registers(connection_->context, address,
                                               static_cast<int>(words.size()), words.data());
  return settle(done, words.size(), operation, address);
}

Status ModbusLink::read_bits(const char* operation, std::uint16_t address,
                             std::span<std::uint8_t> bits) {
  if (!is_open()) return failure(IoErrc::disconnected, operation);
  keep_turnaround();
  const int done = modbus_read_input_bits(connection_->context, address,
                                          static_cast<int>(bits.size()), bits.data());
  return settle(done, bits.size(), operation, address);
}

Status ModbusLink::write(const char* operation, std::uint16_t address,
                         std::span<const std::uint16_t> words) {
  require_writable(address, words.size());
  if (!is_open()) return failure(IoErrc::disconnected, operation);
  keep_turnaround();
  const int done = modbus_write_registers(connection_->context, address,
                                          static_cast<int>(words.size()), words.data());
  return settle(done, words.size(), operation, address);
}

Status ModbusLink::write_one(const char* operation, std::uint16_t address, std::uint16_t word) {
  require_writable(address, 1);
  if (!is_open()) return failure(IoErrc::disconnected, operation);
  keep_turnaround();
  const int done = modbus_write_register(connection_->context, address, word);
  return settle(done, 1, operation, address);
}

Status ModbusLink::settle(int words_done, std::size_t words_asked, const char* operation,
                          std::uint16_t address) {
  const int error = words_done < 0 ? errno : EMBBADDATA;
  quiet_since_ = std::chrono::steady_clock::now();
  if (words_done == static_cast<int>(words_asked)) return Done{};
  const IoErrc code = code_from_errno(error);
  if (code == IoErrc::timeout) ++timeouts_;
  if (!is_exception_reply(error)) close();
  return failure(code, fmt::format("{} (0x{:04X}..0x{:04X}): {}", operation, address,
                                   address + words_asked - 1, modbus_strerror(error)));
}

IoError ModbusLink::failure(IoErrc code, const std::string& operation) const {
  const std::string at = std::visit([](const auto& kind) { return shown(kind); }, options_.path);
  return {code, fmt::format("{} {}: {}", options_.device, at, operation)};
}

}  // namespace rvbench::hal
