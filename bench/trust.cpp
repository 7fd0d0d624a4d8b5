#include "bench/trust.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace rvbench::bench {
namespace {

// "clipped", of "clipped: 31 samples at full scale"
std::string kind_of(const analysis::QualityNote& note) {
  return note.what.substr(0, note.what.find(':'));
}

// Why a point cannot be trusted, what to mend first before the others; the first of each kind, for
// what spoils one sensor often spoils them all. Empty if it can.
std::string faults_of(const JudgedPoint& point) {
  std::string faults;
  std::vector<std::string> told;
  for (const analysis::QualityNote& note : point.examination.quality) {
    if (!note.invalidates || std::ranges::find(told, kind_of(note)) != told.end()) continue;
    told.push_back(kind_of(note));
    faults += (faults.empty() ? "" : "; ") + note.where + ": " + note.what;
  }
  if (!faults.empty() || point.status == "ok") return faults;
  return point.examination.source + ": " + point.status;
}

}  // namespace

Ending invalid(std::string reason) {
  return {Outcome::invalid, ErrorKind::none, std::move(reason)};
}

Ending trust_in(const Judgement& judgement) {
  int spoiled = 0;
  std::string first;
  for (const JudgedPoint& point : judgement.points) {
    const std::string faults = faults_of(point);
    if (!faults.empty() && spoiled++ == 0) first = faults;
  }
  if (spoiled == 1) return invalid(first);
  if (spoiled > 1) {
    return invalid(fmt::format("{} of {} points cannot be trusted; first {}", spoiled,
                               judgement.points.size(), first));
  }
  const bool needs_no_orders =
      !judgement.points.empty() && std::ranges::all_of(judgement.points, [](const JudgedPoint& p) {
        return p.examination.of_hysteresis;
      });
  if (!needs_no_orders && !judgement.diagnosis.resolvable) {
    return invalid("not resolvable: no record is long enough to part the orders of this machine");
  }
  return {Outcome::pass, ErrorKind::none, "every record can be trusted"};
}

bool can_be_trusted(const Judgement& judgement) {
  return trust_in(judgement).outcome == Outcome::pass;
}

}  // namespace rvbench::bench
