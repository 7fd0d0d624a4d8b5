#include "bench/station/gage_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "bench/station/station_table.hpp"
#include "hal/formats/foreign_file.hpp"

namespace rvbench::bench {
namespace {

// The number of a name, which is new or was met before.
std::size_t number_of(const std::string& name, std::vector<std::string>& names) {
  const auto at = std::ranges::find(names, name);
  if (at != names.end()) return std::size_t(at - names.begin());
  names.push_back(name);
  return names.size() - 1;
}

struct ReadingPlace {
  std::size_t part, op, trial;
};

std::string text_of(const ReadingPlace& place, const GageFile& study,
                    const std::vector<std::string>& trials) {
  return fmt::format("part {}, operator {}, trial {}", study.parts[place.part],
                     study.operators[place.op], trials[place.trial]);
}

std::size_t index_of(const ReadingPlace& place, const analysis::GageReadings& sizes) {
  return (place.part * sizes.operators + place.op) * sizes.trials + place.trial;
}

// Reading by reading: names that are no names, as time stamps, make more places than memory holds.
Result<Done> fill(const StationTable& table, const std::vector<ReadingPlace>& places,
                  const std::vector<double>& values, const std::vector<std::string>& trials,
                  GageFile& study) {
  analysis::GageReadings& readings = study.readings;
  std::map<std::size_t, std::size_t> row_at;  // by index
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto [there, is_new] = row_at.emplace(index_of(places[i], readings), i);
    if (is_new) continue;
    return table.fault(table.rows[i].line, fmt::format("{} is there twice, first in line {}",
                                                       text_of(places[i], study, trials),
                                                       table.rows[there->second].line));
  }
  std::size_t next = 0;
  for (const auto& [index, row] : row_at) {
    if (index != next) break;
    readings.values.push_back(values[row]);
    ++next;
  }
  if (next == readings.parts * readings.operators * readings.trials) return Done{};
  const ReadingPlace place{next / readings.trials / readings.operators,
                           next / readings.trials % readings.operators, next % readings.trials};
  return hal::formats::bad_file(
      table.file, text_of(place, study, trials) +
                      " is missing: every operator must read every part equally often");
}

}  // namespace

Result<GageFile> read_gage_file(const std::filesystem::path& file) {
  const auto read = read_station_table(file, {"part", "operator", "trial", "value"});
  if (!read) return read.error();
  const StationTable& table = read.value();
  const std::size_t value_column = *table.column("value");
  const auto values = table.numbers(value_column);
  if (!values) return values.error();

  GageFile study;
  study.unit = table.heads[value_column].unit;
  std::vector<std::string> trials;
  std::vector<ReadingPlace> places;
  for (const StationTable::Row& row : table.rows) {
    places.push_back({number_of(row.cells[*table.column("part")], study.parts),
                      number_of(row.cells[*table.column("operator")], study.operators),
                      number_of(row.cells[*table.column("trial")], trials)});
  }
  study.readings.parts = study.parts.size();
  study.readings.operators = study.operators.size();
  study.readings.trials = trials.size();
  if (study.parts.size() < 2 || study.operators.size() < 2 || trials.size() < 2) {
    return hal::formats::bad_file(
        file, fmt::format("{} part(s), {} operator(s) and {} trial(s): a study takes two of each "
                          "or more, and 10 x 3 x 3 tell more",
                          study.parts.size(), study.operators.size(), trials.size()));
  }
  const auto filled = fill(table, places, values.value(), trials, study);
  if (!filled) return filled.error();
  return study;
}

}  // namespace rvbench::bench
