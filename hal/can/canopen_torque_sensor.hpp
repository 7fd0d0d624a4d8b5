#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "hal/can_transport.hpp"
#include "hal/clock.hpp"
#include "hal/torque_sensor.hpp"

namespace rvbench::hal {

struct CanopenTorqueOptions {
  int node = 1;                ///< 1 to 127
  double rate_Hz = 500;        ///< of the samples that read() makes
  double Nm_per_count = 1e-3;  ///< of the transducer's integer
  double deadline_s = 0.2;     ///< how old the newest sign of life may be
};

/// Torque transducer that sends its value by CANopen only when it has changed, as HBM's TIM40 does.
///
/// Frames   TPDO1 0x180 + node: int32, lowest byte first, in bytes 1 to 4; TPDO2 0x280 + node:
///          status, bit 0 zeroing, bit 2 shunt on; heartbeat 0x700 + node. Sources: CiA 301;
///          HBM TIM40 mounting instructions, p. 39
/// Samples  at rate_Hz, each the last value that came before it: a torque that stays is sent once.
///          No angle
/// Errors   timeout: neither value nor heartbeat came; bad_reply: it zeroes, its shunt is on, or
///          either was so since the last read(), or a frame has another length; disconnected: it
///          has restarted or was stopped. Samples of a failed read() count as lost in the next one
/// Time     connect() tells the node to operate and waits on the clock for its first value, until
///          the deadline; read() never waits
class CanopenTorqueSensor final : public TorqueSensor {
 public:
  /// @param transport  receives the node's frames only: see ids()
  /// @param clock      must outlive the sensor
  /// @throws std::invalid_argument if the node is out of range or an option is not positive
  CanopenTorqueSensor(std::unique_ptr<CanTransport> transport, const CanopenTorqueOptions& options,
                      Clock& clock);

  /// Identifiers that the transport must let in.
  static std::vector<std::uint32_t> ids(int node);

  double rate_Hz() const override { return options_.rate_Hz; }
  Status connect() override;
  Result<TorqueBlock> read() override;

 private:
  Status take_waiting_into(TorqueBlock& block);
  Status take(const CanFrame& frame, TorqueBlock& block);
  Status check_status();
  void hold_until(double time_s, TorqueBlock& block);

  std::unique_ptr<CanTransport> transport_;
  CanopenTorqueOptions options_;
  Clock& clock_;
  bool connected_ = false;
  double torque_Nm_ = not_known;  ///< as last sent
  unsigned status_ = 0;           ///< as last sent
  unsigned said_ = 0;             ///< every bit that was set since the last read
  double alive_s_ = 0;            ///< when the node was last heard
  double start_s_ = 0;            ///< of sample 0
  std::int64_t made_ = 0;         ///< samples since then
  int lost_ = 0;                  ///< of them, in reads that failed
};

}  // namespace rvbench::hal
