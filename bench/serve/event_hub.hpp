#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <vector>

namespace rvbench::bench {

/// Something that listeners are told: an event of the page's stream.
struct LiveEvent {
  std::uint64_t number = 0;  ///< rises from 1
  std::string name;          ///< "state", "strip", "spectrum"
  std::string data;          ///< JSON in one line; of "state" nothing: each listener has its own
};

/// Tells any number of listeners what happens, and waits for none: a listener that falls behind by
/// more than is kept begins anew with a snapshot.
///
/// Threads  any
class EventHub {
 public:
  static constexpr std::size_t kept = 600;         ///< events: two minutes of strips
  static constexpr std::size_t kept_strips = 300;  ///< for who comes later

  struct News {
    std::vector<LiveEvent> events;  ///< since that number; empty at the time-out
    bool has_hole = false;          ///< the listener has missed some
    bool is_over = false;           ///< the hub was closed
  };

  void publish(const std::string& name, const std::string& data);
  News wait_after(std::uint64_t number, double longest_s);
  std::uint64_t newest() const;
  std::vector<std::string> strips() const;  ///< the last of them, oldest first
  void forget_strips();                     ///< a new run begins with an empty strip
  void close();                             ///< every listener's wait ends, now and for ever

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<LiveEvent> events_;
  std::deque<std::string> strips_;
  std::uint64_t newest_ = 0;
  bool is_over_ = false;
};

}  // namespace rvbench::bench
