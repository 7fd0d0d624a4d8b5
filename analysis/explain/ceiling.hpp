#pragma once

#include "analysis/explain/explanation.hpp"
#include "analysis/explain/trial.hpp"

namespace rvbench::analysis {

/// What a law of any smooth shape, or one that jumps with a sign, could still predict of the
/// residuals on left-out conditions: ridge regression on products up to the third degree of what
/// the model says a law might depend on, and of their signs and magnitudes. It is no physics and
/// never named: it says how much repeatable error there is.
///
/// Shape   all units; units  of the residuals
/// Errors  none thrown; not known where the model has no states or cannot be evaluated
/// Source  Hoerl & Kennard, Technometrics 12(1), 55-67 (1970), for ridge regression
Ceiling flexible_ceiling(const Tryout& on, const Standing& standing);

}  // namespace rvbench::analysis
