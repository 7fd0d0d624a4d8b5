#include "sim/inverter_server.hpp"

#include <fcntl.h>
#include <modbus/modbus.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "sim/inverter_table.hpp"

namespace rvbench::sim {
namespace {

constexpr int read_holding_registers = 3;
constexpr int write_single_register = 6;
constexpr int write_multiple_registers = 16;
constexpr std::size_t header_bytes = 7;  // MBAP: transaction, protocol, length, unit
constexpr int busy_exception = 6;
constexpr int illegal_function = 1;

using Bytes = std::vector<std::uint8_t>;

std::uint16_t word_at(const Bytes& bytes, std::size_t at) {
  return static_cast<std::uint16_t>(bytes[at] << 8 | bytes[at + 1]);
}

struct FreeModbus {
  void operator()(modbus_t* context) const { modbus_free(context); }
};
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

// Carries out a request; libmodbus has checked that its length fits its function.
Answer carry_out(InverterModel& model, const Bytes& request) {
  const int function = request[header_bytes];
  if (function != read_holding_registers && function != write_single_register &&
      function != write_multiple_registers) {
    return exception(illegal_function);
  }
  const std::uint16_t address = word_at(request, header_bytes + 1);
  const std::uint16_t count = word_at(request, header_bytes + 3);
  if (function == read_holding_registers) {
    const auto values = read_table(model, address, count);
    return values ? registers(address, *values)
                  : exception(static_cast<int>(TableAnswer::illegal_address));
  }
  std::vector<std::uint16_t> values{count};  // function 6 has its value in this place
  if (function == write_multiple_registers) {
    if (count == 0 || request.size() != header_bytes + 6 + std::size_t{2} * count) {
      return exception(static_cast<int>(TableAnswer::illegal_value));
    }
    values.clear();
    for (std::size_t i = 0; i < count; ++i) {
      values.push_back(word_at(request, header_bytes + 6 + 2 * i));
    }
  }
  const TableAnswer answer = write_table(model, address, values);
  return answer == TableAnswer::done ? registers(address, values)
                                     : exception(static_cast<int>(answer));
}

// Nonsense of two kinds in turn: a plausible reply to another transaction, an unknown function.
Bytes nonsense(Bytes request, int turn) {
  if (turn % 2 == 0) {
    request[1] = static_cast<std::uint8_t>(request[1] ^ 0x55);
  } else {
    request[header_bytes] = 0x7E;
  }
  return request;
}

}  // namespace

// The serving thread and its sockets.
class InverterServer::Service {
 public:
  Service(InverterModel& model, std::uint8_t unit_id)
      : model_(model), unit_id_(unit_id), context_(modbus_new_tcp("127.0.0.1", 0)) {
    listener_ = context_ ? modbus_tcp_listen(context_.get(), 4) : -1;
    if (listener_ < 0 || ::pipe2(wake_.data(), O_CLOEXEC) != 0) {
      const std::string reason = std::strerror(errno);
      if (listener_ >= 0) ::close(listener_);
      throw std::runtime_error("InverterServer: cannot listen on 127.0.0.1: " + reason);
    }
    modbus_set_byte_timeout(context_.get(), 0, 100'000);
    thread_ = std::thread([this] { serve(); });
  }

  ~Service() {
    ::close(wake_[1]);  // the reading end becomes ready: serve() returns
    thread_.join();
    for (const int client : clients_) ::close(client);
    ::close(listener_);
    ::close(wake_[0]);
  }

  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;

  std::uint16_t port() const {
    sockaddr_in address{};
    socklen_t size = sizeof address;
    if (::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size) != 0) return 0;
    return ntohs(address.sin_port);
  }

  WireFaultSwitch faults;
  std::atomic<double> lateness_s = 0.4;
  std::atomic<int> requests = 0;

 private:
  void serve() {
    for (;;) {
      std::vector<pollfd> watched{{wake_[0], POLLIN, 0}, {listener_, POLLIN, 0}};
      for (const int client : clients_) watched.push_back({client, POLLIN, 0});
      if (::poll(watched.data(), watched.size(), -1) < 0 && errno != EINTR) return;
      if (watched[0].revents != 0) return;
      // Older connections first: a request left behind on one must not overtake a newer stop.
      for (std::size_t i = 2; i < watched.size(); ++i) {
        if (watched[i].revents != 0 && !serve_client(watched[i].fd)) hang_up(watched[i].fd);
      }
      if (watched[1].revents != 0) accept_client();
    }
  }

  void accept_client() {
    const int client = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
    if (client < 0) return;
    if (faults.is_dead()) {
      ::close(client);
    } else {
      clients_.push_back(client);
    }
  }

  void hang_up(int client) {
    ::close(client);
    std::erase(clients_, client);
  }

  // Serves one request; false if the connection is to be closed.
  bool serve_client(int client) {
    modbus_set_socket(context_.get(), client);
    Bytes request(MODBUS_TCP_MAX_ADU_LENGTH);
    const int length = modbus_receive(context_.get(), request.data());
    if (length < 0) return false;
    request.resize(static_cast<std::size_t>(length));
    if (request.size() <= header_bytes || request[header_bytes - 1] != unit_id_) return true;
    ++requests;
    const WireFault fault = faults.take();
    if (fault == WireFault::dead) return false;
    if (fault == WireFault::silent) return true;
    model_.note_request();
    if (fault == WireFault::busy) return reply(request, exception(busy_exception));
    const Answer answer = carry_out(model_, request);
    if (fault == WireFault::garbled) return send_nonsense(client, request);
    if (fault == WireFault::late && !linger()) return false;
    return reply(request, answer);
  }

  bool reply(const Bytes& request, const Answer& answer) {
    const int sent = answer.registers
                         ? modbus_reply(context_.get(), request.data(),
                                        static_cast<int>(request.size()), answer.registers.get())
                         : modbus_reply_exception(context_.get(), request.data(),
                                                  static_cast<unsigned>(answer.exception));
    return sent >= 0;
  }

  bool send_nonsense(int client, const Bytes& request) {
    const Bytes bytes = nonsense(request, requests);
    return ::send(client, bytes.data(), bytes.size(), MSG_NOSIGNAL) >= 0;
  }

  // Waits for the lateness; false if the server is being closed meanwhile.
  bool linger() {
    pollfd wake{wake_[0], POLLIN, 0};
    return ::poll(&wake, 1, static_cast<int>(std::lround(1000 * lateness_s))) == 0;
  }

  InverterModel& model_;
  std::uint8_t unit_id_;
  std::unique_ptr<modbus_t, FreeModbus> context_;
  int listener_ = -1;
  std::array<int, 2> wake_{-1, -1};
  std::vector<int> clients_;
  std::thread thread_;
};

InverterServer::InverterServer(InverterModel& model, std::uint8_t unit_id)
    : service_(std::make_unique<Service>(model, unit_id)) {}

InverterServer::~InverterServer() = default;

std::uint16_t InverterServer::port() const { return service_->port(); }

void InverterServer::inject(const WireFaultPlan& plan) { service_->faults.inject(plan); }

void InverterServer::set_lateness_s(double lateness_s) { service_->lateness_s = lateness_s; }

int InverterServer::requests() const { return service_->requests; }

}  // namespace rvbench::sim
