#include "sim/modbus_line.hpp"

#include <modbus/modbus.h>
#include <poll.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <thread>

#include "sim/free_modbus.hpp"
#include "sim/modbus_requests.hpp"
#include "sim/pseudo_terminal.hpp"

namespace rvbench::sim {

class ModbusLine::Service {
 public:
  Service(ModbusDevice& device, std::uint8_t unit_id)
      : requests_(device, unit_id),
        context_(modbus_new_rtu(terminal_.device().c_str(), 115200, 'N', 8, 1)) {
    if (!context_ || modbus_set_slave(context_.get(), unit_id) != 0) {
      throw std::runtime_error(std::string("ModbusLine: ") + std::strerror(errno));
    }
    modbus_set_byte_timeout(context_.get(), 0, 100'000);
    thread_ = std::thread([this] { serve(); });
  }

  ~Service() {
    requests_.end();
    thread_.join();
  }

  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;

  const std::string& device() const { return terminal_.device(); }

  ModbusRequests& requests() { return requests_; }

 private:
  void serve() {
    for (;;) {
      std::array<pollfd, 2> watched{
          {{requests_.ending(), POLLIN, 0}, {terminal_.master(), POLLIN, 0}}};
      if (::poll(watched.data(), watched.size(), -1) < 0 && errno != EINTR) return;
      if (watched[0].revents != 0) return;
      if (watched[1].revents == 0) continue;
      // What is no request: silence ends it, as on any serial line.
      if (!requests_.serve(context_.get(), terminal_.master())) modbus_flush(context_.get());
    }
  }

  ModbusRequests requests_;
  PseudoTerminal terminal_;
  std::unique_ptr<modbus_t, FreeModbus> context_;
  std::thread thread_;
};

ModbusLine::ModbusLine(ModbusDevice& device, std::uint8_t unit_id)
    : service_(std::make_unique<Service>(device, unit_id)) {}

ModbusLine::~ModbusLine() = default;

const std::string& ModbusLine::device() const { return service_->device(); }

void ModbusLine::inject(const WireFaultPlan& plan) { service_->requests().faults.inject(plan); }

void ModbusLine::set_lateness_s(double lateness_s) { service_->requests().lateness_s = lateness_s; }

void ModbusLine::set_forgets(bool forgets) { service_->requests().forgets = forgets; }

int ModbusLine::requests() const { return service_->requests().count; }

int ModbusLine::misbehaved() const { return service_->requests().faults.met(); }

}  // namespace rvbench::sim
