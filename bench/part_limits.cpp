#include "bench/part_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rvbench::bench {
namespace {

// "0.075 (0.01 in phase)"
std::string limit_text(const analysis::Signature& part) {
  std::string beside;
  const auto add = [&](double limit, const char* where) {
    beside += fmt::format("{}{:.3g} {}", beside.empty() ? "" : ", ", limit, where);
  };
  if (part.aligned_limit < part.depth_limit) add(part.aligned_limit, "in phase");
  if (part.scatter_limit > part.depth_limit) add(part.scatter_limit, "scattered");
  if (part.noise_limit < part.depth_limit) add(part.noise_limit, "in noise alone");
  return fmt::format("{:.3g}", part.depth_limit) + (beside.empty() ? "" : " (" + beside + ")");
}

}  // namespace

std::string part_limits_text(const analysis::Kinematics& kinematics) {
  std::size_t widest = 4;
  for (const analysis::Signature& part : kinematics.signatures) {
    widest = std::max(widest, part.component.size());
  }
  std::string text = fmt::format("  {:{}}  {:13}  {:>8}  limit of severity, and why\n", "part",
                                 widest, "mechanism", "order");
  for (const analysis::Signature& part : kinematics.signatures) {
    text += fmt::format("  {:{}}  {:13}  {:8.4f}  {}: {}\n", part.component, widest, part.mechanism,
                        part.order, limit_text(part), part.limit_why);
  }
  return text;
}

}  // namespace rvbench::bench
