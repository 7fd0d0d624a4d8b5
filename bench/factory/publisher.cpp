#include "bench/factory/publisher.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>
#include <utility>

namespace rvbench::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds first_back_off{1}, longest_back_off{60};
constexpr std::chrono::seconds between_looks{1};
constexpr int most_sends = 3;  // of a result that the link is lost with each time, before others go
constexpr std::chrono::milliseconds slice{100};  // within which a stop is heard

}  // namespace

Publisher::Publisher(std::filesystem::path root, const Broker& broker, Outbox& outbox, Told told)
    : root_(std::move(root)),
      broker_(broker),
      outbox_(outbox),
      told_(std::move(told)),
      watch_(root_) {}

Status Publisher::publish(const std::stop_token& stop) {
  if (const Status looked = look(); !looked) return looked;
  const auto before = outbox_.left();
  if (!before) return before.error();
  if (before.value() == 0) return Done{};
  const Status connected = connect(stop);
  const Status sent = connected ? send_all(stop) : connected;
  if (sent || stop.stop_requested()) {
    hang_up();
  } else {
    give_up_link(sent.error());
  }
  const auto left = outbox_.left();
  return left && left.value() == 0 ? Done{} : sent;
}

void Publisher::follow(const std::stop_token& stop) {
  auto next_look = Clock::now();
  while (!stop.stop_requested()) {
    if (Clock::now() >= next_look) {
      if (const Status looked = look(); !looked) tell_fault(looked.error());
      next_look = Clock::now() + between_looks;
    }
    if (const Status fares = go_on(stop); !fares && !stop.stop_requested()) lose(fares.error());
    if (link_) {
      link_->idle(slice);
    } else {
      std::this_thread::sleep_for(slice);
    }
  }
  hang_up();
}

Status Publisher::go_on(const std::stop_token& stop) {
  if (!link_ && Clock::now() < next_try_) return Done{};
  if (!link_) {
    if (const Status connected = connect(stop); !connected) return connected;
  }
  if (!link_->is_up()) {
    return IoError{IoErrc::disconnected,
                   "MQTT broker at " + broker_.address() + ": the link was lost"};
  }
  return send_all(stop);
}

Status Publisher::look() {
  if (!watch_.has_changed()) return Done{};
  const auto skipped = take_in(root_, broker_.step, outbox_);
  if (!skipped) {
    watch_ = RunWatch(root_);  // so that it is tried again
    return skipped.error();
  }
  for (const SkippedRun& run : skipped.value()) {
    if (skipped_.insert(run).second) told_.skipped(run);
  }
  return Done{};
}

Status Publisher::connect(const std::stop_token& stop) {
  link_ = std::make_unique<MqttLink>(broker_, outbox_);
  if (const Status connected = link_->connect(); !connected) return connected;
  told_.link("connected to the MQTT broker at " + broker_.address());
  last_fault_.clear();
  is_connected_ = true;
  const auto under_way = outbox_.ids_of("sent");
  if (!under_way) return under_way.error();
  if (const Status finished = link_->finish(under_way.value(), stop); !finished) return finished;
  for (const std::string& id : under_way.value()) {
    if (const Status told = tell_acknowledged(id); !told) return told;
  }
  return Done{};
}

Status Publisher::send_all(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    const auto next = outbox_.next_due();
    if (!next) return next.error();
    if (!next.value()) return Done{};
    if (const Status sent = link_->send(*next.value(), stop); !sent) return sent;
    if (const Status told = tell_acknowledged(next.value()->result_id); !told) return told;
  }
  return Done{};
}

Status Publisher::tell_acknowledged(const std::string& result_id) {
  const auto entry = outbox_.find(result_id);
  if (!entry) return entry.error();
  if (entry.value()) told_.acknowledged(*entry.value());
  back_off_ = first_back_off;
  return Done{};
}

// The last word of the link may have waited for an acknowledgement that came.
void Publisher::hang_up() {
  const auto under_way = outbox_.ids_of("sent");
  link_.reset();
  if (!under_way) return;
  for (const std::string& id : under_way.value()) {
    const auto came = outbox_.is_acknowledged(id);
    if (came && came.value()) (void)tell_acknowledged(id);
  }
}

// A broker that does not take a result, for its size, say, only hangs up: others may pass it then.
// Where the library has given the packet up already, the result is the first that is due.
void Publisher::give_up_link(const IoError& why) {
  hang_up();
  const bool was_connected = std::exchange(is_connected_, false);
  if (!was_connected || why.code == IoErrc::refused) return;  // by the outbox
  const auto under_way = outbox_.ids_of("sent");
  if (!under_way) return;
  const auto entry =
      under_way.value().empty() ? outbox_.next_due() : outbox_.find(under_way.value().front());
  if (!entry || !entry.value() || entry.value()->sends < most_sends) return;
  const OutboxEntry& refused = *entry.value();
  if (!outbox_.recall() || !outbox_.put_last(refused.result_id)) return;
  told_.skipped({refused.folder,
                 fmt::format("{} times the link was lost while it was on its way ({} bytes): does "
                             "the broker take so much? It goes after the others from now on",
                             refused.sends, refused.payload.size())});
}

void Publisher::lose(const IoError& why) {
  give_up_link(why);
  tell_fault(why);
  next_try_ = Clock::now() + back_off_;
  back_off_ = std::min(2 * back_off_, longest_back_off);
}

void Publisher::tell_fault(const IoError& why) {
  if (why.where == std::exchange(last_fault_, why.where)) return;
  told_.link(why.where + "; nothing is lost, trying again");
}

}  // namespace rvbench::bench
