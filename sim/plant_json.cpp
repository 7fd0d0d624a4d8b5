#include "sim/plant_json.hpp"

#include <algorithm>
#include <filesystem>

#include "hal/did_you_mean.hpp"
#include "sim/plant_check.hpp"
#include "sim/plant_files.hpp"
#include "sim/plant_model.hpp"
#include "sim/plant_words.hpp"

namespace rvbench::sim {
namespace {

using hal::ConfigReader;

constexpr hal::Bounds any{-unbounded, unbounded};

// @param fallback  a word; empty if the key is required
template <typename T, std::size_t n>
T choose(ConfigReader& at, const char* key, const std::array<Word<T>, n>& words,
         std::string fallback = {}) {
  std::vector<std::string_view> known;
  for (const auto& entry : words) known.push_back(entry.word);
  const std::string word =
      fallback.empty() ? at.choice(key, known) : at.choice(key, known, std::move(fallback));
  return std::ranges::find(words, word, &Word<T>::word)->value;
}

Quantity read_quantity(ConfigReader& at) {
  Quantity quantity;
  quantity.value = at.number("value", any);
  quantity.unit = at.text("unit");
  if (!at.is_text("tolerance_pct")) {
    quantity.tolerance_pct = at.number("tolerance_pct", {0, unbounded}, 0);
  } else if (at.text("tolerance_pct") == "free") {
    quantity.tolerance_pct = Quantity::free_pct;
  } else {
    at.fault("tolerance_pct", "expected a number or \"free\"");
  }
  return quantity;
}

Quantity quantity_at(ConfigReader& parent, const char* key, Quantity fallback) {
  auto at = parent.optional_object(key);
  return at ? read_quantity(*at) : fallback;
}

BodySpec read_body(ConfigReader& at) {
  BodySpec body;
  body.name = at.text("name");
  body.motion = choose(at, "motion", motion_words);
  const bool turns = body.motion == Motion::rotation;
  ConfigReader inertia = at.object(turns ? "inertia" : "mass");
  body.inertia = read_quantity(inertia);
  body.start_position = at.number(turns ? "start_angle_rad" : "start_position_m", any, 0);
  body.start_speed = at.number(turns ? "start_speed_rad_s" : "start_speed_m_s", any, 0);
  body.about = at.text("about", "");
  return body;
}

void fill_fallbacks(TermSpec& term, const TermType& type, Motion motion) {
  for (const ParameterCard& card : type.parameters) {
    if (!card.fallback || term.parameters.contains(card.name)) continue;
    term.parameters[card.name] = {*card.fallback, std::string(unit_of(card.unit, motion)), 0};
  }
}

TermSpec read_term(ConfigReader& at, const PlantSpec& plant, const TermLibrary& library) {
  TermSpec term;
  term.type = at.text("type");
  term.name = at.text("name", term.type);
  term.body_a = at.text("body_a");
  term.body_b = at.text("body_b", term.body_b);
  term.about = at.text("about", "");
  if (auto parameters = at.optional_object("parameters")) {
    for (auto& [name, quantity] : parameters->members()) {
      term.parameters[name] = read_quantity(quantity);
    }
  }
  const TermType* type = library.find(term.type);
  if (type == nullptr) {
    at.disregard();
    return term;
  }
  if (type->gate.reference != ReferenceKind::none) {
    term.reference = at.text(type->gate.reference_key);
  }
  fill_fallbacks(term, *type, plant.motion_of(term.body_a));
  return term;
}

InputSpec read_input(ConfigReader& at, const PlantSpec& plant) {
  InputSpec input;
  input.channel = at.text("channel");
  input.name = at.text("name", input.channel);
  input.unit = at.text("unit");
  input.kind = choose(at, "is", input_words);
  const bool signal = input.kind == InputKind::signal;
  if (!signal) input.body = at.text("body");
  const std::string si =
      signal ? input.unit : std::string(si_unit(input.kind, plant.motion_of(input.body)));
  input.gain = quantity_at(at, "gain", {1, "1", 0});
  input.offset = quantity_at(at, "offset", {0, si, 0});
  if (signal || input.kind == InputKind::force) {
    input.between = choose(at, "between_samples", between_words, "band_limited");
  } else {
    input.band_Hz = at.number("band_Hz", {1e-6, 1e9});
  }
  return input;
}

Hum read_hum(ConfigReader& at) {
  ConfigReader amplitude = at.object("amplitude"), frequency = at.object("frequency");
  return {read_quantity(amplitude), quantity_at(at, "phase", {0, "rad", 0}),
          read_quantity(frequency)};
}

OutputSpec read_output(ConfigReader& at) {
  OutputSpec output;
  output.channel = at.text("channel");
  output.unit = at.text("unit");
  output.kind = choose(at, "is", output_words);
  output.of = at.text(output.kind == OutputKind::effort ? "term" : "body");
  output.gain = quantity_at(at, "gain", {1, "1", 0});
  output.offset = quantity_at(at, "offset", {0, output.unit, 0});
  output.delay = quantity_at(at, "delay", {0, "s", 0});
  output.compared_by = choose(at, "compared_by", compared_by_words, "samples");
  if (output.compared_by == ComparedBy::envelope) {
    output.from_Hz = at.number("from_Hz", {0, 1e9});
    output.to_Hz = at.number("to_Hz", {1e-6, 1e9});
  }
  for (ConfigReader& hum : at.objects("hums", false)) output.hums.push_back(read_hum(hum));
  return output;
}

// Notes a fault where the pointer leads, or at the nearest place above that the file has.
void note_at(ConfigReader at, std::string_view pointer, const std::string& message) {
  const std::size_t end = std::min(pointer.find('/', 1), pointer.size());
  const std::string key(pointer.substr(1, end - 1));
  std::string_view rest = pointer.substr(end);
  if (rest.empty()) return at.fault(key, message);
  const std::size_t digits = rest.find_first_not_of("0123456789", 1);
  if (digits != 1 && (digits == std::string_view::npos || rest[digits] == '/')) {
    const auto index = std::stoul(std::string(rest.substr(1)));
    std::vector<ConfigReader> items = at.objects(key, false);
    rest = digits == std::string_view::npos ? "" : rest.substr(digits);
    if (index >= items.size()) return at.fault(key, message);
    return rest.empty() ? items[index].fault("", message) : note_at(items[index], rest, message);
  }
  auto child = at.has(key) ? at.optional_object(key) : std::nullopt;
  return child ? note_at(*child, rest, message) : at.fault(key, message);
}

bool noted_around(const std::vector<hal::ConfigFault>& faults, const std::string& pointer) {
  return std::any_of(faults.begin(), faults.end(), [&](const hal::ConfigFault& fault) {
    return pointer.starts_with(fault.pointer) || fault.pointer.starts_with(pointer);
  });
}

// What there is instead of a plant that is not.
std::string shipped(const std::string& wrong) {
  std::vector<std::string> names;
  std::string list;
  for (const EmbeddedFile& file : plant_files()) {
    names.push_back(file.name);
    list += (list.empty() ? "" : ", ") + file.name;
  }
  return " (there are: " + list + ')' + hal::did_you_mean(wrong, names);
}

}  // namespace

PlantOrFaults parse_plant(ConfigReader root, const TermLibrary& library) {
  PlantSpec plant;
  plant.name = root.text("plant");
  plant.about = root.text("about", "");
  for (ConfigReader& at : root.objects("bodies")) plant.bodies.push_back(read_body(at));
  for (ConfigReader& at : root.objects("terms", false)) {
    plant.terms.push_back(read_term(at, plant, library));
  }
  for (ConfigReader& at : root.objects("inputs", false)) {
    plant.inputs.push_back(read_input(at, plant));
  }
  for (ConfigReader& at : root.objects("outputs")) plant.outputs.push_back(read_output(at));
  root.finish();
  const std::vector<hal::ConfigFault> syntax = root.faults();
  for (const hal::ConfigFault& fault : check_plant(plant, library)) {
    if (!noted_around(syntax, fault.pointer)) note_at(root, fault.pointer, fault.message);
  }
  if (root.faults().empty()) {
    const auto made = make_model(plant, library);  // terms look at their values together
    if (const auto* fault = std::get_if<hal::ConfigFault>(&made)) {
      note_at(root, fault->pointer, fault->message);
    }
  }
  if (!root.faults().empty()) return root.faults();
  return plant;
}

PlantOrFaults read_plant(const std::string& name_or_path, const TermLibrary& library) {
  for (const EmbeddedFile& file : plant_files()) {
    if (file.name != name_or_path) continue;
    return parse_plant(ConfigReader::from_text(file.text, file.name + ".json"), library);
  }
  std::error_code unknown;
  if (!std::filesystem::exists(name_or_path, unknown) && !unknown) {
    return std::vector<hal::ConfigFault>{
        {0, "", "no such file or shipped plant" + shipped(name_or_path)}};
  }
  return parse_plant(ConfigReader::from_file(name_or_path), library);
}

}  // namespace rvbench::sim
