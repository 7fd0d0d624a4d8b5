#include "analysis/order/tachometer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "analysis/order/natural_spline.hpp"
#include "analysis/statistics.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

constexpr std::size_t fewest_pulses = 8;
constexpr std::size_t neighbours = 5;  // intervals to each side, that agree on one
constexpr double too_soon = 0.6;       // of an interval
constexpr double too_late = 1.6;
constexpr double off_whole = 0.3;  // of an interval: a gap that fits no whole number of them
constexpr double most_faults = 0.05;
constexpr int steps_per_interval = 16;

// What the intervals around the one before pulse i agree on. Pulses left out or lost are among
// them: the median does not care about a few.
double usual_interval(const std::vector<double>& times_s, std::size_t i) {
  const std::size_t from = i > neighbours ? i - neighbours : 1;
  const std::size_t to = std::min(i + neighbours, times_s.size() - 1);
  std::vector<double> intervals;
  for (std::size_t k = from; k <= to; ++k) intervals.push_back(times_s[k] - times_s[k - 1]);
  return median(std::move(intervals));
}

// The pulses that count: each with the number of its mark.
struct Marks {
  std::vector<double> times_s, numbers;
};

// Of the last pulse that counts and the next, the one that comes when a pulse was due stays.
double leave_out_extra(Marks& marks, double next_s, double usual_s) {
  const std::size_t last = marks.times_s.size() - 1;
  if (last == 0) return next_s;
  const double due_s =
      marks.times_s[last - 1] + usual_s * (marks.numbers[last] - marks.numbers[last - 1]);
  if (std::abs(next_s - due_s) < std::abs(marks.times_s[last] - due_s)) {
    std::swap(marks.times_s[last], next_s);
  }
  return next_s;
}

std::string count_marks(const std::vector<double>& times_s, Marks& marks,
                        std::vector<TachometerFault>& faults) {
  marks.times_s = {times_s.front()};
  marks.numbers = {0};
  for (std::size_t i = 1; i < times_s.size(); ++i) {
    const double usual_s = usual_interval(times_s, i);
    const double interval_s = times_s[i] - marks.times_s.back();
    const double intervals = interval_s / usual_s;
    if (intervals < too_soon) {
      const double extra_s = leave_out_extra(marks, times_s[i], usual_s);
      faults.push_back({TachometerFault::Kind::extra, extra_s, 1});
      continue;
    }
    const double whole = intervals < too_late ? 1 : std::round(intervals);
    if (whole > 1 && std::abs(intervals - whole) > off_whole) {
      return fmt::format("the {:.3g} s before {:.6g} s are {:.2f} intervals: no whole number",
                         interval_s, times_s[i], intervals);
    }
    if (whole > 1) {
      faults.push_back({TachometerFault::Kind::missing, marks.times_s.back(),
                        static_cast<int>(std::lround(whole)) - 1});
    }
    marks.times_s.push_back(times_s[i]);
    marks.numbers.push_back(marks.numbers.back() + whole);
  }
  return {};
}

std::optional<ShaftAngle> angle_through(const Marks& marks, int pulses_per_turn) {
  const auto n = static_cast<Eigen::Index>(marks.times_s.size());
  const Eigen::Map<const Eigen::VectorXd> at(marks.times_s.data(), n);
  const Eigen::Map<const Eigen::VectorXd> numbers(marks.numbers.data(), n);
  const NaturalSpline turns(at, numbers / pulses_per_turn);
  const auto steps =
      static_cast<Eigen::Index>(steps_per_interval * std::lround(marks.numbers.back()));
  const double step_s = (at[n - 1] - at[0]) / static_cast<double>(steps);
  Eigen::VectorXd even(steps + 1);
  for (Eigen::Index i = 0; i <= steps; ++i) even[i] = turns(at[0] + double(i) * step_s);
  return ShaftAngle::of_turns(std::move(even), at[0], step_s);
}

}  // namespace

TachometerReading read_tachometer(const std::vector<double>& pulse_times_s, int pulses_per_turn) {
  constexpr Require require{"read_tachometer"};
  require(pulses_per_turn >= 1, "pulses_per_turn must be at least 1");
  require(std::ranges::all_of(pulse_times_s, [](double t) { return std::isfinite(t); }),
          "a time is not finite");
  TachometerReading reading;
  if (pulse_times_s.size() < fewest_pulses) {
    reading.why_not =
        fmt::format("{} pulses, at least {} are needed", pulse_times_s.size(), fewest_pulses);
    return reading;
  }
  if (std::ranges::adjacent_find(pulse_times_s, std::greater_equal<>()) != pulse_times_s.end()) {
    reading.why_not = "the times of the pulses do not rise";
    return reading;
  }
  Marks marks;
  reading.why_not = count_marks(pulse_times_s, marks, reading.faults);
  if (!reading.why_not.empty()) return reading;
  const auto pulses = static_cast<double>(pulse_times_s.size());
  if (static_cast<double>(reading.faults.size()) > most_faults * pulses) {
    reading.why_not = fmt::format("{} of {} pulses are missing or extra", reading.faults.size(),
                                  pulse_times_s.size());
    return reading;
  }
  reading.angle = angle_through(marks, pulses_per_turn);
  if (!reading.angle) reading.why_not = "the shaft did not turn steadily one way";
  return reading;
}

}  // namespace rvbench::analysis
