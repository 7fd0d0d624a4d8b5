#pragma once

#include <string>

#include "bench/judging.hpp"
#include "hal/types/outcome.hpp"

namespace rvbench::test {

inline const Ending measured{Outcome::pass, ErrorKind::none, "everything was measured"};
inline const sequences::Limit peak_in_g{"acceleration_peak", "", "g", 1.0,
                                        "healthy units stay near 0.1 g"};

/// Resolvable, of one channel, without findings.
inline bench::JudgedPoint point_with_peak(double peak_m_s2) {
  bench::JudgedPoint point;
  point.examination.source = "recording.h5#000";
  point.examination.resolvable = true;
  point.examination.channels = {{"accel_1x",
                                 "m/s²",
                                 0.1,
                                 peak_m_s2,
                                 3,
                                 {},
                                 {},
                                 {{"acceleration_peak", "", peak_m_s2, "m/s²"}}}};
  return point;
}

inline sequences::Limit limit_on(const std::string& measure, double max,
                                 const std::string& of = "") {
  return {measure, "", "1", max, "ten healthy units, mean + 4 sigma", of};
}

}  // namespace rvbench::test
