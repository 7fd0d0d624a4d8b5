#include "sim/modbus_requests.hpp"

#include <fcntl.h>
#include <modbus/modbus.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>

namespace rvbench::sim {
namespace {

using namespace modbus_functions;
using namespace modbus_exceptions;

using Bytes = std::vector<std::uint8_t>;

std::uint16_t word_at(const Bytes& bytes, std::size_t at) {
  return static_cast<std::uint16_t>(bytes[at] << 8 | bytes[at + 1]);
}

bool is_read(int function) {
  return function == read_discrete_inputs || function == read_holding_registers ||
         function == read_input_registers;
}

// Takes a request apart, of which libmodbus has checked that its length fits its function.
// @param pdu  where function, address and count begin
// @return an exception code; 0 if `parsed` is a request
int parse(const Bytes& request, std::size_t pdu, ModbusRequest& parsed) {
  parsed.function = request[pdu];
  if (!is_read(parsed.function) && parsed.function != write_single_register &&
      parsed.function != write_multiple_registers) {
    return illegal_function;
  }
  parsed.address = word_at(request, pdu + 1);
  parsed.count = word_at(request, pdu + 3);
  if (is_read(parsed.function)) return 0;
  if (parsed.function == write_single_register) {
    parsed.values = {parsed.count};  // its value is in this place
    return 0;
  }
  // A serial request has a checksum of two bytes behind.
  if (parsed.count == 0 || request.size() < pdu + 6 + std::size_t{2} * parsed.count) {
    return illegal_value;
  }
  for (std::size_t i = 0; i < parsed.count; ++i) {
    parsed.values.push_back(word_at(request, pdu + 6 + 2 * i));
  }
  return 0;
}

struct FreeMapping {
  void operator()(modbus_mapping_t* mapping) const { modbus_mapping_free(mapping); }
};
using Mapping = std::unique_ptr<modbus_mapping_t, FreeMapping>;

// What libmodbus answers from: nothing but what the request named.
Mapping mapping_of(const ModbusRequest& request, const std::vector<std::uint16_t>& values) {
  const auto size = static_cast<unsigned>(values.size());
  const bool bits = request.function == read_discrete_inputs;
  const bool inputs = request.function == read_input_registers;
  const unsigned at = request.address;
  Mapping mapping(modbus_mapping_new_start_address(
      0, 0, at, bits ? size : 0, at, bits || inputs ? 0 : size, at, inputs ? size : 0));
  if (!mapping) throw std::bad_alloc();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (bits) {
      mapping->tab_input_bits[i] = values[i] != 0 ? 1 : 0;
    } else {
      (inputs ? mapping->tab_input_registers : mapping->tab_registers)[i] = values[i];
    }
  }
  return mapping;
}

bool reply(modbus_t* context, const Bytes& bytes, const ModbusRequest& request,
           const ModbusAnswer& answer) {
  if (answer.exception != 0) {
    return modbus_reply_exception(context, bytes.data(), static_cast<unsigned>(answer.exception)) >=
           0;
  }
  const Mapping mapping = mapping_of(request, answer.values);
  return modbus_reply(context, bytes.data(), static_cast<int>(bytes.size()), mapping.get()) >= 0;
}

// The reply's bytes, taken from a pair of sockets instead of the line.
Bytes bytes_of_reply(modbus_t* context, int line, const Bytes& bytes, const ModbusRequest& request,
                     const ModbusAnswer& answer) {
  std::array<int, 2> pair{};
  Bytes told(MODBUS_MAX_ADU_LENGTH);
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair.data()) != 0) return {};
  modbus_set_socket(context, pair[0]);
  const bool sent = reply(context, bytes, request, answer);
  modbus_set_socket(context, line);
  const auto count = sent ? ::read(pair[1], told.data(), told.size()) : 0;
  ::close(pair[0]);
  ::close(pair[1]);
  told.resize(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  return told;
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

ModbusRequests::ModbusRequests(ModbusDevice& device, std::uint8_t unit_id)
    : device_(device), unit_id_(unit_id) {
  if (::pipe2(wake_.data(), O_CLOEXEC) != 0) {
    throw std::runtime_error(std::string("ModbusRequests: no pipe: ") + std::strerror(errno));
  }
}

ModbusRequests::~ModbusRequests() {
  end();
  ::close(wake_[0]);
}

void ModbusRequests::end() {
  if (wake_[1] >= 0) ::close(wake_[1]);
  wake_[1] = -1;
}

bool ModbusRequests::serve(modbus_t* context, int line) {
  modbus_set_socket(context, line);
  const auto pdu = static_cast<std::size_t>(modbus_get_header_length(context));
  Bytes bytes(MODBUS_MAX_ADU_LENGTH);
  const int length = modbus_receive(context, bytes.data());
  if (length < 0) return false;
  bytes.resize(static_cast<std::size_t>(length));
  if (bytes.size() <= pdu || bytes[pdu - 1] != unit_id_) return true;
  ++count;
  const WireFault fault = faults.take();
  if (fault == WireFault::dead) return false;
  if (fault == WireFault::silent) return true;
  device_.note_request();
  ModbusRequest request;
  const int flaw = parse(bytes, pdu, request);
  const ModbusAnswer answer = flaw != 0 ? ModbusAnswer{flaw} : answer_to(request, fault);
  if (fault == WireFault::garbled) return send_nonsense(line, bytes, pdu, count);
  if (fault == WireFault::truncated) return ::write(line, bytes.data(), pdu + 1) >= 0;
  if (fault == WireFault::merged) {
    return send_merged(line, bytes_of_reply(context, line, bytes, request, answer), pdu);
  }
  if (fault == WireFault::late && !linger()) return false;
  if (fault == WireFault::late && forgets) modbus_flush(context);
  if (fault == WireFault::doubled && !reply(context, bytes, request, answer)) return false;
  return reply(context, bytes, request, answer);
}

ModbusAnswer ModbusRequests::answer_to(const ModbusRequest& request, WireFault fault) {
  if (fault == WireFault::busy) return {faults.exception_code()};
  if (!is_read(request.function)) {
    return fault == WireFault::deaf ? ModbusAnswer{0, request.values} : device_.carry_out(request);
  }
  const ModbusAnswer answer = device_.carry_out(request);
  if (answer.exception != 0) return answer;
  // What was read in good health is what a frozen device goes on to answer.
  std::vector<std::uint16_t>& last = last_read_[{request.function, request.address}];
  if (fault == WireFault::frozen && last.size() == answer.values.size()) return {0, last};
  last = answer.values;
  return answer;
}

// Waits for the lateness; false if serving is to end meanwhile.
bool ModbusRequests::linger() {
  pollfd wake{wake_[0], POLLIN, 0};
  return ::poll(&wake, 1, static_cast<int>(std::lround(1000 * lateness_s))) == 0;
}

}  // namespace rvbench::sim
