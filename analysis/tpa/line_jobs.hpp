#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <functional>

#include "hal/types/parallel_for.hpp"

namespace rvbench::analysis {

/// Calls body(from, to) for stretches of lines that together are [0, lines), each large enough to
/// be worth a thread; threads and errors as in parallel_for.
inline void for_line_stretches(Eigen::Index lines,
                               const std::function<void(Eigen::Index from, Eigen::Index to)>& body,
                               unsigned threads) {
  constexpr Eigen::Index lines_per_job = 64;
  parallel_for(
      static_cast<std::size_t>((lines + lines_per_job - 1) / lines_per_job),
      [&](std::size_t job) {
        const Eigen::Index from = static_cast<Eigen::Index>(job) * lines_per_job;
        body(from, std::min(lines, from + lines_per_job));
      },
      threads);
}

}  // namespace rvbench::analysis
