#include "bench/results/series.hpp"

#include <fmt/format.h>

#include <cmath>

#include "hal/types/measure.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::bench {
namespace {

// With a bare column beside MAX() or MIN(), SQLite takes it from the row of the extreme: its
// documentation of SELECT, "Bare columns in an aggregate query". CROSS JOIN keeps the order of the
// tables: from a quantity to its extremes, which lie together.
constexpr const char* at_all_points =
    "SELECT {1}({0}), quantities.unit, quantities.of_what, {0}_point, extremes.channel, "
    "runs.folder, runs.serial, runs.started_utc, runs.verdict "
    "FROM quantities CROSS JOIN extremes ON extremes.quantity = quantities.id "
    "CROSS JOIN runs ON runs.id = extremes.run "
    "WHERE quantities.measure = ?1 AND (?2 = '' OR quantities.of_what = ?2) "
    "AND (?3 = '' OR extremes.channel = ?3) AND (?4 = '' OR runs.serial = ?4) "
    "GROUP BY runs.id ORDER BY runs.started_utc, runs.folder";

// From the points that are asked for, run by run, to what they show: a twentieth of all values.
constexpr const char* at_some_points =
    "SELECT {}(indicators.value), quantities.unit, quantities.of_what, indicators.point, "
    "indicators.channel, runs.folder, runs.serial, runs.started_utc, runs.verdict "
    "FROM points CROSS JOIN quantities CROSS JOIN indicators "
    "ON indicators.quantity = quantities.id AND indicators.run = points.run "
    "AND indicators.point = points.point CROSS JOIN runs ON runs.id = points.run "
    "WHERE quantities.measure = ?1 AND (?2 = '' OR quantities.of_what = ?2) "
    "AND (?3 IS NULL OR abs(points.speed_rpm - ?3) < 1e-6) "
    "AND (?4 IS NULL OR abs(points.load_pct - ?4) < 1e-6) "
    "AND (?5 = '' OR indicators.channel = ?5) AND (?6 = '' OR runs.serial = ?6) "
    "GROUP BY points.run ORDER BY runs.started_utc, runs.folder";

constexpr const char* depths =
    "SELECT MAX(CASE WHEN standing != 'not_shown' THEN depth WHEN ?3 THEN depth_high ELSE 0 END), "
    "'1', component, -1, '', "
    "runs.folder, runs.serial, runs.started_utc, runs.verdict "
    "FROM findings JOIN runs ON runs.id = findings.run WHERE (?1 = '' OR component = ?1) "
    "AND (?2 = '' OR runs.serial = ?2) AND (standing != 'not_shown' OR depth_high <= depth_limit) "
    "GROUP BY runs.id ORDER BY runs.started_utc, runs.folder";

SqlStatement query_of(const SqliteFile& file, const SeriesOf& asked) {
  if (asked.measure == measure_names::modulation_depth) {
    SqlStatement query(file, depths);
    query.bind(asked.of, asked.serial, static_cast<int>(asked.may_be_hid));
    return query;
  }
  const char* worst = asked.least ? "MIN" : "MAX";
  if (asked.at.is_any()) {
    const std::string sql = fmt::format(at_all_points, asked.least ? "least" : "greatest", worst);
    SqlStatement query(file, sql.c_str());
    query.bind(asked.measure, asked.of, asked.channel, asked.serial);
    return query;
  }
  SqlStatement query(file, fmt::format(at_some_points, worst).c_str());
  query.bind(asked.measure, asked.of, asked.at.speed_rpm.value_or(not_known),
             asked.at.load_pct.value_or(not_known), asked.channel, asked.serial);
  return query;
}

}  // namespace

Result<std::vector<RunValue>> read_series(const SqliteFile& file, const SeriesOf& asked) {
  SqlStatement query = query_of(file, asked);
  std::vector<RunValue> values;
  while (query.next()) {
    values.push_back({.folder = query.text(5),
                      .serial = query.text(6),
                      .started_utc = query.text(7),
                      .verdict = query.text(8),
                      .value = query.number(0),
                      .unit = query.text(1),
                      .of = query.text(2),
                      .point = static_cast<int>(query.integer(3)),
                      .channel = query.text(4)});
  }
  if (!query.is_done()) return file.failure("cannot be read");
  return values;
}

}  // namespace rvbench::bench
