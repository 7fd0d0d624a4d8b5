#pragma once

#include <chrono>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "bench/factory/broker_file.hpp"
#include "bench/factory/outbox.hpp"
#include "hal/types/result.hpp"

namespace rvbench::bench {

/// One connection to an MQTT broker (3.1.1), by Eclipse Paho. The outbox is Paho's store as well:
/// an attempt is counted before anything goes out, a result is "sent" in the same transaction that
/// keeps its packet, and "acknowledged" in the one that forgets it.
///
/// What MQTT promises of that, with one result under way at a time, so that order is kept:
///   QoS 1  at least once. What was under way when the link or the process was lost is sent again,
///          marked PossibleDuplicate, for nobody can know whether it came through.
///   QoS 2  exactly once, as long as the broker keeps the session (it must store it on its disk to
///          keep it through a crash of its own): the packet goes on where it was, under its number.
///          A broker that has lost the session gets the result again, marked as above; the packet
///          of before, which Paho repeats as it connects, it may have taken for a new one.
/// Either ends at the broker: what it does for its subscribers depends on their QoS and sessions.
///
/// Order    connect() → { send() | idle() }*; after an error make another one
/// Errors   disconnected: nobody answers, or the link was lost; refused: the broker said no, or is
///          not who its certificate should say; timeout: no acknowledgement in time
/// Time     connect() 5 s at most for each of up to three connections, and as long as a name server
///          takes; send() 20 s, and as long as the network takes for what it has begun to take
/// Threads  one caller at a time, and no other use of Paho's synchronous client in the process
/// Source   OASIS MQTT 3.1.1, 4.3 (QoS), 4.4 (delivery after a reconnect), 4.6 (order)
class MqttLink {
 public:
  MqttLink(const Broker& broker, Outbox& outbox);
  ~MqttLink();  ///< says "offline" where the link is still up
  MqttLink(const MqttLink&) = delete;
  MqttLink& operator=(const MqttLink&) = delete;

  Status connect();
  bool is_up() const;

  /// Ends early, with the result still under way, if a stop is requested.
  Status send(const OutboxEntry& due, const std::stop_token& stop);

  /// Waits until what was under way before connect() has come to its end.
  Status finish(const std::vector<std::string>& result_ids, const std::stop_token& stop);

  /// Keeps the link alive.
  void idle(std::chrono::milliseconds time);

 private:
  struct Paho;
  Status make_client();
  Result<bool> open(bool clean);
  void close();
  void hang_up();
  IoError why_not_connected(int code) const;
  Status wait_for(const std::string& result_id, const std::stop_token& stop);

  const Broker& broker_;
  Outbox& outbox_;
  std::unique_ptr<Paho> paho_;
};

}  // namespace rvbench::bench
