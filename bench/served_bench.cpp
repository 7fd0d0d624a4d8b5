#include "bench/served_bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "bench/file_kind.hpp"
#include "bench/sim_world.hpp"
#include "hal/can/can_frames.hpp"
#include "hal/can/socketcan_transport.hpp"
#include "hal/did_you_mean.hpp"
#include "hal/types/units.hpp"

namespace rvbench::bench {
namespace {

constexpr std::chrono::milliseconds step{1};
constexpr double chunk_s = 0.01;   // of catching up: whoever waits for the world gets it in between
constexpr double late_s = 0.1;     // what a client's deadlines still leave room for
constexpr double most_late_s = 1;  // what a real bench would have done meanwhile is not made up for
constexpr double tell_again_s = 10;

std::unique_ptr<hal::CanTransport> open_interface(const std::string& name,
                                                  const hal::Clock& clock) {
  auto interface = std::make_unique<hal::SocketcanTransport>(
      name, std::vector<std::uint32_t>{hal::can_frames::brake_command_id}, clock);
  if (const Status opened = interface->open(); !opened) {
    throw std::runtime_error(describe(opened.error()));
  }
  return interface;
}

std::unique_ptr<sim::IioServer> make_daq(const sim::BenchWorld& world, std::uint16_t port) {
  sim::IioFrontEnd front_end;
  front_end.rate_Hz = world.acceleration_rate_Hz();
  for (const ChannelInfo& channel : world.acceleration_channels()) {
    front_end.labels.push_back(channel.name);
  }
  return std::make_unique<sim::IioServer>(front_end, port);
}

// The front end tells m/s² by itself.
AccelerometerSection section_of(const sim::IioServer& daq, const sim::BenchWorld& world) {
  hal::IioOptions options;
  options.uri = fmt::format("ip:127.0.0.1:{}", daq.port());
  options.device = sim::IioFrontEnd().device;
  options.rate_Hz = world.acceleration_rate_Hz();
  options.range_m_s2 = world.acceleration_range_m_s2();
  for (const ChannelInfo& channel : world.acceleration_channels()) {
    options.inputs.push_back({fmt::format("accel{}", options.inputs.size()), channel});
    options.inputs.back().info.sensitivity = not_known;
  }
  return {options};
}

}  // namespace

ServedBench::ServedBench(const SimRig& sim, std::unique_ptr<sim::BenchWorld> world,
                         const ServedOptions& options, Tell tell)
    : sim_(sim),
      options_(options),
      tell_(std::move(tell)),
      world_(std::move(world)),
      bus_(world_->make_can_transport()),
      line_(world_->inverter()),
      coupler_(options.coupler_port),
      daq_(make_daq(*world_, options.daq_port)) {
  if (options.can_interface.empty()) {
    adapter_ = std::make_unique<sim::SlcanAdapter>(*bus_);
  } else {
    interface_ = open_interface(options.can_interface, clock_);
    bridge_ = std::make_unique<sim::CanBridge>(*bus_, *interface_);
  }
  for (const ScheduledFault& fault : sim_.faults) {
    world_->at(fault.at_s, [this, kind = wire_fault(fault.fault)] { inject_inverter(kind); });
  }
  add_mischief();
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

ServedBench::~ServedBench() = default;

void ServedBench::run(const std::stop_token& stop) {
  double origin_s = clock_.now_s();
  auto next = std::chrono::steady_clock::now();
  std::mutex own;
  for (std::unique_lock lock(own); !stop.stop_requested();) {
    next = std::max(next + step, std::chrono::steady_clock::now());
    ending_.wait_until(lock, stop, next, [] { return false; });
    origin_s += catch_up(clock_.now_s() - origin_s);
  }
}

// Brings the world to this time.
// @return by how much it has to be later from now on: what is lost
double ServedBench::catch_up(double time_s) {
  const double behind_s = time_s - world_->now_s();
  const double lost_s = behind_s > most_late_s ? behind_s : 0;
  if (behind_s > late_s) tell_lateness(behind_s);
  if (lost_s > 0) return lost_s;
  for (double now_s = world_->now_s(); now_s < time_s;) {
    now_s = std::min(now_s + chunk_s, time_s);
    const std::lock_guard lock(mutex_);
    world_->advance_to(now_s);
    hand_over();
  }
  return 0;
}

// What has no way out of the world by itself.
void ServedBench::hand_over() {
  daq_->push(world_->take_accelerations().scans);
  coupler_.show(world_->safety_status());
}

void ServedBench::tell_lateness(double behind_s) {
  if (clock_.now_s() < told_s_ + tell_again_s) return;
  told_s_ = clock_.now_s();
  tell_(
      fmt::format("the simulated bench is {:.2f} s behind: this computer is too busy, and its "
                  "devices answer late",
                  behind_s));
}

void ServedBench::inject_inverter(sim::WireFault fault) {
  world_->inverter_server().inject({.fault = fault});
  line_.inject({.fault = fault});
}

// The world is locked while one of these is done.
void ServedBench::add_mischief() {
  using sim::NodeFault;
  mischief_["estop"] = [this] { world_->press_estop(); };
  mischief_["guard"] = [this] { world_->open_guard(); };
  mischief_["temperature lost"] = [this] { world_->lose_temperature(); };
  mischief_["daq silent"] = [this] { world_->stop_daq(); };
  mischief_["transducer silent"] = [this] { world_->transducer().set_fault(NodeFault::silent); };
  mischief_["transducer frozen"] = [this] { world_->transducer().set_fault(NodeFault::frozen); };
  mischief_["brake silent"] = [this] { world_->brake().set_fault(NodeFault::silent); };
  mischief_["brake trips"] = [this] { world_->brake().trip(); };
  mischief_["drive trips"] = [this] { world_->inverter().trip(sim::fault_overcurrent); };
  for (const std::string_view name : wire_fault_names()) {
    const sim::WireFault fault = wire_fault(name);
    mischief_["inverter " + std::string(name)] = [this, fault] { inject_inverter(fault); };
    mischief_["coupler " + std::string(name)] = [this, fault] {
      coupler_.inject({.fault = fault});
    };
  }
  if (adapter_) {
    mischief_["adapter silent"] = [this] { adapter_->inject(sim::SlcanFault::silent); };
    mischief_["adapter bus_off"] = [this] { adapter_->inject(sim::SlcanFault::bus_off); };
  }
  mischief_["tap"] = [this] { world_->tap_housing(); };
  mischief_["heal"] = [this] { heal(); };
}

void ServedBench::heal() {
  world_->press_estop(false);
  world_->open_guard(false);
  world_->lose_temperature(false);
  world_->stop_daq(false);
  world_->transducer().set_fault(sim::NodeFault::none);
  world_->brake().set_fault(sim::NodeFault::none);
  inject_inverter(sim::WireFault::none);
  coupler_.inject({});
  if (adapter_) adapter_->inject(sim::SlcanFault::none);
}

std::string ServedBench::obey(const std::string& line) {
  const auto found = mischief_.find(line);
  if (found != mischief_.end()) {
    const std::lock_guard lock(mutex_);
    found->second();
    return line + ": done";
  }
  std::vector<std::string> known;
  for (const auto& [phrase, act] : mischief_) known.push_back(phrase);
  return "not understood: " + hal::in_quotes(line) + hal::what_there_is(line, known);
}

std::string ServedBench::status() {
  const std::lock_guard lock(mutex_);
  const double speed_rpm = units::rpm_from_rad_s(world_->plant().motor_speed_rad_s());
  const double load_Nm = world_->plant().brake_torque_Nm();
  const hal::SafetyStatus safety = world_->safety_status();
  // Rounded first: no "-0 rpm".
  return fmt::format("shaft {:.0f} rpm, load {:.1f} N·m, brake {}{}{}", std::round(speed_rpm) + 0.0,
                     std::round(10 * load_Nm) / 10 + 0.0,
                     world_->brake().engaged() ? "engaged" : "released",
                     safety.estop_pressed ? ", emergency stop pressed" : "",
                     safety.guard_open ? ", guard open" : "");
}

std::string ServedBench::commands() {
  return "  estop, guard                   pressed, opened: a run ends with exit code 40\n"
         "  inverter WORD, coupler WORD    its Modbus replies are late, silent, garbled, busy or\n"
         "                                 dead; none heals them\n"
         "  transducer silent or frozen; brake silent; brake trips; drive trips; daq silent;\n"
         "  temperature lost; adapter silent or bus_off\n"
         "  tap                            somebody taps on the housing, as rvbench qualify asks\n"
         "  heal                           everything is well again, but what has tripped\n";
}

std::string ServedBench::addresses() const {
  const BenchRig at = rig();
  const auto line = [](const char* device, const std::string& where) {
    return fmt::format("  {:<16}{}\n", device, where);
  };
  return line("inverter", fmt::format("Modbus TCP on 127.0.0.1:{}, RTU on {}; unit 1",
                                      world_->inverter_server().port(), line_.device())) +
         line("CAN bus", address_of(*at.can) + ": transducer 0x181, brake 0x201 and 0x281") +
         line("accelerometers", address_of(*at.accelerometers)) +
         line("safety inputs", "Modbus TCP on " + address_of(*at.safety));
}

BenchRig ServedBench::rig() const {
  BenchRig rig;
  rig.plant = sim_.plant;
  rig.qualification = sim_.qualification;
  rig.drive.profile = "rvbench_generic";
  hal::ModbusInverterOptions& drive = rig.drive.options;
  drive.path = hal::ModbusTcp{"127.0.0.1", world_->inverter_server().port()};
  if (options_.drive_on_line) drive.path = hal::ModbusRtu{line_.device()};
  drive.motor.pole_pairs = world_->inverter().parameters().pole_pairs;
  drive.limits.max_speed_rpm = 3000;
  rig.can.emplace();
  rig.can->bus = options_.can_interface;
  if (adapter_) rig.can->bus = hal::SlcanOptions{.device = adapter_->device()};
  rig.torque.emplace().rate_Hz = world_->transducer().rate_Hz();
  rig.brake.emplace();
  rig.accelerometers = section_of(*daq_, *world_);
  rig.safety.emplace().options.path = hal::ModbusTcp{"127.0.0.1", coupler_.port()};
  return rig;
}

}  // namespace rvbench::bench
