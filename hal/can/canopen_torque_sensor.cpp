#include "hal/can/canopen_torque_sensor.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "hal/can/torque_transducer.hpp"
#include "hal/can/waiting_frames.hpp"
#include "hal/types/require_positive.hpp"

namespace rvbench::hal {
namespace {

constexpr std::uint32_t network_management = 0x000;
constexpr std::uint32_t first_tpdo = 0x180;
constexpr std::uint32_t second_tpdo = 0x280;
constexpr std::uint32_t heartbeat = 0x700;
constexpr std::uint8_t start_node = 0x01;
constexpr unsigned operational = 0x05;
constexpr unsigned booted = 0x00;
constexpr unsigned zeroing = 0x01;
constexpr unsigned shunt_on = 0x04;

using torque_transducer::transducer_failure;

}  // namespace

CanopenTorqueSensor::CanopenTorqueSensor(std::unique_ptr<CanTransport> transport,
                                         const CanopenTorqueOptions& options, Clock& clock)
    : transport_(std::move(transport)), options_(options), clock_(clock) {
  if (!transport_) throw std::invalid_argument("CanopenTorqueSensor: transport is null");
  if (options.node < 1 || options.node > 127) {
    throw std::invalid_argument("CanopenTorqueSensor: node is " + std::to_string(options.node) +
                                ", must be 1 to 127");
  }
  require_positive(options.rate_Hz, "CanopenTorqueSensor", "rate_Hz");
  require_positive(options.Nm_per_count, "CanopenTorqueSensor", "Nm_per_count");
  require_positive(options.deadline_s, "CanopenTorqueSensor", "deadline_s");
}

std::vector<std::uint32_t> CanopenTorqueSensor::ids(int node) {
  const auto id = static_cast<std::uint32_t>(node);
  return {first_tpdo + id, second_tpdo + id, heartbeat + id};
}

Status CanopenTorqueSensor::connect() {
  connected_ = false;
  const Status opened = transport_->open();
  if (!opened) return opened;
  drop_waiting_frames(*transport_);  // of an earlier time
  const Status started =
      transport_->send({.id = network_management,
                        .length = 2,
                        .data = {start_node, static_cast<std::uint8_t>(options_.node)}});
  if (!started) return started;
  torque_Nm_ = not_known;
  status_ = said_ = 0;
  const double end_s = clock_.now_s() + options_.deadline_s;
  for (;;) {
    TorqueBlock none;
    made_ = 0;
    start_s_ = clock_.now_s();
    const Status taken = take_waiting_into(none);
    if (!taken) return taken;
    const Status sound = check_status();
    if (!sound) return sound;
    if (!std::isnan(torque_Nm_)) break;
    if (clock_.now_s() >= end_s) {
      return transducer_failure(IoErrc::timeout, "connect: no value after it was told to operate");
    }
    clock_.wait_until(clock_.now_s() + 1 / options_.rate_Hz);
  }
  start_s_ = clock_.now_s();
  made_ = 0;
  lost_ = 0;
  connected_ = true;
  return Done{};
}

Result<TorqueBlock> CanopenTorqueSensor::read() {
  if (!connected_) return transducer_failure(IoErrc::disconnected, "read");
  TorqueBlock block;
  block.lost = lost_;
  block.t0_s = start_s_ + static_cast<double>(made_ - lost_) / options_.rate_Hz;
  block.samples.resize(static_cast<std::size_t>(lost_));  // of not_known
  const double now_s = clock_.now_s();
  Status taken = take_waiting_into(block);
  if (taken) taken = check_status();
  if (taken && now_s - alive_s_ > options_.deadline_s) {
    taken = transducer_failure(IoErrc::timeout, "read: neither value nor heartbeat");
  }
  hold_until(now_s, block);
  lost_ = taken ? 0 : static_cast<int>(block.samples.size());
  if (!taken) return taken.error();
  return block;
}

Status CanopenTorqueSensor::take_waiting_into(TorqueBlock& block) {
  return take_waiting_frames(*transport_,
                             [&](const CanFrame& frame) { return take(frame, block); });
}

Status CanopenTorqueSensor::take(const CanFrame& frame, TorqueBlock& block) {
  const std::uint32_t kind = frame.id - static_cast<std::uint32_t>(options_.node);
  alive_s_ = frame.time_s;
  if (kind == first_tpdo) {
    if (frame.length < 4)
      return transducer_failure(IoErrc::bad_reply, "a value of less than 4 bytes");
    hold_until(frame.time_s, block);
    std::uint32_t counts = 0;
    for (std::size_t i = 4; i-- > 0;) counts = counts << 8U | frame.data[i];
    torque_Nm_ = options_.Nm_per_count * static_cast<std::int32_t>(counts);
    return Done{};
  }
  const unsigned byte = frame.length > 0 ? frame.data[0] : 0xFFU;
  if (kind == second_tpdo) {
    if (frame.length < 1) return transducer_failure(IoErrc::bad_reply, "a status of 0 bytes");
    status_ = byte;
    said_ |= byte;
  }
  const bool lives_on = kind != heartbeat || byte == operational || !connected_;
  if (lives_on) return Done{};
  connected_ = false;  // what it sends from now on may be scaled or zeroed anew
  return transducer_failure(IoErrc::disconnected,
                            byte == booted ? "it has restarted" : "it was stopped");
}

// It says once that a flaw begins, and once that it is over. One that came and went between two
// reads has spoilt samples as well.
Status CanopenTorqueSensor::check_status() {
  const unsigned said = std::exchange(said_, status_);
  if ((said & shunt_on) != 0)
    return transducer_failure(IoErrc::bad_reply, torque_transducer::shunt_on);
  if ((said & zeroing) != 0)
    return transducer_failure(IoErrc::bad_reply, torque_transducer::zeroing);
  return Done{};
}

// Samples before that time: a value that was not sent anew has not changed.
void CanopenTorqueSensor::hold_until(double time_s, TorqueBlock& block) {
  const auto due = static_cast<std::int64_t>(std::floor((time_s - start_s_) * options_.rate_Hz));
  for (; made_ < due; ++made_) block.samples.push_back({.torque_Nm = torque_Nm_});
}

}  // namespace rvbench::hal
