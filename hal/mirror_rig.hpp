#pragma once

#include "hal/mirror_world.hpp"
#include "hal/rig.hpp"

namespace rvbench::hal {

/// An ideal bench in virtual time that echoes what it is told: for testing the plumbing.
///
/// The shaft reaches every speed by a ramp, the input torque is the brake's over the gear ratio,
/// accelerations are zero. No wire and no physics: those are the simulated rig's.
Rig make_mirror_rig(const MirrorOptions& options = {});

/// What is behind a rig that make_mirror_rig() made.
MirrorWorld& mirror_world(Rig& rig);

}  // namespace rvbench::hal
