#include <cmath>

#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"
#include "bench/xml_text.hpp"

namespace rvbench::bench::report {
namespace {

std::string sensitivity_of(const ChannelInfo& info) {
  if (!std::isfinite(info.sensitivity)) return "–";
  return number(info.sensitivity, 6) + " V per " + xml_escaped(info.unit);
}

}  // namespace

// Those of the first record that can be had: all points of a run have the same.
std::string sensors_section(const ReportInput& input) {
  if (!input.load) return "";
  for (std::size_t i = 0; i < input.judgement.points.size(); ++i) {
    const std::optional<Recording> record = input.load(i);
    if (!record) continue;
    std::vector<std::vector<std::string>> rows;
    for (const Channel& channel : record->channels) {
      rows.push_back({xml_escaped(channel.info.name), xml_escaped(channel.info.unit),
                      xml_escaped(channel.info.direction), number(channel.rate_Hz, 6),
                      sensitivity_of(channel.info)});
    }
    return section("Sensors",
                   table({"channel", "unit", "direction", "rate [Hz]", "sensitivity"}, rows));
  }
  return "";
}

}  // namespace rvbench::bench::report
