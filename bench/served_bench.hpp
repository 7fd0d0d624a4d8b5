#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "bench/bench_rig.hpp"
#include "bench/rig_file.hpp"
#include "hal/can_transport.hpp"
#include "hal/steady_clock.hpp"
#include "sim/bench_world.hpp"
#include "sim/can_bridge.hpp"
#include "sim/iio_server.hpp"
#include "sim/inverter_line.hpp"
#include "sim/remote_io_server.hpp"
#include "sim/slcan_adapter.hpp"

namespace rvbench::bench {

struct ServedOptions {
  std::uint16_t coupler_port = 0;  ///< 0: the kernel chooses one, here and below
  std::uint16_t daq_port = 0;
  std::string can_interface = {};  ///< "vcan0"; "" = a serial adapter
  bool drive_on_line = false;      ///< the rig file has the drive's serial line, not its port
};

/// The devices of a simulated bench, each on its real protocol, in real time: for a client that
/// cannot tell them from a bench of hardware.
///
/// Time     the world follows the steady clock in steps of 1 ms. One that is held up catches up;
///          what is more than a second is lost, and told
/// Threads  the world has one of its own, so have the devices; all calls may overlap
class ServedBench {
 public:
  using Tell = std::function<void(const std::string&)>;

  /// @param tell  what somebody should know, from a thread of its own
  /// @throws std::runtime_error naming the device that cannot be served
  ServedBench(const SimRig& sim, std::unique_ptr<sim::BenchWorld> world,
              const ServedOptions& options, Tell tell);
  ~ServedBench();

  ServedBench(const ServedBench&) = delete;
  ServedBench& operator=(const ServedBench&) = delete;

  /// A bench whose devices these are.
  BenchRig rig() const;

  /// Device and address of each, one a line.
  std::string addresses() const;

  /// Does what somebody typed: "estop", "inverter silent".
  /// @return what was done, or what is not understood
  std::string obey(const std::string& line);

  /// "shaft 1815 rpm, load 83.5 N·m, brake engaged", and what is wrong with the safety chain.
  std::string status();

  static std::string commands();  ///< lines for --help

 private:
  void add_mischief();
  void inject_inverter(sim::WireFault fault);
  void heal();
  void run(const std::stop_token& stop);
  double catch_up(double time_s);
  void tell_lateness(double late_s);
  void hand_over();

  const SimRig sim_;
  const ServedOptions options_;
  Tell tell_;
  std::map<std::string, std::function<void()>, std::less<>> mischief_;

  std::mutex mutex_;  ///< of the world
  std::unique_ptr<sim::BenchWorld> world_;
  hal::SteadyClock clock_;
  std::unique_ptr<hal::CanTransport> bus_;  ///< the nodes' own
  sim::InverterLine line_;
  sim::RemoteIoServer coupler_;
  std::unique_ptr<sim::IioServer> daq_;
  std::unique_ptr<sim::SlcanAdapter> adapter_;  ///< one of these two
  std::unique_ptr<hal::CanTransport> interface_;
  std::unique_ptr<sim::CanBridge> bridge_;

  double told_s_ = -1e9;  ///< when lateness was told last
  std::condition_variable_any ending_;
  std::jthread thread_;
};

}  // namespace rvbench::bench
