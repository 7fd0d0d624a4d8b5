#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "bench/serve/event_hub.hpp"
#include "bench/serve/http.hpp"

namespace rvbench::bench {

/// Server-sent events for one listener: at first "snapshot" with the state and the last strips,
/// then "state", "strip" and "spectrum" as they come, and "heartbeat" every half second. One that
/// has fallen behind gets a snapshot again.
///
/// @param listeners    counts this one while it listens
/// @param state        the whole state, as this listener is to see it
/// @param may_listen   asked at every heartbeat; false ends it
/// Source  HTML Living Standard, 9.2 Server-sent events
HttpAnswer event_stream(EventHub& hub, std::atomic<std::size_t>& listeners,
                        std::function<std::string()> state, std::function<bool()> may_listen);

}  // namespace rvbench::bench
