#include "bench/findings_stand.hpp"

#include <algorithm>

#include "bench/limit_checks.hpp"
#include "bench/trust.hpp"

namespace rvbench::bench {

bool is_spoiled(const Judgement& judgement) {
  return !can_be_trusted(judgement) ||
         std::ranges::any_of(judgement.diagnosis.quality, &analysis::QualityNote::invalidates);
}

Lack lack_of(const Judgement& judgement) {
  if (is_spoiled(judgement)) return Lack::sound_data;
  if (!std::ranges::all_of(judgement.limits, is_measured)) return Lack::limit_measured;
  const bool is_open =
      std::ranges::any_of(judgement.diagnosis.not_shown, &analysis::Finding::is_open);
  return is_open ? Lack::part_shown : Lack::sound_data;
}

bool findings_stand(const Judgement& judgement) {
  switch (judgement.ending.outcome) {
    case Outcome::pass:
    case Outcome::fail: return true;
    case Outcome::invalid: return lack_of(judgement) != Lack::sound_data;
    case Outcome::error:
    case Outcome::aborted: break;
  }
  return false;
}

}  // namespace rvbench::bench
