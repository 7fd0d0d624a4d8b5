#include "analysis/compare/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "analysis/compare/change_test.hpp"
#include "analysis/compare/compared_channels.hpp"
#include "analysis/compare/false_discovery.hpp"
#include "analysis/compare/scatter.hpp"
#include "analysis/statistics.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

constexpr double same_length = 0.1;      // relative: longer records have higher peaks
constexpr double same_speed = 1e-2;      // relative
constexpr double rounding_dB2 = 1e-18;   // levels that were measured twice differ by more
constexpr double class_of_lines_dB = 6;  // that are alike in scatter: it follows from the noise

// A change and what it was estimated from.
struct Cell {
  Change change;
  std::size_t values_a = 0, values_b = 0;
  Scatter scatter;
  double above_floor_dB = not_known;
};

struct Levels {
  std::vector<double> whole_dB;                 // of repeats
  std::vector<double> parts_dB;                 // of the first
  std::vector<double> p_values, part_p_values;  // of repeats
  double above_floor_dB = 0;                    // mean
  bool taken = false;                           // in some record
};

Levels levels_of(const std::vector<const ChannelLevels*>& repeats, std::size_t quantity) {
  Levels levels;
  for (const ChannelLevels* one : repeats) {
    const Level& level = one->levels[quantity];
    levels.taken |= level.taken;
    if (!std::isfinite(level.whole_dB)) continue;
    levels.whole_dB.push_back(level.whole_dB);
    levels.above_floor_dB += level.above_floor_dB;
    levels.p_values.push_back(level.p_value);
    levels.part_p_values.push_back(level.part_p_value);
  }
  const Eigen::VectorXd& parts = repeats.front()->levels[quantity].parts_dB;
  levels.parts_dB.assign(parts.data(), parts.data() + parts.size());
  levels.above_floor_dB /= static_cast<double>(std::max<std::size_t>(levels.whole_dB.size(), 1));
  return levels;
}

double mean(const std::vector<double>& x) {
  double sum = 0;
  for (const double v : x) sum += v;
  return sum / static_cast<double>(x.size());
}

void hold(const std::vector<double>& a, const std::vector<double>& b, ScatterSource source,
          Cell& cell) {
  cell.change.source = source;
  cell.change.change_dB = mean(b) - mean(a);
  cell.values_a = a.size();
  cell.values_b = b.size();
  cell.scatter = pooled_scatter(a, b);
  if (cell.scatter.variance > rounding_dB2) return;
  cell.change.source = ScatterSource::none;
  cell.scatter = {};
}

std::vector<double> joined(std::vector<double> a, const std::vector<double>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

bool is_seen(const std::vector<double>& of_line, double of_part, const CompareOptions& options) {
  return combined_p_value(of_line) <= options.seen_p && of_part <= options.found_p;
}

// Where the line stands out of the noise. A sum over both sides does not know which is higher. Of
// where a part's peaks lie repeats are one witness, and A and B no two: they hear the same.
void look_for_line(const Levels& a, const Levels& b, const CompareOptions& options,
                   Change& change) {
  const double of_a = median(a.part_p_values), of_b = median(b.part_p_values);
  change.seen_a = is_seen(a.p_values, of_a, options);
  change.seen_b = is_seen(b.p_values, of_b, options);
  change.seen = is_seen(joined(a.p_values, b.p_values), 2 * std::min(of_a, of_b), options);
}

// The quantity is in neither's band, or only in one's, if either has no level that is its own.
bool make_cell(const ChannelPair& pair, const Quantity& quantity, const CompareOptions& options,
               Cell& cell) {
  const Levels a = levels_of(pair.a, cell.change.quantity);
  const Levels b = levels_of(pair.b, cell.change.quantity);
  if (a.whole_dB.empty() || b.whole_dB.empty()) {
    cell.change.taken = a.taken || b.taken;
    return cell.change.taken;
  }
  cell.change.a_dB = mean(a.whole_dB);
  cell.change.b_dB = mean(b.whole_dB);
  cell.change.seen_a = cell.change.seen_b = cell.change.seen = true;
  if (quantity.is_line()) look_for_line(a, b, options, cell.change);
  cell.above_floor_dB = (a.above_floor_dB + b.above_floor_dB) / 2;
  if (a.whole_dB.size() + b.whole_dB.size() > 2) {
    hold(a.whole_dB, b.whole_dB, ScatterSource::repeats, cell);
  } else if (!a.parts_dB.empty() && !b.parts_dB.empty()) {
    hold(a.parts_dB, b.parts_dB, ScatterSource::parts, cell);
  } else {
    hold(a.whole_dB, b.whole_dB, ScatterSource::none, cell);
  }
  return true;
}

bool is_of_length(std::size_t quantity) {
  return quantity == static_cast<std::size_t>(LevelIndex::peak) ||
         quantity == static_cast<std::size_t>(LevelIndex::crest_factor);
}

// Peaks of records of different length are not alike.
bool has_one_length(const ChannelPair& pair) {
  double shortest = pair.a.front()->length_s, longest = shortest;
  for (const auto* side : {&pair.a, &pair.b}) {
    for (const ChannelLevels* one : *side) {
      shortest = std::min(shortest, one->length_s);
      longest = std::max(longest, one->length_s);
    }
  }
  return longest - shortest <= same_length * longest;
}

double measured_speed(const PointRecords& point, const std::vector<RecordLevels>& records) {
  double sum = 0;
  for (const std::size_t i : point.records) sum += records[i].measured_rpm;
  return sum / static_cast<double>(point.records.size());
}

// Orders follow the speed; resonances do not.
void tell_speeds(const MatchedPoint& point, const std::vector<RecordLevels>& a,
                 const std::vector<RecordLevels>& b, std::vector<NotCompared>& left_out) {
  const double of_a = measured_speed(point.a, a), of_b = measured_speed(point.b, b);
  if (!(std::abs(of_a - of_b) > same_speed * std::abs(of_a))) return;
  left_out.push_back(
      {point_text(point.a.speed_rpm, point.a.load_pct),
       fmt::format("compared, but A turned at {:.1f} rpm and B at {:.1f} rpm: what changed may be "
                   "the speed",
                   of_a, of_b)});
}

void tell_same(const std::vector<RecordLevels>& a, const std::vector<RecordLevels>& b,
               Comparison& comparison) {
  std::vector<std::size_t> compared;  // of B
  for (const MatchedPoint& point : comparison.points) {
    comparison.records_a += point.a.records.size();
    comparison.records_b += point.b.records.size();
    compared.insert(compared.end(), point.b.records.begin(), point.b.records.end());
  }
  comparison.same_in_both = same_records(a, b);
  std::erase_if(comparison.same_in_both, [&](const SameRecord& same) {
    return std::ranges::find(compared, same.b) == compared.end();
  });
  for (const SameRecord& same : comparison.same_in_both) {
    comparison.left_out.push_back(
        {b[same.b].source, "the same recording as " + a[same.a].source +
                               " of A: nothing can have changed between them"});
  }
}

std::size_t index_of(const ChannelInfo& channel, std::vector<ChannelInfo>& all) {
  const auto known = std::ranges::find(all, channel.name, &ChannelInfo::name);
  if (known != all.end()) return static_cast<std::size_t>(known - all.begin());
  all.push_back(channel);
  return all.size() - 1;
}

void add_unparted(const std::vector<SignaturePair>& more, std::vector<SignaturePair>& all) {
  for (const SignaturePair& pair : more) {
    if (std::ranges::find(all, pair) == all.end()) all.push_back(pair);
  }
}

void add_cells(std::size_t point, const ChannelPair& pair, Comparison& comparison,
               std::vector<Cell>& cells) {
  for (const auto* side : {&pair.a, &pair.b}) {
    for (const ChannelLevels* one : *side) add_unparted(one->unparted, comparison.unparted);
  }
  const std::size_t channel = index_of(pair.a.front()->info, comparison.channels);
  const bool one_length = has_one_length(pair);
  if (!one_length) {
    const PointRecords& at = comparison.points[point].a;
    comparison.left_out.push_back({point_text(at.speed_rpm, at.load_pct) + ", " + pair.name,
                                   "peak and crest factor: the records differ in length"});
  }
  for (std::size_t q = 0; q < comparison.quantities.size(); ++q) {
    if (!one_length && is_of_length(q)) continue;
    Cell cell;
    cell.change.point = point;
    cell.change.channel = channel;
    cell.change.quantity = q;
    if (make_cell(pair, comparison.quantities[q], comparison.options, cell)) cells.push_back(cell);
  }
}

// Cells whose scatter is of one kind.
using Kind = std::tuple<ScatterSource, std::size_t, int>;

Kind kind_of(const Cell& cell, const std::vector<Quantity>& quantities) {
  if (!quantities[cell.change.quantity].is_line()) {
    return {cell.change.source, cell.change.quantity, 0};
  }
  const double height = std::isfinite(cell.above_floor_dB) ? cell.above_floor_dB : 0;
  return {cell.change.source, quantities.size(), int(std::floor(height / class_of_lines_dB))};
}

void draw_scatter_together(const std::vector<Quantity>& quantities, std::vector<Cell>& cells) {
  std::map<Kind, std::vector<std::size_t>> kinds;
  for (std::size_t i = 0; i < cells.size(); ++i) kinds[kind_of(cells[i], quantities)].push_back(i);
  for (const auto& [kind, members] : kinds) {
    std::vector<Scatter> scatter;
    for (const std::size_t i : members) scatter.push_back(cells[i].scatter);
    scatter = drawn_together(std::move(scatter));
    for (std::size_t k = 0; k < members.size(); ++k) cells[members[k]].scatter = scatter[k];
  }
}

ChangeTest test_of(const Cell& cell, double least_dB) {
  return test_change(cell.change.change_dB, double(cell.values_a), double(cell.values_b),
                     cell.scatter, least_dB);
}

// The p-value up to which one more would have been called, beside those that were.
double called_p(const std::vector<double>& adjusted, double false_share) {
  double asked = 0, called = 0;
  for (const double p : adjusted) {
    asked += std::isnan(p) ? 0 : 1;
    called += p <= false_share ? 1 : 0;
  }
  return false_share * std::min(1.0, (called + 1) / std::max(asked, 1.0));
}

ChangeWord word_for(const Change& change, const CompareOptions& options) {
  if (change.adjusted_p <= options.false_share) return ChangeWord::changed;
  return change.detectable_dB <= options.blind_dB ? ChangeWord::not_changed
                                                  : ChangeWord::cannot_tell;
}

// Cells that pay for each other.
void judge(const CompareOptions& options, const std::vector<Cell*>& cells) {
  std::vector<double> p_values;
  for (Cell* cell : cells) {
    if (cell->scatter.freedom > 0) cell->change.p_value = test_of(*cell, options.least_dB).p_value;
    p_values.push_back(cell->change.p_value);
  }
  const std::vector<double> adjusted = adjusted_p_values(p_values);
  const double p = called_p(adjusted, options.false_share);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    Change& change = cells[i]->change;
    change.adjusted_p = adjusted[i];
    change.freedom = cells[i]->scatter.freedom;
    if (!(change.freedom > 0)) continue;
    const ChangeTest test = test_of(*cells[i], options.least_dB);
    change.uncertainty_dB = half_width(test);
    change.detectable_dB = detectable_change(test, options.least_dB, p);
    change.word = word_for(change, options);
  }
}

std::vector<Cell*> cells_by_sight(bool seen, std::vector<Cell>& cells) {
  std::vector<Cell*> chosen;
  for (Cell& cell : cells) {
    if (cell.change.seen == seen) chosen.push_back(&cell);
  }
  return chosen;
}

void check(const CompareOptions& options) {
  constexpr Require require{"compare"};
  require(options.least_dB >= 0 && std::isfinite(options.least_dB), "least_dB must be 0 or above");
  require(options.false_share > 0 && options.false_share < 1, "false_share must be in (0, 1)");
  require(options.blind_dB > options.least_dB, "blind_dB must be above least_dB");
  require(options.seen_p > 0 && options.seen_p < 1, "seen_p must be in (0, 1)");
  require(options.found_p > 0 && options.found_p < 1, "found_p must be in (0, 1)");
}

}  // namespace

Comparison compare(const std::vector<RecordLevels>& a, const std::vector<RecordLevels>& b,
                   const std::vector<Quantity>& quantities, const CompareOptions& options) {
  check(options);
  MatchedPoints matched = match_points(a, b);
  Comparison comparison{options,
                        quantities,
                        {},
                        std::move(matched.both),
                        std::move(matched.only_a),
                        std::move(matched.only_b),
                        {},
                        {},
                        {},
                        {},
                        {},
                        0};
  for (const auto* side : {&a, &b}) {
    for (const RecordLevels& record : *side) {
      comparison.left_out.insert(comparison.left_out.end(), record.left_out.begin(),
                                 record.left_out.end());
      if (record.too_short) comparison.too_short.push_back(*record.too_short);
    }
  }
  tell_same(a, b, comparison);
  std::vector<Cell> cells;
  for (std::size_t p = 0; p < comparison.points.size(); ++p) {
    const MatchedPoint point = comparison.points[p];
    tell_speeds(point, a, b, comparison.left_out);
    for (const ChannelPair& pair : compared_channels(point, a, b, comparison.left_out)) {
      add_cells(p, pair, comparison, cells);
    }
  }
  draw_scatter_together(quantities, cells);
  for (const bool seen : {true, false}) judge(options, cells_by_sight(seen, cells));
  for (const Cell& cell : cells) comparison.changes.push_back(cell.change);
  return comparison;
}

}  // namespace rvbench::analysis
