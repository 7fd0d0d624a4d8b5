#pragma once

#include <string>

namespace rvbench::hal {

/// Puts the calling thread before everything that is not real time: SCHED_FIFO, at a priority below
/// the kernel's own threads. It must sleep most of the time.
///
/// @return "" if that went well, else why not ("Operation not permitted: ..."): without the right
///         to it (root, CAP_SYS_NICE, or an rtprio limit) the thread stays an ordinary one
std::string make_this_thread_urgent();

}  // namespace rvbench::hal
