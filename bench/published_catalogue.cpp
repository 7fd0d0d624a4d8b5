#include "bench/published_catalogue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include "analysis/table4.hpp"
#include "bench/kinematics_file.hpp"

namespace rvbench::bench {
namespace {

// Of the row of Table 4; NaN if the machine has none.
double order_of(const std::string& table4_item, const analysis::Kinematics& kinematics) {
  const auto found = std::ranges::find(kinematics.orders, table4_item,
                                       &analysis::CharacteristicOrder::table4_item);
  return found == kinematics.orders.end() ? not_known : found->order;
}

}  // namespace

bool is_of_table4(const analysis::Kinematics& derived) {
  const auto rv20e = std::get<analysis::Kinematics>(read_kinematics("rv20e"));
  const auto published = analysis::published_table4(analysis::table4_speeds_rpm.front());
  return std::ranges::all_of(published.signatures, [&](const analysis::Signature& row) {
    const double order = order_of(row.table4_item, derived);
    return std::abs(order - order_of(row.table4_item, rv20e)) < 1e-9;
  });
}

void hold_against_derived(Judgement& published, const Judgement& derived) {
  if (derived.ending.outcome == Outcome::invalid) {
    published.ending = graver(published.ending, derived.ending);
    published.diagnosis.quality = derived.diagnosis.quality;
  }
  for (const analysis::Finding& finding : derived.diagnosis.findings) {
    const auto& named = published.diagnosis.findings;
    if (std::ranges::find(named, finding.component, &analysis::Finding::component) != named.end()) {
      continue;
    }
    const std::string what = fmt::format(
        "Table 4 as published does not hold the lines of {}: {} (order {:.4g}), which the derived "
        "orders show above the limit: judge with --catalogue derived",
        finding.component, finding.mechanism, finding.order);
    published.diagnosis.quality.push_back({published.machine, what, true});
    published.ending = graver(published.ending, {Outcome::invalid, ErrorKind::none, what});
  }
}

}  // namespace rvbench::bench
