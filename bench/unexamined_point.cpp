#include "bench/unexamined_point.hpp"

#include <fmt/format.h>

#include <utility>

namespace rvbench::bench {

JudgedPoint unexamined_point(const hal::PlannedPoint& planned, int number, std::string status) {
  JudgedPoint point;
  point.status = std::move(status);
  point.planned_speed_rpm = planned.speed_rpm;
  point.examination.source = fmt::format("point {:03}", number);
  point.examination.load_pct = planned.load_pct;
  point.examination.repeat = planned.repeat;
  return point;
}

}  // namespace rvbench::bench
