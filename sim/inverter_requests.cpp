#include "sim/inverter_requests.hpp"

#include <fcntl.h>
#include <modbus/modbus.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/inverter_table.hpp"

namespace rvbench::sim {
namespace {

constexpr int read_holding_registers = 3;
constexpr int write_single_register = 6;
constexpr int write_multiple_registers = 16;
constexpr int illegal_function = 1;

using Bytes = std::vector<std::uint8_t>;

std::uint16_t word_at(const Bytes& bytes, std::size_t at) {
  return static_cast<std::uint16_t>(bytes[at] << 8 | bytes[at + 1]);
}

struct FreeMapping {
  void operator()(modbus_mapping_t* mapping) const { modbus_mapping_free(mapping); }
};
using Mapping = std::unique_ptr<modbus_mapping_t, FreeMapping>;

// What goes back: an exception, or the registers that the request named.
struct Answer {
  int exception = 0;
  Mapping registers;
};

Answer exception(int code) { return {code, nullptr}; }

Answer registers(std::uint16_t address, const std::vector<std::uint16_t>& values) {
  Mapping mapping(modbus_mapping_new_start_address(0, 0, 0, 0, address,
                                                   static_cast<unsigned>(values.size()), 0, 0));
  if (!mapping) throw std::bad_alloc();
  std::copy(values.begin(), values.end(), mapping->tab_registers);
  return {0, std::move(mapping)};
}

// Carries out a request of which libmodbus has checked that its length fits its function.
// @param pdu  where function, address and count begin
Answer carry_out(InverterModel& model, const Bytes& request, std::size_t pdu) {
  const int function = request[pdu];
  if (function != read_holding_registers && function != write_single_register &&
      function != write_multiple_registers) {
    return exception(illegal_function);
  }
  const std::uint16_t address = word_at(request, pdu + 1);
  const std::uint16_t count = word_at(request, pdu + 3);
  if (function == read_holding_registers) {
    const auto values = read_table(model, address, count);
    return values ? registers(address, *values)
                  : exception(static_cast<int>(TableAnswer::illegal_address));
  }
  std::vector<std::uint16_t> values{count};  // function 6 has its value in this place
  if (function == write_multiple_registers) {
    // A serial request has a checksum of two bytes behind.
    if (count == 0 || request.size() < pdu + 6 + std::size_t{2} * count) {
      return exception(static_cast<int>(TableAnswer::illegal_value));
    }
    values.clear();
    for (std::size_t i = 0; i < count; ++i) values.push_back(word_at(request, pdu + 6 + 2 * i));
  }
  const TableAnswer answer = write_table(model, address, values);
  return answer == TableAnswer::done ? registers(address, values)
                                     : exception(static_cast<int>(answer));
}

// The answer to a write that was not carried out.
Answer echo(const Bytes& request, std::size_t pdu) {
  const bool is_single = request[pdu] == write_single_register;
  const std::uint16_t word = word_at(request, pdu + 3);
  return registers(word_at(request, pdu + 1),
                   is_single ? std::vector{word} : std::vector<std::uint16_t>(word));
}

bool reply(modbus_t* context, const Bytes& request, const Answer& answer) {
  const int sent = answer.registers
                       ? modbus_reply(context, request.data(), static_cast<int>(request.size()),
                                      answer.registers.get())
                       : modbus_reply_exception(context, request.data(),
                                                static_cast<unsigned>(answer.exception));
  return sent >= 0;
}

// The reply's bytes, taken from a pair of sockets instead of the line.
Bytes bytes_of_reply(modbus_t* context, int line, const Bytes& request, const Answer& answer) {
  std::array<int, 2> pair{};
  Bytes bytes(MODBUS_MAX_ADU_LENGTH);
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair.data()) != 0) return {};
  modbus_set_socket(context, pair[0]);
  const bool sent = reply(context, request, answer);
  modbus_set_socket(context, line);
  const auto count = sent ? ::read(pair[1], bytes.data(), bytes.size()) : 0;
  ::close(pair[0]);
  ::close(pair[1]);
  bytes.resize(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  return bytes;
}

// In front of the reply the same with the number of the transaction before; a serial line has no
// such numbers, and carries it twice.
bool send_merged(int line, const Bytes& bytes, std::size_t pdu) {
  if (bytes.size() < 2) return false;
  Bytes merged = bytes;
  if (pdu > 1) merged[1] = static_cast<std::uint8_t>(merged[1] - 1);
  merged.insert(merged.end(), bytes.begin(), bytes.end());
  return ::write(line, merged.data(), merged.size()) >= 0;
}

// Nonsense of two kinds in turn: a plausible reply to another request, an unknown function.
bool send_nonsense(int line, Bytes request, std::size_t pdu, int turn) {
  if (turn % 2 == 0) {
    request[1] = static_cast<std::uint8_t>(request[1] ^ 0x55);
  } else {
    request[pdu] = 0x7E;
  }
  return ::write(line, request.data(), request.size()) >= 0;
}

}  // namespace

InverterRequests::InverterRequests(InverterModel& model, std::uint8_t unit_id)
    : model_(model), unit_id_(unit_id) {
  if (::pipe2(wake_.data(), O_CLOEXEC) != 0) {
    throw std::runtime_error(std::string("InverterRequests: no pipe: ") + std::strerror(errno));
  }
}

InverterRequests::~InverterRequests() {
  end();
  ::close(wake_[0]);
}

void InverterRequests::end() {
  if (wake_[1] >= 0) ::close(wake_[1]);
  wake_[1] = -1;
}

bool InverterRequests::serve(modbus_t* context, int line) {
  modbus_set_socket(context, line);
  const auto pdu = static_cast<std::size_t>(modbus_get_header_length(context));
  Bytes request(MODBUS_MAX_ADU_LENGTH);
  const int length = modbus_receive(context, request.data());
  if (length < 0) return false;
  request.resize(static_cast<std::size_t>(length));
  if (request.size() <= pdu || request[pdu - 1] != unit_id_) return true;
  ++count;
  const WireFault fault = faults.take();
  if (fault == WireFault::dead) return false;
  if (fault == WireFault::silent) return true;
  model_.note_request();
  if (fault == WireFault::busy) return reply(context, request, exception(faults.exception_code()));
  const Answer answer = fault == WireFault::deaf && request[pdu] != read_holding_registers
                            ? echo(request, pdu)
                            : carry_out(model_, request, pdu);
  if (answer.registers && request[pdu] == read_holding_registers) {
    keep_or_freeze(*answer.registers, fault == WireFault::frozen);
  }
  if (fault == WireFault::garbled) return send_nonsense(line, request, pdu, count);
  if (fault == WireFault::truncated) return ::write(line, request.data(), pdu + 1) >= 0;
  if (fault == WireFault::merged) {
    return send_merged(line, bytes_of_reply(context, line, request, answer), pdu);
  }
  if (fault == WireFault::late && !linger()) return false;
  if (fault == WireFault::doubled && !reply(context, request, answer)) return false;
  return reply(context, request, answer);
}

// What was read in good health is what a frozen device goes on to answer.
void InverterRequests::keep_or_freeze(_modbus_mapping_t& mapping, bool is_frozen) {
  const std::span<std::uint16_t> words(mapping.tab_registers,
                                       static_cast<std::size_t>(mapping.nb_registers));
  std::vector<std::uint16_t>& last =
      last_read_[static_cast<std::uint16_t>(mapping.start_registers)];
  if (is_frozen && last.size() == words.size()) {
    std::ranges::copy(last, words.begin());
  } else {
    last.assign(words.begin(), words.end());
  }
}

// Waits for the lateness; false if serving is to end meanwhile.
bool InverterRequests::linger() {
  pollfd wake{wake_[0], POLLIN, 0};
  return ::poll(&wake, 1, static_cast<int>(std::lround(1000 * lateness_s))) == 0;
}

}  // namespace rvbench::sim
