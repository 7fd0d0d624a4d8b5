#include "tests/faults/witnessed_bus.hpp"

#include <cmath>

namespace rvbench::test {
namespace {

constexpr std::uint32_t torque_id = 0x181;
constexpr std::uint32_t brake_command_id = 0x201;
constexpr double torque_rate_Hz = 500;

IoError bus_off(const char* operation) {
  return {IoErrc::disconnected, std::string("CAN: ") + operation + ": the controller went bus-off"};
}

std::int32_t torque_uNm(const hal::CanFrame& frame) {
  std::uint32_t bits = 0;
  for (int i = 3; i >= 0; --i) bits = bits << 8U | frame.data[std::size_t(i)];
  return std::int32_t(bits);
}

}  // namespace

// The counter tells the number of the sample but for multiples of 256: those the time tells.
Status WitnessedBus::send(const hal::CanFrame& frame) {
  if (frame.id == torque_id && frame.length == 8) {
    const int counter = frame.data[6];
    const auto rounds = std::llround((now_s_() * torque_rate_Hz - counter) / 256);
    const auto number = std::size_t(256 * rounds + counter);
    if (number >= torques_.size()) {
      torques_.resize(number + 1);
      torques_[number] = {float(1e-6 * torque_uNm(frame)), frame.data[4] + 256 * frame.data[5]};
    }
  }
  return bus_.send(frame);
}

Result<hal::CanFrame> WitnessedBus::receive() {
  auto frame = bus_.receive();
  if (frame && frame.value().id == brake_command_id && frame.value().data[2] == 0) {
    saw_release_ = true;
  }
  return frame;
}

Status FragileBus::open() {
  is_off_ = false;
  return bus_->open();
}

Status FragileBus::send(const hal::CanFrame& frame) {
  if (is_off_) return bus_off("send");
  return bus_->send(frame);
}

Result<hal::CanFrame> FragileBus::receive() {
  if (is_off_) return bus_off("receive");
  return bus_->receive();
}

}  // namespace rvbench::test
