#include "analysis/compare/compared_channels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace rvbench::analysis {
namespace {

constexpr double rate_tolerance = 1e-3;  // relative

using ByName = std::map<std::string, std::vector<const ChannelLevels*>>;

ByName by_name(const PointRecords& point, const std::vector<RecordLevels>& records) {
  ByName all;
  for (const std::size_t i : point.records) {
    for (const ChannelLevels& channel : records[i].channels) {
      all[channel.info.name].push_back(&channel);
    }
  }
  return all;
}

// "only A has it", unless the other one has it and it is spoilt.
std::string why_missing(const std::string& name, const char* one, const char* other,
                        const PointRecords& point, const std::vector<RecordLevels>& of_other) {
  for (const std::size_t i : point.records) {
    for (const NotCompared& out : of_other[i].left_out) {
      if (out.where == of_other[i].source + ", " + name) {
        return fmt::format("that of {} cannot be trusted", other);
      }
    }
  }
  return fmt::format("only {} has it", one);
}

// A file that does not state it does not contradict.
bool differ(const std::string& a, const std::string& b) {
  return !a.empty() && !b.empty() && a != b;
}

std::string why_not(const ChannelLevels& a, const ChannelLevels& b) {
  if (differ(a.info.unit, b.info.unit)) {
    return fmt::format("in {} in A and {} in B", a.info.unit, b.info.unit);
  }
  if (differ(a.info.direction, b.info.direction)) {
    return fmt::format("points to {} in A and {} in B: mounted another way", a.info.direction,
                       b.info.direction);
  }
  if (std::abs(a.rate_Hz - b.rate_Hz) > rate_tolerance * a.rate_Hz) {
    return fmt::format("sampled at {:g} Hz in A and {:g} Hz in B: its band is another one",
                       a.rate_Hz, b.rate_Hz);
  }
  return "";
}

// Of all repeats, each against the first of A.
std::string why_not(const ChannelPair& pair) {
  for (const auto* side : {&pair.a, &pair.b}) {
    for (const ChannelLevels* one : *side) {
      if (const std::string why = why_not(*pair.a.front(), *one); !why.empty()) return why;
    }
  }
  return "";
}

std::size_t count_stated(const std::vector<const ChannelLevels*>& side,
                         std::string ChannelInfo::*what) {
  return static_cast<std::size_t>(
      std::ranges::count_if(side, [&](const auto* one) { return !(one->info.*what).empty(); }));
}

// What some state and others do not is taken to be the same, and that is told.
void tell_unstated(const ChannelPair& pair, const std::string& where,
                   std::vector<NotCompared>& left_out) {
  const auto tell = [&](const char* name, std::string ChannelInfo::*what) {
    const std::size_t stated = count_stated(pair.a, what) + count_stated(pair.b, what);
    if (stated == 0 || stated == pair.a.size() + pair.b.size()) return;
    left_out.push_back({where, fmt::format("compared, but not every file states its {}: it is "
                                           "taken to be the same in A and B",
                                           name)});
  };
  tell("unit", &ChannelInfo::unit);
  tell("direction", &ChannelInfo::direction);
}

}  // namespace

std::string point_text(double speed_rpm, double load_pct) {
  const std::string speed =
      std::isfinite(speed_rpm) ? fmt::format("{:.0f} rpm", speed_rpm) : "speed not known";
  return std::isfinite(load_pct) ? fmt::format("{}, {:.0f} % load", speed, load_pct) : speed;
}

std::vector<ChannelPair> compared_channels(const MatchedPoint& point,
                                           const std::vector<RecordLevels>& a,
                                           const std::vector<RecordLevels>& b,
                                           std::vector<NotCompared>& left_out) {
  ByName of_a = by_name(point.a, a), of_b = by_name(point.b, b);
  const std::string where = point_text(point.a.speed_rpm, point.a.load_pct) + ", ";
  std::vector<ChannelPair> pairs;
  for (auto& [name, channels] : of_a) {
    const auto other = of_b.find(name);
    if (other == of_b.end()) {
      left_out.push_back({where + name, why_missing(name, "A", "B", point.b, b)});
      continue;
    }
    ChannelPair pair{name, std::move(channels), std::move(other->second)};
    of_b.erase(other);
    if (const std::string why = why_not(pair); !why.empty()) {
      left_out.push_back({where + name, why});
    } else {
      tell_unstated(pair, where + name, left_out);
      pairs.push_back(std::move(pair));
    }
  }
  for (const auto& [name, channels] : of_b) {
    left_out.push_back({where + name, why_missing(name, "B", "A", point.a, a)});
  }
  return pairs;
}

}  // namespace rvbench::analysis
