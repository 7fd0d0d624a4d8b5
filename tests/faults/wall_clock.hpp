#pragma once

namespace rvbench::test {

/// Sets this process's wall clock forward or back, as a time server or an operator may: whoever
/// asks for the time of day from now on is told another one. Steady clocks go on.
void step_wall_clock(double seconds);

/// Whether the step shows where programs ask for the time of day: if not, it shows nothing.
bool wall_clock_can_step();

}  // namespace rvbench::test
