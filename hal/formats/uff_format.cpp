#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "hal/formats/apply_units.hpp"
#include "hal/formats/facts.hpp"
#include "hal/formats/fixed_columns.hpp"
#include "hal/formats/foreign_file.hpp"
#include "hal/formats/format.hpp"
#include "hal/formats/start_time.hpp"
#include "hal/formats/uff_units.hpp"

namespace rvbench::hal::formats {
namespace {

constexpr int time_code = 17;

// Seconds per unit of the abscissa; nothing if it is no time.
std::optional<double> seconds_of(const UffAxis& axis) {
  const std::optional<SiUnit> unit = si_unit(axis.unit);
  if (unit && unit->symbol == "s") return unit->factor;
  if (!unit && axis.quantity == time_code) return 1;
  return std::nullopt;
}

std::optional<std::string> find_fault(const UffFunction& function) {
  if (function.is_complex) return "a time response of complex values";
  if (!seconds_of(function.abscissa)) return "a time response over what is no time";
  if (!function.step && function.values.size() > 1) {
    return "times rise unevenly: samples are missing";
  }
  return std::nullopt;
}

std::string name_of(const UffFunction& function) {
  for (const std::string& name :
       {function.response.point, function.numerator.label, function.id_lines[0]}) {
    if (!name.empty()) return name;
  }
  return "line_" + std::to_string(function.line);
}

Channel channel_of(const UffFunction& function, const std::optional<UffUnits>& units,
                   std::vector<std::string>& notes) {
  Channel channel;
  channel.info.name = name_of(function);
  channel.info.direction = function.response.direction;
  const double unit_s = seconds_of(function.abscissa).value_or(1);
  channel.rate_Hz = function.step ? 1 / (*function.step * unit_s) : 0;
  channel.start_s = function.first * unit_s;
  channel.samples = function.values.real();
  if (const std::optional<SiUnit> unit = unit_of(function.numerator, units)) {
    apply_unit(*unit, channel, notes);
  } else {
    channel.info.unit = function.numerator.unit;
  }
  return channel;
}

bool is_same_sensor(const Channel& a, const Channel& b) {
  return a.info.name == b.info.name && a.info.direction == b.info.direction;
}

// One sensor of a recording under way.
struct Sensor {
  Channel channel;
  std::string date;  // as the file has it
};

// Sampled at once, as far as the file tells: of one rate, length and start, and no sensor anew at
// another date.
bool belongs_to(const std::vector<Sensor>& others, const Sensor& sensor) {
  const Channel& first = others.front().channel;
  return first.rate_Hz == sensor.channel.rate_Hz && first.start_s == sensor.channel.start_s &&
         first.samples.size() == sensor.channel.samples.size() &&
         std::none_of(others.begin(), others.end(), [&](const Sensor& other) {
           return is_same_sensor(other.channel, sensor.channel) && other.date != sensor.date;
         });
}

// What a file of rvbench says in a line of text: "speed_rpm=604.5 load_pct=50",
// "rvbench_status=ok". Nothing if it says anything else.
std::optional<Facts> facts_in(std::string_view line) {
  constexpr std::array<std::string_view, 5> numbers = {"speed_rpm", "planned_speed_rpm", "load_pct",
                                                       "torque_Nm", "repeat"};
  constexpr std::string_view status = "rvbench_status=";
  Facts facts;
  while (!line.empty()) {
    if (line.starts_with(status)) {
      facts.texts["rvbench_status"] = line.substr(status.size());
      return facts;
    }
    const std::string_view word = line.substr(0, line.find(' '));
    line.remove_prefix(std::min(word.size() + 1, line.size()));
    const std::size_t equals = word.find('=');
    if (equals == word.npos || equals + 1 == word.size()) return std::nullopt;
    const std::string_view name = word.substr(0, equals);
    const auto number = Columns(word.substr(equals + 1)).number();
    if (std::ranges::find(numbers, name) == numbers.end() || !number) return std::nullopt;
    facts.numbers[std::string(name)] = *number;
  }
  return facts;
}

// Those of all lines, which are blank behind that: a note would tell them once more.
Facts take_facts(UffFunction& function) {
  Facts all;
  for (std::string& line : function.id_lines) {
    std::optional<Facts> facts = facts_in(line);
    if (!facts) continue;
    all.numbers.merge(facts->numbers);
    all.texts.merge(facts->texts);
    line.clear();
  }
  return all;
}

std::string status_of(const UffFunction& function) {
  if (function.is_whole()) return "ok";
  return fmt::format("INVALID: {}: {} values declared, {} found", place_of(function),
                     function.declared, function.found);
}

// Recordings as they are put together.
struct Gathered {
  std::vector<Recording> recordings;
  std::vector<Sensor> sensors;  // of the last one
  Facts facts;                  // of it
  bool is_whole = true;

  void add(UffFunction function, const std::optional<UffUnits>& units) {
    std::vector<std::string> notes;
    const Facts said = take_facts(function);
    Sensor sensor{channel_of(function, units, notes), function.id_lines[2]};
    const std::string status = status_of(function);
    const bool goes_on = !recordings.empty() && is_whole && status == "ok" &&
                         said.numbers == facts.numbers && said.texts == facts.texts &&
                         belongs_to(sensors, sensor);
    if (!goes_on) start(status, said);
    if (const std::string note = id_note(function); !note.empty()) {
      notes.push_back(sensor.channel.info.name + ": " + note);
    }
    Recording& recording = recordings.back();
    if (std::isnan(noted_start_s(recording))) note_start(utc_of_uff_date(sensor.date), recording);
    recording.notes.insert(recording.notes.end(), notes.begin(), notes.end());
    recording.channels.push_back(sensor.channel);
    sensors.push_back(std::move(sensor));
  }

 private:
  void start(const std::string& status, const Facts& said) {
    recordings.emplace_back().status = status;
    apply(said, recordings.back());
    facts = said;
    is_whole = status == "ok";
    sensors.clear();
  }
};

// A channel is asked for by its name: two directions of one node get theirs, others a number.
void name_apart(std::vector<Channel>& channels) {
  std::multiset<std::string> names;
  for (const Channel& channel : channels) names.insert(channel.info.name);
  for (Channel& channel : channels) {
    const std::string& direction = channel.info.direction;
    if (names.count(channel.info.name) > 1 && !direction.empty()) {
      channel.info.name += ":" + direction;
    }
  }
  std::map<std::string, int> seen;
  for (Channel& channel : channels) {
    const int times = ++seen[channel.info.name];
    if (times > 1) channel.info.name += fmt::format("_{}", times);
  }
}

std::string holds_instead(const std::vector<UffDataset>& datasets, const std::set<int>& types) {
  std::string functions;
  for (const int type : types) functions += ", " + name_of_type(type) + " (58)";
  return fmt::format("holds {}{}, no time record", contents_of(datasets), functions);
}

Result<std::vector<Recording>> read_uff(const std::filesystem::path& file, const TableHints&) {
  const std::string bytes = bytes_of(file);
  const std::vector<UffDataset> datasets = uff_datasets(bytes);
  const auto units = read_uff_units(file, datasets);
  if (!units) return units.error();
  Gathered gathered;
  std::set<int> other_types;
  for (const UffDataset& dataset : datasets) {
    if (dataset.number != 58) continue;
    Result<UffFunction> function = read_uff_function(file, dataset);
    if (!function) return function.error();
    if (!function.value().is(UffFunctionType::time_response)) {
      other_types.insert(function.value().type);
    } else if (const auto fault = find_fault(function.value())) {
      return bad_file(file, place_of(function.value()) + ": " + *fault);
    } else {
      gathered.add(std::move(function).value(), units.value());
    }
  }
  std::vector<Recording>& recordings = gathered.recordings;
  if (recordings.empty()) return bad_file(file, holds_instead(datasets, other_types));
  const std::vector<std::string> notes = header_notes(datasets);
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    Recording& recording = recordings[i];
    recording.source = file.string();
    if (recordings.size() > 1) recording.source += fmt::format("#{}", i + 1);
    recording.notes.insert(recording.notes.begin(), notes.begin(), notes.end());
    name_apart(recording.channels);
  }
  return std::move(recordings);
}

}  // namespace

Format uff_format() { return {"UFF", is_uff, {".uff", ".unv"}, read_uff}; }

}  // namespace rvbench::hal::formats
