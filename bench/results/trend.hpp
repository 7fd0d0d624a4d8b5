#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/theil_sen.hpp"
#include "bench/results/series.hpp"

namespace rvbench::bench {

/// One indicator over the runs.
struct Trend {
  SeriesOf asked;
  std::string unit;                                ///< of all values
  std::vector<RunValue> values;                    ///< oldest first
  std::optional<analysis::SlopeOverTime> per_day;  ///< nothing: see why_not
  std::string why_not;                             ///< why there is no slope; empty if there is one
};

/// Speed and load of "1210/50"; nothing of any other text, or of what no plan can set.
std::optional<SetPoint> point_of_text(const std::string& text);

/// Draws the line of the newest values, at most analysis::most_for_slope. Values of runs whose time
/// nobody can read, or in another unit than the newest, are left out.
/// Units   of the values, per day. Errors  none thrown. Source  analysis::theil_sen()
Trend trend_of(SeriesOf asked, std::vector<RunValue> values);

/// "rises by 0.012 g per 30 days (95 %: 0.008 to 0.017)", or that no trend can be told and why.
std::string trend_sentence(const Trend& trend);

/// "acceleration_peak of sun-planet mesh, 1210 rpm / 50 %, accel_1x, unit A17"
std::string trend_title(const Trend& trend);

std::string trend_to_json(const Trend& trend);

/// A table with the values, a strip that shows them as one row of bars, and the sentence.
std::string trend_text(const Trend& trend);

/// trend.html: the values as a plot over time, the line and its sentence, the table.
std::string make_trend_page(const Trend& trend);

/// The values as one character each, ▁ the least and █ the greatest; of more values than columns
/// the greatest of each stretch. Empty without values.
std::string strip_of(const std::vector<double>& values, std::size_t columns);

}  // namespace rvbench::bench
