#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "hal/formats/apply_units.hpp"
#include "hal/formats/column_name.hpp"
#include "hal/formats/even_grid.hpp"
#include "hal/formats/foreign_file.hpp"
#include "hal/formats/format.hpp"
#include "hal/formats/start_time.hpp"
#include "hal/formats/table/hour_columns.hpp"
#include "hal/formats/table/settings.hpp"
#include "hal/formats/table/table.hpp"
#include "hal/formats/table/text.hpp"
#include "hal/formats/time_column.hpp"

namespace rvbench::hal::formats {
namespace {

constexpr std::size_t most_text_above = 600;  // characters that are kept

using Fault = std::optional<std::string>;

// Two columns of whole numbers without names may be one of numbers with a decimal comma.
bool may_be_halves(const Table& table) {
  const bool is_named = table.layout.head_line > 0;
  return !is_named && table.layout.separator == ',' && table.columns.size() == 2 &&
         std::ranges::all_of(table.columns, [](const Table::Column& column) {
           return (column.samples.array() == column.samples.array().floor()).all();
         });
}

bool is_called_index(const std::string& name) {
  constexpr std::array<std::string_view, 12> names = {
      "", "index", "no", "no.", "nr", "nr.", "count", "#", "n", "sample", "samples", "row"};
  return std::ranges::find(names, lower_case(name)) != names.end();
}

bool counts_rows(const Eigen::VectorXd& x) {
  if (x.size() < 2 || (x[0] != 0 && x[0] != 1)) return false;
  return (x.tail(x.size() - 1) - x.head(x.size() - 1) - Eigen::VectorXd::Ones(x.size() - 1))
      .isZero(0);
}

// Leaves out columns that count the rows of a table with names, and blank ones that nobody named. A
// channel that is named and blank has lost its samples, and stays.
void leave_out(Table& table, std::vector<std::string>& notes) {
  const bool is_named = table.layout.head_line > 0;
  std::erase_if(table.columns, [&](const Table::Column& column) {
    const bool has_name = !column.name.empty() && lower_case(column.name) != "comment";
    if (!has_name && column.samples.array().isNaN().all()) return true;
    if (!is_named || !is_called_index(column.name) || !counts_rows(column.samples)) return false;
    notes.push_back(fmt::format("column \"{}\" counts the rows: left out", column.name));
    return true;
  });
}

Fault name_columns(Table& table) {
  const bool is_named = table.layout.head_line > 0;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    std::string& name = table.columns[i].name;
    if (!is_named && name.empty()) name = fmt::format("column_{}", i + 1);
    if (name.empty())
      return fmt::format("{}:{}: a channel without name", table.layout.head_line, i + 1);
    if (std::ranges::find(names, name) != names.end()) {
      return fmt::format("{}:{}: channel \"{}\" is there twice", table.layout.head_line, i + 1,
                         name);
    }
    names.push_back(name);
  }
  return std::nullopt;
}

// The times of a table's rows become a column that is named as time.
Fault add_clock_column(Table& table, const TableHints& hints, Recording& recording) {
  if (!table.clock) return std::nullopt;
  auto times = table.clock->times(hints.dates);
  if (auto* fault = std::get_if<std::string>(&times)) return std::move(*fault);
  auto& found = std::get<ClockRows::Times>(times);
  note_start(found.start_utc_s, recording);
  table.columns.insert(table.columns.begin(), {"time [s]", "", std::move(found.since_first_s)});
  table.clock.reset();
  return std::nullopt;
}

// A first column whose steps are the interval that the settings state is the time in s, whatever
// its name: LabVIEW calls it X_Value.
void name_time(Table& table, const TableSettings& settings) {
  if (!settings.rate_Hz || table.columns.size() < 2) return;
  Table::Column& first = table.columns.front();
  const std::optional<double> step_s = even_step(first.samples);
  if (step_s && std::abs(*step_s * *settings.rate_Hz - 1) < 1e-3)
    first = {"time [s]", "", first.samples};
}

// A unit that the row of units or a line above the table states, unless the name itself has one.
void state_units_in_names(Table& table, const TableSettings& settings) {
  std::vector<Table::Column*> signals;
  for (Table::Column& column : table.columns) {
    if (!time_unit_s(column.name)) signals.push_back(&column);
    if (!column.unit.empty()) column.name += " [" + column.unit + "]";
  }
  const bool one_for_all = settings.units.size() == 1 && signals.size() == 1;
  if (!one_for_all && settings.units.size() != signals.size()) return;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    if (!column_name(signals[i]->name).unit.empty() || settings.units[i].empty()) continue;
    signals[i]->name += " [" + settings.units[i] + "]";
  }
}

// A clock keeps its head as it is: readers recognise it by name.
bool is_clock(const Channel& column) {
  const std::string& head = column.info.name;
  return time_unit_s(head) || (seconds_per_unit(head) && only_rises(column.samples));
}

// Takes the units out of the heads. Names that would be the same without stay as they are.
void state_units(Recording& recording) {
  std::vector<ColumnName> heads;
  for (const Channel& column : recording.channels) {
    const std::string& head = column.info.name;
    heads.push_back(is_clock(column) ? ColumnName{head, ""} : column_name(head));
  }
  for (std::size_t i = 0; i < heads.size(); ++i) {
    Channel& channel = recording.channels[i];
    if (std::ranges::count(heads, heads[i].name, &ColumnName::name) == 1) {
      channel.info.name = heads[i].name;
    }
    apply_unit(heads[i].unit, channel, recording.notes);
  }
}

void note_above(const TableLayout& layout, Recording& recording) {
  if (layout.above.empty()) return;
  std::string text = fmt::format("{}", fmt::join(layout.above, " | "));
  if (text.size() > most_text_above) text = text.substr(0, most_text_above) + "...";
  recording.notes.push_back(fmt::format("the table begins at line {}; above it: {}",
                                        layout.head_line > 0 ? layout.head_line : layout.first_line,
                                        text));
}

void set_rate_by_settings(const TableSettings& settings, Recording& recording) {
  const bool has_rate = std::ranges::any_of(
      recording.channels, [](const Channel& channel) { return channel.rate_Hz > 0; });
  if (!settings.rate_Hz || has_rate) return;
  for (Channel& channel : recording.channels) channel.rate_Hz = *settings.rate_Hz;
  recording.notes.push_back(
      fmt::format("rate {:.6g} Hz from \"{}\"", *settings.rate_Hz, settings.rate_line));
}

bool is_csv(std::string_view head) {
  return is_text(head) && head.find_first_of("0123456789") != head.npos;
}

// What a recording takes over from a table; the fault of one that cannot be understood.
Fault fill(Table& table, const TableHints& hints, Recording& recording) {
  if (may_be_halves(table)) {
    if (table.half_line > 0) {
      return fmt::format(
          "{}:2: begins with 0: if numbers have a decimal comma, put \"\" around "
          "them; if not, give the columns names",
          table.half_line);
    }
    recording.notes.emplace_back(
        "taken as two columns of whole numbers, not as one with a decimal comma");
  }
  if (table.numbers.decimal == ',') recording.notes.emplace_back("numbers have a decimal comma");
  if (table.numbers.thousands != '\0') {
    recording.notes.push_back(fmt::format("numbers have a {} between thousands",
                                          table.numbers.thousands == ',' ? "comma" : "point"));
  }
  note_above(table.layout, recording);
  bool has_names = table.layout.head_line > 0;
  leave_out(table, recording.notes);
  if (join_hour_columns(table)) {
    recording.notes.emplace_back("hours, minutes and seconds are one column of time");
  }
  if (Fault fault = add_clock_column(table, hints, recording)) return fault;
  if (Fault fault = name_columns(table)) return fault;
  const TableSettings settings = settings_in(table.layout.above, table.layout.separator);
  name_time(table, settings);
  state_units_in_names(table, settings);
  for (Table::Column& column : table.columns) {
    Channel channel;
    channel.info.name = column.name;
    channel.samples = std::move(column.samples);
    recording.channels.push_back(std::move(channel));
  }
  has_names = has_names || std::ranges::any_of(recording.channels, [](const Channel& c) {
                return time_unit_s(c.info.name).has_value();
              });
  set_rate_by_time_column(has_names, recording);
  set_rate_by_settings(settings, recording);
  if (!std::isnan(settings.speed_rpm)) recording.speed_rpm = settings.speed_rpm;
  state_units(recording);
  return std::nullopt;
}

Result<std::vector<Recording>> read_csv(const std::filesystem::path& file,
                                        const TableHints& hints) {
  const auto text = text_of(file);
  if (!text) return text.error();
  auto table = read_table(text.value(), hints);
  if (const auto* fault = std::get_if<std::string>(&table)) return bad_file(file, *fault);
  Recording recording;
  recording.source = file.string();
  recording.status = "ok";
  if (const Fault fault = fill(std::get<Table>(table), hints, recording))
    return bad_file(file, *fault);
  return alone(std::move(recording));
}

}  // namespace

Format csv_format() { return {"CSV", is_csv, {".csv", ".txt"}, read_csv}; }

}  // namespace rvbench::hal::formats
