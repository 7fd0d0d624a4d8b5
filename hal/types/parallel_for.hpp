#pragma once

#include <cstddef>
#include <functional>

namespace rvbench {

/// Calls body(i) once for each i in [0, count), on up to `threads` threads (0: as many as
/// there are cores that no other call is using).
///
/// Threads  the calls may overlap: body(i) writes only what belongs to i, so that the result
///          does not depend on the number of threads
/// Errors   the exception of the lowest failing i is rethrown after all threads have ended
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body,
                  unsigned threads = 0);

}  // namespace rvbench
