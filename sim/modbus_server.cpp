#include "sim/modbus_server.hpp"

#include <modbus/modbus.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <new>
#include <thread>
#include <vector>

#include "sim/free_modbus.hpp"
#include "sim/loopback_listener.hpp"
#include "sim/modbus_requests.hpp"

namespace rvbench::sim {

// The serving thread and its sockets.
class ModbusServer::Service {
 public:
  Service(ModbusDevice& device, std::uint8_t unit_id, std::uint16_t port)
      : requests(device, unit_id),
        listener_(port),
        context_(modbus_new_tcp("127.0.0.1", listener_.port())) {
    if (!context_) throw std::bad_alloc();
    modbus_set_byte_timeout(context_.get(), 0, 100'000);
    thread_ = std::thread([this] { serve(); });
  }

  ~Service() {
    requests.end();
    thread_.join();
    for (const int client : clients_) ::close(client);
  }

  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;

  std::uint16_t port() const { return listener_.port(); }

  ModbusRequests requests;

 private:
  void serve() {
    for (;;) {
      std::vector<pollfd> watched{{requests.ending(), POLLIN, 0}, {listener_.watched(), POLLIN, 0}};
      for (const int client : clients_) watched.push_back({client, POLLIN, 0});
      if (::poll(watched.data(), watched.size(), listener_.patience_ms()) < 0 && errno != EINTR) {
        return;
      }
      if (watched[0].revents != 0) return;
      // Older connections first: a request left behind on one must not overtake a newer stop.
      for (std::size_t i = 2; i < watched.size(); ++i) {
        if (watched[i].revents != 0 && !requests.serve(context_.get(), watched[i].fd)) {
          hang_up(watched[i].fd);
        }
      }
      if (watched[1].revents != 0) accept_client();
    }
  }

  void accept_client() {
    const int client = listener_.accept();
    if (client < 0) return;
    if (requests.faults.is_dead()) {
      ::close(client);
    } else {
      clients_.push_back(client);
    }
  }

  void hang_up(int client) {
    ::close(client);
    std::erase(clients_, client);
  }

  LoopbackListener listener_;
  std::unique_ptr<modbus_t, FreeModbus> context_;
  std::vector<int> clients_;
  std::thread thread_;
};

ModbusServer::ModbusServer(ModbusDevice& device, std::uint8_t unit_id, std::uint16_t port)
    : service_(std::make_unique<Service>(device, unit_id, port)) {}

ModbusServer::~ModbusServer() = default;

std::uint16_t ModbusServer::port() const { return service_->port(); }

void ModbusServer::inject(const WireFaultPlan& plan) { service_->requests.faults.inject(plan); }

void ModbusServer::set_lateness_s(double lateness_s) { service_->requests.lateness_s = lateness_s; }

int ModbusServer::requests() const { return service_->requests.count; }

int ModbusServer::misbehaved() const { return service_->requests.faults.met(); }

}  // namespace rvbench::sim
