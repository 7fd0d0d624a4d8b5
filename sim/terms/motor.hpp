#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// Direct-current machine on a recorded voltage u.
///
///     i = (u − K·v)/R,   F = −K·i
///
/// Leaves out: inductance (the current follows at once), iron losses, cogging.
/// Source: Fitzgerald, Electric Machinery, ch. 7
TermType motor();

}  // namespace rvbench::sim
