#include "bench/accelerometer_section.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "hal/steady_clock.hpp"

namespace rvbench::bench {
namespace {

hal::DaqInput read_input(hal::ConfigReader& entry) {
  hal::DaqInput input;
  input.info.name = entry.text("name");
  input.info.unit = "m/s²";
  input.info.direction = entry.choice("direction", {"+X", "-X", "+Y", "-Y", "+Z", "-Z"});
  input.device_channel = entry.text("channel");
  input.m_s2_per_unit = 1;
  if (entry.has("sensitivity_V_per_m_s2")) {
    input.info.sensitivity = entry.number("sensitivity_V_per_m_s2", {1e-9, 1e3});
    input.m_s2_per_unit = 1 / input.info.sensitivity;
  }
  return input;
}

nlohmann::ordered_json to_json(const hal::DaqInput& input) {
  nlohmann::ordered_json json{{"name", input.info.name},
                              {"channel", input.device_channel},
                              {"direction", input.info.direction}};
  if (input.m_s2_per_unit != 1) json["sensitivity_V_per_m_s2"] = input.info.sensitivity;
  return json;
}

}  // namespace

AccelerometerSection read_accelerometer_section(hal::ConfigReader& accelerometers) {
  AccelerometerSection section;
  hal::IioOptions& options = section.options;
  const std::size_t faults_before = accelerometers.faults().size();
  (void)accelerometers.choice("backend", {"iio"});
  options.uri = accelerometers.text("uri");
  options.device = accelerometers.text("device");
  options.rate_Hz = accelerometers.number("rate_Hz", {100, 1e6});
  options.range_m_s2 = accelerometers.number("range_m_s2", {0.1, 1e6});
  options.block_s = accelerometers.number("block_s", {0.001, 0.05}, options.block_s);
  options.deadline_s = accelerometers.number("deadline_s", {0.02, 2}, options.deadline_s);
  std::set<std::string> names;
  for (hal::ConfigReader& entry : accelerometers.objects("inputs")) {
    options.inputs.push_back(read_input(entry));
    const std::string& name = options.inputs.back().info.name;
    if (!names.insert(name).second) entry.fault("name", "there is another input of this name");
  }
  if (accelerometers.faults().size() > faults_before) return section;
  try {
    hal::SteadyClock clock;
    (void)make_accelerometers(section, clock);  // opens nothing; knows what does not fit together
  } catch (const std::invalid_argument& error) {
    accelerometers.fault("", error.what());
  }
  return section;
}

nlohmann::ordered_json to_json(const AccelerometerSection& accelerometers) {
  const hal::IioOptions& options = accelerometers.options;
  auto inputs = nlohmann::ordered_json::array();
  for (const hal::DaqInput& input : options.inputs) inputs.push_back(to_json(input));
  return {{"backend", "iio"},
          {"uri", options.uri},
          {"device", options.device},
          {"rate_Hz", options.rate_Hz},
          {"range_m_s2", options.range_m_s2},
          {"block_s", options.block_s},
          {"deadline_s", options.deadline_s},
          {"inputs", inputs}};
}

std::string address_of(const AccelerometerSection& accelerometers) {
  const hal::IioOptions& options = accelerometers.options;
  return fmt::format("{} of {} at {}", options.inputs.size(), options.device, options.uri);
}

std::unique_ptr<hal::Accelerometers> make_accelerometers(const AccelerometerSection& accelerometers,
                                                         hal::Clock& clock) {
  return hal::make_iio_accelerometers(accelerometers.options, clock);
}

}  // namespace rvbench::bench
