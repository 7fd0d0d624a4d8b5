#include "hal/modbus/modbus_link.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <modbus/modbus.h>

#include <cerrno>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace rvbench::hal {
namespace {

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

}  // namespace

struct ModbusLink::Connection {
  Connection(const std::string& host, int port) : context(modbus_new_tcp(host.c_str(), port)) {
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

ModbusLink::ModbusLink(std::string host, std::uint16_t port, std::uint8_t unit_id, double timeout_s)
    : host_(std::move(host)), port_(port), unit_id_(unit_id), timeout_s_(timeout_s) {
  in_addr address{};
  if (::inet_pton(AF_INET, host_.c_str(), &address) != 1) {
    throw std::invalid_argument("ModbusLink: host \"" + host_ + "\" is not an IPv4 address");
  }
  if (port_ == 0) throw std::invalid_argument("ModbusLink: port is 0, must be 1 to 65535");
  if (!(timeout_s_ >= 0.001 && timeout_s_ <= 10)) {
    throw std::invalid_argument(
        fmt::format("ModbusLink: timeout_s is {}, must be 0.001 to 10", timeout_s_));
  }
}

ModbusLink::~ModbusLink() = default;

Status ModbusLink::open() {
  connection_ = std::make_unique<Connection>(host_, port_);
  modbus_t* const context = connection_->context;
  modbus_set_slave(context, unit_id_);
  const auto timeout_us = static_cast<std::uint32_t>(std::lround(1e6 * timeout_s_));
  modbus_set_response_timeout(context, timeout_us / 1'000'000, timeout_us % 1'000'000);
  modbus_set_byte_timeout(context, 0, 0);  // the response time-out bounds the whole reply
  if (modbus_connect(context) == 0) return Done{};
  const IoErrc code = code_from_errno(errno);
  if (code == IoErrc::timeout) ++timeouts_;
  close();
  return failure(code, "connect");
}

void ModbusLink::close() { connection_.reset(); }

Status ModbusLink::read(const char* operation, std::uint16_t address,
                        std::span<std::uint16_t> words) {
  if (!is_open()) return failure(IoErrc::disconnected, operation);
  const int done = modbus_read_registers(connection_->context, address,
                                         static_cast<int>(words.size()), words.data());
  return settle(done, words.size(), operation, address);
}

Status ModbusLink::write(const char* operation, std::uint16_t address,
                         std::span<const std::uint16_t> words) {
  if (!is_open()) return failure(IoErrc::disconnected, operation);
  const int done = modbus_write_registers(connection_->context, address,
                                          static_cast<int>(words.size()), words.data());
  return settle(done, words.size(), operation, address);
}

Status ModbusLink::settle(int words_done, std::size_t words_asked, const char* operation,
                          std::uint16_t address) {
  if (words_done == static_cast<int>(words_asked)) return Done{};
  const int error = words_done < 0 ? errno : EMBBADDATA;
  const IoErrc code = code_from_errno(error);
  if (code == IoErrc::timeout) ++timeouts_;
  if (!is_exception_reply(error)) close();
  return failure(code, fmt::format("{} (0x{:04X}..0x{:04X}): {}", operation, address,
                                   address + words_asked - 1, modbus_strerror(error)));
}

IoError ModbusLink::failure(IoErrc code, const std::string& operation) const {
  return {code, fmt::format("inverter {}:{}: {}", host_, port_, operation)};
}

}  // namespace rvbench::hal
