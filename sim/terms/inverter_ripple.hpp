#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// Ripple of an inverter-fed motor: a harmonic of the electrical frequency, mostly the sixth.
///
///     F = −(A·cos 2πh·f_e·t + B·sin 2πh·f_e·t)
///
/// Leaves out: dependence on current and flux; drift of f_e with slip within a record.
/// Source: Fitzgerald, Electric Machinery, ch. 6: fifth and seventh current harmonics
TermType inverter_ripple();

}  // namespace rvbench::sim
