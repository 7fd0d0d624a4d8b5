#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/station/capability.hpp"
#include "analysis/station/control_chart.hpp"
#include "analysis/station/ewma_chart.hpp"
#include "bench/console.hpp"
#include "bench/station/chart_file.hpp"

namespace rvbench::bench {

/// What was charted, and what came of it.
struct ChartAnswer {
  std::string file;
  ChartFile data;
  analysis::ControlChart chart;
  analysis::EwmaChart ewma;
  analysis::SpecificationLimits limits;
  std::optional<analysis::Capability> capability;  ///< where a limit is given

  bool is_in_control() const { return chart.is_in_control() && ewma.out.empty(); }
};

/// Something that speaks against chance, at one point.
struct ChartEvent {
  Eigen::Index at = 0;
  std::string rule;     ///< "nelson_3", "moving_range", "ewma"
  std::string meaning;  ///< "6 in a row rise or fall"
};

/// All of them, by point.
std::vector<ChartEvent> events_of(const ChartAnswer& answer);

std::string spoken_control(const ChartAnswer& answer);  ///< "IN CONTROL", "OUT OF CONTROL"

/// What fired first, and how often anything did.
std::string chart_sentence(const ChartAnswer& answer);

/// What the chart and its indices are worth: a line each; empty if there is nothing to say.
std::vector<std::string> chart_warnings(const ChartAnswer& answer);

/// "Cpk 1.33 (95 %: 1.02 to 1.64)", one of each index; empty without limits.
std::vector<std::string> capability_lines(const ChartAnswer& answer);

void print_chart(Console& console, const ChartAnswer& answer);

}  // namespace rvbench::bench
