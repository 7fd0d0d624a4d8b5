#include "bench/accelerometer_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <type_traits>

#include "bench/misfit.hpp"
#include "hal/did_you_mean.hpp"
#include "hal/json_object.hpp"
#include "hal/steady_clock.hpp"

namespace rvbench::bench {
namespace {

// Boards count their channels.
bool is_number(const std::string& text) {
  unsigned number = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stop == end;
}

// Of libiio 0.24: iio_create_context_from_uri().
bool is_uri(const std::string& text) {
  constexpr std::array schemes{"ip:", "local:", "usb:", "serial:", "xml:"};
  return std::ranges::any_of(schemes, [&](const char* scheme) { return text.starts_with(scheme); });
}

hal::DaqInput read_input(hal::ConfigReader& entry, bool is_board) {
  hal::DaqInput input;
  input.info.name = entry.text("name");
  input.info.unit = "m/s²";
  input.info.direction = entry.choice("direction", {"+X", "-X", "+Y", "-Y", "+Z", "-Z"});
  input.device_channel = entry.text("channel");
  if (is_board && entry.is_text("channel") && !is_number(input.device_channel)) {
    entry.fault("channel", hal::in_quotes(input.device_channel) + " is no number");
  }
  if (is_board || entry.has("sensitivity_V_per_m_s2")) {
    input.info.sensitivity = entry.number("sensitivity_V_per_m_s2", {1e-9, 1e3});
  }
  return input;
}

nlohmann::ordered_json to_json(const hal::DaqInput& input) {
  nlohmann::ordered_json json = hal::json_object({{"name", input.info.name},
                                                  {"channel", input.device_channel},
                                                  {"direction", input.info.direction}});
  if (std::isfinite(input.info.sensitivity))
    json["sensitivity_V_per_m_s2"] = input.info.sensitivity;
  return json;
}

// What both kinds of front end have.
template <typename Options>
void read_common(hal::ConfigReader& accelerometers, Options& options) {
  options.rate_Hz = accelerometers.number("rate_Hz", {100, 1e6});
  options.range_m_s2 = accelerometers.number("range_m_s2", {0.1, 1e6});
  options.block_s = accelerometers.number("block_s", {0.001, 0.05}, options.block_s);
  options.deadline_s = accelerometers.number("deadline_s", {0.02, 2}, options.deadline_s);
  constexpr bool is_board = std::is_same_v<Options, hal::ComediOptions>;
  const std::size_t faults_before = accelerometers.faults().size();
  std::set<std::string> names, channels;
  for (hal::ConfigReader& entry : accelerometers.objects("inputs")) {
    options.inputs.push_back(read_input(entry, is_board));
    const auto& [channel, info] = options.inputs.back();
    if (entry.has("name") && !names.insert(info.name).second)
      entry.fault("name", "there is another input of this name");
    if (entry.has("channel") && !channels.insert(channel).second) {
      entry.fault("channel", "there is another input on this channel");
    }
  }
  if (options.inputs.empty() && accelerometers.faults().size() == faults_before) {
    accelerometers.fault("inputs", "must not be empty");
  }
}

hal::IioOptions read_iio(hal::ConfigReader& accelerometers) {
  hal::IioOptions options;
  options.uri = accelerometers.text("uri");
  if (accelerometers.is_text("uri") && !is_uri(options.uri)) {
    accelerometers.fault("uri", hal::in_quotes(options.uri) +
                                    " begins with none of ip:, local:, usb:, serial: and xml:");
  }
  options.device = accelerometers.text("device");
  read_common(accelerometers, options);
  return options;
}

hal::ComediOptions read_comedi(hal::ConfigReader& accelerometers) {
  hal::ComediOptions options;
  options.device = accelerometers.text("device", options.device);
  options.range_V = accelerometers.number("volts", {1e-3, 100}, options.range_V);
  read_common(accelerometers, options);
  return options;
}

nlohmann::ordered_json start_of(const hal::IioOptions& options) {
  return hal::json_object({{"backend", "iio"}, {"uri", options.uri}, {"device", options.device}});
}

nlohmann::ordered_json start_of(const hal::ComediOptions& options) {
  return hal::json_object(
      {{"backend", "comedi"}, {"device", options.device}, {"volts", options.range_V}});
}

std::string place_of(const hal::IioOptions& options) {
  return fmt::format("{} of {} at {}", options.inputs.size(), options.device, options.uri);
}

std::string place_of(const hal::ComediOptions& options) {
  return fmt::format("{} of {}", options.inputs.size(), options.device);
}

std::unique_ptr<hal::Accelerometers> made(const hal::IioOptions& options, hal::Clock& clock) {
  return hal::make_iio_accelerometers(options, clock);
}

std::unique_ptr<hal::Accelerometers> made(const hal::ComediOptions& options, hal::Clock& clock) {
  return hal::make_comedi_accelerometers(options, clock);
}

}  // namespace

AccelerometerSection read_accelerometer_section(hal::ConfigReader& accelerometers) {
  AccelerometerSection section;
  const std::size_t faults_before = accelerometers.faults().size();
  const std::string backend = accelerometers.choice("backend", {"iio", "comedi"});
  if (backend == "comedi") {
    section.options = read_comedi(accelerometers);
  } else {
    section.options = read_iio(accelerometers);
  }
  if (accelerometers.faults().size() > faults_before) return section;
  try {
    hal::SteadyClock clock;
    (void)make_accelerometers(section, clock);  // opens nothing; knows what does not fit together
  } catch (const std::invalid_argument& error) {
    note_misfit(accelerometers, "inputs", error);
  }
  return section;
}

nlohmann::ordered_json to_json(const AccelerometerSection& accelerometers) {
  return std::visit(
      [](const auto& options) {
        auto inputs = nlohmann::ordered_json::array();
        for (const hal::DaqInput& input : options.inputs) inputs.push_back(to_json(input));
        nlohmann::ordered_json json = start_of(options);
        json["rate_Hz"] = options.rate_Hz;
        json["range_m_s2"] = options.range_m_s2;
        json["block_s"] = options.block_s;
        json["deadline_s"] = options.deadline_s;
        json["inputs"] = inputs;
        return json;
      },
      accelerometers.options);
}

std::string address_of(const AccelerometerSection& accelerometers) {
  return std::visit([](const auto& options) { return place_of(options); }, accelerometers.options);
}

std::unique_ptr<hal::Accelerometers> make_accelerometers(const AccelerometerSection& accelerometers,
                                                         hal::Clock& clock) {
  return std::visit([&clock](const auto& options) { return made(options, clock); },
                    accelerometers.options);
}

}  // namespace rvbench::bench
