#include "sequences/supervisor_state.hpp"

#include <catch2/catch.hpp>
#include <string>
#include <vector>

using namespace rvbench::sequences;
using State = SupervisorState;
using Event = SupervisorEvent;

namespace {

std::optional<State> after(std::initializer_list<Event> events) {
  std::optional<State> state = State::faulted;
  for (const Event event : events) {
    if (state) state = next_state(*state, event);
  }
  return state;
}

}  // namespace

TEST_CASE("every event in every state leads where the safety concept says, or is refused",
          "[sequences][safety]") {
  const std::string may_not;
  struct Row {
    State state;
    Event event;
    std::string next;
  };
  const std::vector<Row> rows{
      {State::faulted, Event::reset, "READY"},
      {State::faulted, Event::arm, may_not},
      {State::faulted, Event::run, may_not},
      {State::faulted, Event::stop, "FAULTED"},
      {State::faulted, Event::standstill, "FAULTED"},
      {State::faulted, Event::trip, "FAULTED"},
      {State::ready, Event::reset, "READY"},
      {State::ready, Event::arm, "ARMED"},
      {State::ready, Event::run, may_not},
      {State::ready, Event::stop, "STOPPING"},
      {State::ready, Event::standstill, "READY"},
      {State::ready, Event::trip, "FAULTED"},
      {State::armed, Event::reset, may_not},
      {State::armed, Event::arm, may_not},
      {State::armed, Event::run, "RUNNING"},
      {State::armed, Event::stop, "STOPPING"},
      {State::armed, Event::standstill, may_not},
      {State::armed, Event::trip, "FAULTED"},
      {State::running, Event::reset, may_not},
      {State::running, Event::arm, may_not},
      {State::running, Event::run, "RUNNING"},
      {State::running, Event::stop, "STOPPING"},
      {State::running, Event::standstill, may_not},
      {State::running, Event::trip, "FAULTED"},
      {State::stopping, Event::reset, may_not},
      {State::stopping, Event::arm, may_not},
      {State::stopping, Event::run, may_not},
      {State::stopping, Event::stop, "STOPPING"},
      {State::stopping, Event::standstill, "READY"},
      {State::stopping, Event::trip, "FAULTED"},
  };
  REQUIRE(rows.size() == std::size_t(supervisor_states * supervisor_events));
  for (const Row& row : rows) {
    CAPTURE(to_string(row.state), to_string(row.event));
    const auto next = next_state(row.state, row.event);
    CHECK((next ? to_string(*next) : may_not) == row.next);
  }
}

TEST_CASE("a run goes from FAULTED over READY, ARMED, RUNNING and STOPPING back to READY",
          "[sequences][safety]") {
  CHECK(after({Event::reset, Event::arm, Event::run, Event::run, Event::stop, Event::standstill}) ==
        State::ready);
}

TEST_CASE("after a trip nothing resumes without a reset", "[sequences][safety]") {
  CHECK_FALSE(after({Event::reset, Event::arm, Event::run, Event::trip, Event::run}));
  CHECK_FALSE(after({Event::reset, Event::arm, Event::run, Event::trip, Event::arm}));
  CHECK_FALSE(after({Event::reset, Event::arm, Event::run, Event::trip, Event::stop,
                     Event::standstill, Event::run}));
  CHECK(after({Event::reset, Event::arm, Event::trip, Event::reset, Event::arm, Event::run}) ==
        State::running);
}
