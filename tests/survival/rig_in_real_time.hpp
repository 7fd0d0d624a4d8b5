#pragma once

#include "hal/rig.hpp"

namespace rvbench::test {

/// The same rig, whose time passes as real time does, `pace` times as fast: several threads may
/// call its devices, as those of a real bench, and whoever runs it writes behind.
///
/// @param rig   in virtual time, of which only its clock makes anybody wait
/// @param pace  seconds of the rig's time in a real one, above 0
hal::Rig in_real_time(hal::Rig rig, double pace);

}  // namespace rvbench::test
