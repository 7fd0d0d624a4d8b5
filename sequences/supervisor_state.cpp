#include "sequences/supervisor_state.hpp"

#include <array>

namespace rvbench::sequences {
namespace {

using State = SupervisorState;
using Next = std::optional<SupervisorState>;

constexpr Next never = std::nullopt;
constexpr Next faulted = State::faulted, ready = State::ready, armed = State::armed,
               running = State::running, stopping = State::stopping;

// One row per state, one column per event.
constexpr std::array<std::array<Next, supervisor_events>, supervisor_states> table{{
    // reset  arm    run      stop      standstill  trip
    {{ready, never, never, faulted, faulted, faulted}},   // faulted
    {{ready, armed, never, stopping, ready, faulted}},    // ready
    {{never, never, running, stopping, never, faulted}},  // armed
    {{never, never, running, stopping, never, faulted}},  // running
    {{never, never, never, stopping, ready, faulted}},    // stopping
}};

}  // namespace

std::optional<SupervisorState> next_state(SupervisorState state, SupervisorEvent event) noexcept {
  return table[static_cast<std::size_t>(state)][static_cast<std::size_t>(event)];
}

const char* to_string(SupervisorState state) noexcept {
  constexpr std::array names{"FAULTED", "READY", "ARMED", "RUNNING", "STOPPING"};
  return names[static_cast<std::size_t>(state)];
}

const char* to_string(SupervisorEvent event) noexcept {
  constexpr std::array names{"reset", "arm", "run", "stop", "standstill", "trip"};
  return names[static_cast<std::size_t>(event)];
}

}  // namespace rvbench::sequences
