#include <array>
#include <chrono>
#include <stdexcept>

#include "hal/modbus/drive_profile_json.hpp"
#include "hal/modbus/drive_words.hpp"
#include "hal/modbus/modbus_inverter.hpp"
#include "hal/steady_clock.hpp"
#include "sim/inverter_server.hpp"
#include "tests/latency/figures.hpp"
#include "tests/support/bare_master.hpp"

namespace rvbench::test {
namespace {

double time_us(const std::function<bool()>& reading) {
  const auto began = std::chrono::steady_clock::now();
  if (!reading()) throw std::runtime_error("the inverter does not answer");
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - began)
      .count();
}

}  // namespace

// In turns, reading by reading: whatever else the machine does meets both.
std::vector<Figure> measure_polling(int readings) {
  sim::InverterModel model;
  sim::InverterServer server(model);
  hal::SteadyClock clock;
  const hal::DriveProfile profile = hal::drive_profile("rvbench_generic");
  hal::ModbusInverter inverter(
      {.profile = profile, .path = hal::ModbusTcp{"127.0.0.1", server.port()}}, clock);
  if (!inverter.connect()) throw std::runtime_error("the inverter does not connect");
  BareMaster bare(modbus_new_tcp("127.0.0.1", server.port()));
  const auto blocks = hal::status_blocks(profile);
  std::array<std::uint16_t, 125> words{};
  std::vector<double> ours_us, bare_us;
  for (int i = 0; i < readings; ++i) {
    ours_us.push_back(time_us([&] { return bool(inverter.read()); }));
    bare_us.push_back(time_us([&] {
      for (const hal::DriveBlock& block : blocks) {
        const auto count = static_cast<std::size_t>(block.count);
        if (!bare.read(block.address, {words.data(), count})) return false;
      }
      return true;
    }));
  }
  const double ours = quantile(ours_us, 0.5), plain = quantile(bare_us, 0.5);
  return {{"reading the drive's state, against bare libmodbus", ours / plain, "x", 1.3, 2},
          {"reading the drive's state, median", ours, "us"},
          {"the same registers by bare libmodbus, median", plain, "us"}};
}

}  // namespace rvbench::test
