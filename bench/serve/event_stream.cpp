#include "bench/serve/event_stream.hpp"

#include <fmt/format.h>

#include <chrono>
#include <memory>

#include "bench/run_folder.hpp"

namespace rvbench::bench {
namespace {

using Steady = std::chrono::steady_clock;

constexpr std::chrono::milliseconds heartbeat_every{500};

std::string event(const std::string& name, const std::string& data) {
  return fmt::format("event: {}\ndata: {}\n\n", name, data);
}

class Listener {
 public:
  Listener(EventHub& hub, std::atomic<std::size_t>& listeners, std::function<std::string()> state,
           std::function<bool()> may_listen)
      : hub_(hub),
        listeners_(listeners),
        state_(std::move(state)),
        may_listen_(std::move(may_listen)) {
    ++listeners_;
  }
  ~Listener() { --listeners_; }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  bool tell(const HttpSend& send) {
    if (!has_begun_) return begin(send);
    const std::chrono::duration<double> left = next_beat_ - Steady::now();
    const EventHub::News news = hub_.wait_after(number_, left.count() > 0 ? left.count() : 0);
    if (news.is_over) return false;
    if (news.has_hole) return begin(send);
    std::string text;
    bool has_state = false;
    for (const LiveEvent& told : news.events) {
      number_ = told.number;
      has_state = has_state || told.name == "state";
      if (told.name != "state") text += event(told.name, told.data);
    }
    if (has_state) text += event("state", state_());  // as it is now: once will do
    if (Steady::now() >= next_beat_) {
      if (!may_listen_()) return false;
      text += beat();
    }
    return text.empty() || send(text);
  }

 private:
  bool begin(const HttpSend& send) {
    has_begun_ = true;
    number_ = hub_.newest();
    std::string strips;
    for (const std::string& strip : hub_.strips()) strips += (strips.empty() ? "" : ",") + strip;
    return send(
        "retry: 1000\n\n" +
        event("snapshot", fmt::format("{{\"state\":{},\"strips\":[{}]}}", state_(), strips)) +
        beat());
  }
  std::string beat() {
    next_beat_ = Steady::now() + heartbeat_every;
    return event("heartbeat", fmt::format("{{\"time_utc\":\"{}\"}}", utc_now()));
  }

  EventHub& hub_;
  std::atomic<std::size_t>& listeners_;
  const std::function<std::string()> state_;
  const std::function<bool()> may_listen_;
  bool has_begun_ = false;
  std::uint64_t number_ = 0;
  Steady::time_point next_beat_;
};

}  // namespace

HttpAnswer event_stream(EventHub& hub, std::atomic<std::size_t>& listeners,
                        std::function<std::string()> state, std::function<bool()> may_listen) {
  auto listener =
      std::make_shared<Listener>(hub, listeners, std::move(state), std::move(may_listen));
  return {.type = "text/event-stream",
          .part = [listener](const HttpSend& send) { return listener->tell(send); }};
}

}  // namespace rvbench::bench
