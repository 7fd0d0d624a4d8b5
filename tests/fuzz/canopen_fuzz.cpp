#include <algorithm>
#include <cmath>
#include <span>

#include "hal/can/canopen_torque_sensor.hpp"
#include "hal/can/in_process_transport.hpp"
#include "tests/fuzz/scratch_file.hpp"

using namespace rvbench;

namespace {

constexpr int node = 5;
constexpr std::size_t bytes_of_frame = 11;  // time, kind, length, data
constexpr double Nm_per_count = 1e-3;

// A node that says anything, a frame at a time: as long as something is left, time passes with it.
class Babbler final : public hal::Clock {
 public:
  explicit Babbler(std::span<const std::uint8_t> script) : script_(script) {
    test::must(bool(bus.nodes->open()));
  }

  double now_s() const override { return time_s_; }
  bool is_virtual() const override { return true; }
  void wait_until(double time_s) override {
    say_next();
    time_s_ = std::max(time_s_, time_s);
  }

  bool say_next() {
    if (script_.size() < bytes_of_frame) return false;
    constexpr std::array<std::uint32_t, 4> kinds{0x180 + node, 0x280 + node, 0x700 + node, 0x000};
    hal::CanFrame frame{.id = kinds[script_[1] % kinds.size()],
                        .length = std::uint8_t(script_[2] % 9)};
    time_s_ += 1e-3 * script_[0];
    std::copy_n(script_.begin() + 3, frame.data.size(), frame.data.begin());
    test::must(bool(bus.nodes->send(frame)));
    script_ = script_.subspan(bytes_of_frame);
    return true;
  }

  hal::InProcessBus bus = hal::make_in_process_bus([this] { return time_s_; });

 private:
  std::span<const std::uint8_t> script_;
  double time_s_ = 0;
};

void must_make_sense(const hal::TorqueBlock& block) {
  test::must(block.lost >= 0 && std::size_t(block.lost) <= block.samples.size());
  for (std::size_t i = 0; i < block.samples.size(); ++i) {
    const double torque_Nm = block.samples[i].torque_Nm;
    if (i < std::size_t(block.lost)) {
      test::must(std::isnan(torque_Nm));
    } else {
      test::must(std::abs(torque_Nm) <= Nm_per_count * 2147483648.0);
    }
  }
}

}  // namespace

// Whatever comes, no reading tells a torque that the node has not sent, and none is told as long
// as it is not connected. The samples of one connection lie one behind the other.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Babbler babbler({data, size});
  hal::CanopenTorqueSensor sensor(std::move(babbler.bus.bench),
                                  {.node = node, .rate_Hz = 1000, .Nm_per_count = Nm_per_count},
                                  babbler);
  test::must(!sensor.read());
  while (true) {
    if (!sensor.connect()) {
      if (!babbler.say_next()) return 0;
      continue;
    }
    double next_s = babbler.now_s();
    bool is_connected = true;
    while (is_connected) {
      if (!babbler.say_next()) return 0;
      const auto block = sensor.read();
      if (block) {
        test::must(std::abs(block.value().t0_s - next_s) < 1e-6);
        must_make_sense(block.value());
        next_s += 1e-3 * double(block.value().samples.size());
      } else {
        is_connected = block.error().code != IoErrc::disconnected;
      }
    }
    test::must(!sensor.read());
  }
}
