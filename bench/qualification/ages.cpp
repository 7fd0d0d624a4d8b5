#include "bench/qualification/ages.hpp"

#include <fmt/format.h>

#include "bench/results/run_filter.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::bench {
namespace {

constexpr double clocks_apart_days = 5.0 / (24 * 60);

}  // namespace

double days_between(const std::string& from_utc, const std::string& to_utc) {
  return days_of_utc(to_utc).value_or(not_known) - days_of_utc(from_utc).value_or(not_known);
}

// What cannot be read is as bad as what is to come: the comparison is false of NaN.
bool is_ahead(const std::string& utc, const std::string& now_utc) {
  return !(days_between(now_utc, utc) <= clocks_apart_days);
}

std::string age_fault(const std::string& utc, double max_age_h, const std::string& now_utc) {
  if (is_ahead(utc, now_utc)) {
    return fmt::format("is of {}, which is yet to come by this computer's clock ({}): is it right?",
                       readable_utc(utc), readable_utc(now_utc));
  }
  const double age_h = 24 * days_between(utc, now_utc);
  if (age_h <= max_age_h) return "";
  return fmt::format("is of {}, {:.3g} h ago, and counts for {:g} h", readable_utc(utc), age_h,
                     max_age_h);
}

std::string day_of(const std::string& utc) { return readable_utc(utc).substr(0, 10); }

}  // namespace rvbench::bench
