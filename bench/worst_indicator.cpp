#include "bench/worst_indicator.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace rvbench::bench {
namespace {

using analysis::Indicator;

// A channel, or a point as far as its shafts go: one that should show what is asked.
struct Source {
  std::string where;
  const std::vector<Indicator>& indicators;
};

std::vector<Source> sources_of(const JudgedPoint& point, const Measure& measure) {
  const analysis::Examination& seen = point.examination;
  std::vector<Source> sources;
  if (measure.shaft_channels.empty()) {
    for (const analysis::ChannelExamination& channel : seen.channels) {
      sources.push_back({seen.source + ", " + channel.name, channel.indicators});
    }
  }
  if (sources.empty()) sources.push_back({seen.source, seen.indicators});
  return sources;
}

// A record of hysteresis tells nothing of what turns, and the other way round.
bool is_asked(const JudgedPoint& point, const WorstOf& asked) {
  const analysis::Examination& seen = point.examination;
  return point.status == "ok" && seen.of_hysteresis == !asked.measure.phase.empty() &&
         asked.at.includes(point.planned_speed_rpm, seen.load_pct);
}

double value_of(const Indicator& indicator, const WorstOf& asked) {
  if (indicator.measure != asked.measure.name) return not_known;
  if (!asked.of.empty() && asked.of != indicator.of) return not_known;
  return in_unit(indicator.value, indicator.unit, asked.unit);
}

std::string place(const std::string& where, const std::string& of) {
  return of.empty() ? where : where + ", " + of;
}

std::set<std::string> places_in(const Source& source, const WorstOf& asked) {
  std::set<std::string> places;
  for (const Indicator& indicator : source.indicators) {
    if (std::isfinite(value_of(indicator, asked))) places.insert(indicator.of);
  }
  return places;
}

// Where a point lacks what is asked; empty if it has it.
std::string lacks(const std::vector<Source>& sources, const std::set<std::string>& wanted,
                  const WorstOf& asked) {
  std::string first;
  for (const Source& source : sources) {
    const std::set<std::string> has = places_in(source, asked);
    if (!asked.measure.absent_when.empty() && !has.empty()) return "";
    const auto missing =
        std::ranges::find_if(wanted, [&](const std::string& of) { return !has.contains(of); });
    if (first.empty() && missing != wanted.end()) first = place(source.where, *missing);
    if (first.empty() && wanted.empty()) first = source.where;
  }
  return first;
}

void take(WorstIndicator& worst, const Source& source, const WorstOf& asked) {
  for (const Indicator& indicator : source.indicators) {
    const double value = value_of(indicator, asked);
    if (std::isnan(value)) continue;
    const bool better = asked.least ? value >= worst.value : value <= worst.value;
    if (better) continue;  // never of what is not known yet: NaN
    worst.value = value;
    worst.error = in_unit(indicator.error, indicator.unit, asked.unit);
    worst.where = place(source.where, indicator.of);
  }
}

}  // namespace

WorstIndicator worst_indicator(const Judgement& judgement, const WorstOf& asked) {
  std::vector<std::vector<Source>> points;
  for (const JudgedPoint& point : judgement.points) {
    if (is_asked(point, asked)) points.push_back(sources_of(point, asked.measure));
  }
  WorstIndicator worst;
  worst.points = points.size();
  std::set<std::string> wanted;
  for (const std::vector<Source>& sources : points) {
    for (const Source& source : sources) {
      take(worst, source, asked);
      wanted.merge(places_in(source, asked));
    }
  }
  for (const std::vector<Source>& sources : points) {
    std::string where = lacks(sources, wanted, asked);
    if (!where.empty()) worst.lacking.push_back(std::move(where));
  }
  return worst;
}

}  // namespace rvbench::bench
