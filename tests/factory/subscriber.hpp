#pragma once

#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/wait_until.hpp"

namespace rvbench::test {

/// One message as somebody in the factory gets it.
struct Received {
  std::string topic, payload;
  bool retained = false;
};

/// Somebody in the factory who listens to a topic, at QoS 2, from the moment it is made.
class Subscriber {
 public:
  Subscriber(int port, const std::string& topic);
  ~Subscriber();
  Subscriber(const Subscriber&) = delete;
  Subscriber& operator=(const Subscriber&) = delete;

  /// @param count  waits for so many, then a moment longer: whether more come than should
  std::vector<Received> messages(std::size_t count);
  std::vector<nlohmann::json> results(std::size_t count);

 private:
  void take(std::chrono::milliseconds time);

  void* client_ = nullptr;
  std::vector<Received> messages_;
};

}  // namespace rvbench::test
