#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <vector>

#include "bench/factory/broker_file.hpp"
#include "bench/factory/intake.hpp"
#include "bench/factory/mqtt_link.hpp"
#include "bench/factory/outbox.hpp"

namespace rvbench::bench {

/// Sends the judged runs below a root to a broker, oldest first, each once.
///
/// Errors   publish() ends with the first; follow() tells it once and tries again, after 1 s, then
///          twice as long each time, at most a minute
/// Threads  one caller at a time; see MqttLink
class Publisher {
 public:
  struct Told {
    std::function<void(const OutboxEntry&)> acknowledged;
    std::function<void(const SkippedRun&)> skipped;  ///< once for each run and reason
    std::function<void(const std::string&)> link;    ///< how it fares, in words
  };

  Publisher(std::filesystem::path root, const Broker& broker, Outbox& outbox, Told told);

  /// What is due now. Nobody is called where nothing is.
  Status publish(const std::stop_token& stop);
  /// Also what comes, until a stop is requested.
  void follow(const std::stop_token& stop);

 private:
  Status look();
  Status go_on(const std::stop_token& stop);
  Status connect(const std::stop_token& stop);
  Status send_all(const std::stop_token& stop);
  Status tell_acknowledged(const std::string& result_id);
  void hang_up();
  void give_up_link(const IoError& why);
  void lose(const IoError& why);
  void tell_fault(const IoError& why);

  std::filesystem::path root_;
  const Broker& broker_;
  Outbox& outbox_;
  Told told_;
  RunWatch watch_;
  std::set<SkippedRun> skipped_;
  std::unique_ptr<MqttLink> link_;
  std::chrono::seconds back_off_{1};
  std::chrono::steady_clock::time_point next_try_{};
  std::string last_fault_;
  bool is_connected_ = false;  // once, with this link: what is lost since was on its way
};

}  // namespace rvbench::bench
