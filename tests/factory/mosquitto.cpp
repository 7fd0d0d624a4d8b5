#include "tests/factory/mosquitto.hpp"

#include <signal.h>

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace rvbench::test {

Mosquitto::Mosquitto(std::string settings)
    : reserved_(reserved_port()), settings_(std::move(settings)) {
  start();
}

void Mosquitto::start() {
  std::ofstream(folder_ / "mosquitto.conf")
      << "listener " << port() << " 127.0.0.1\n"
      << "user root\n"  // where the tests run as root it would leave it, and read no file of theirs
      << "log_dest stderr\nlog_type all\n"
      << settings_ << '\n';
  program_ = std::make_unique<Program>(
      folder_.path(), std::vector<std::string>{"/usr/sbin/mosquitto", "-c", "mosquitto.conf"});
  if (!program_->says(" running\n")) throw std::runtime_error("mosquitto: " + program_->said());
}

void Mosquitto::kill() {
  (void)send(SIGKILL);
  if (program_) log_ += program_->wait().err;
  program_.reset();
}

int Mosquitto::publications(const std::string& how, const std::string& topic) const {
  std::istringstream lines(log());
  int count = 0;
  for (std::string line; std::getline(lines, line);) {
    const bool is_one = line.find("Received PUBLISH from ") != std::string::npos &&
                        line.find("(" + how) != std::string::npos &&
                        line.find("'" + topic + "'") != std::string::npos;
    count += is_one ? 1 : 0;
  }
  return count;
}

// "  sl  local_address rem_address   st tx_queue:rx_queue ...", all hexadecimal: proc(5).
unsigned long Mosquitto::unread_bytes() const {
  constexpr const char* established = "01";
  std::ifstream connections("/proc/net/tcp");
  unsigned long bytes = 0;
  for (std::string line; std::getline(connections, line);) {
    std::istringstream words(line);
    std::string number, local, remote, state, queues;
    words >> number >> local >> remote >> state >> queues;
    const std::size_t colon = local.find(':'), between = queues.find(':');
    if (state != established || colon == std::string::npos || between == std::string::npos)
      continue;
    if (std::stoi(local.substr(colon + 1), nullptr, 16) != port()) continue;
    bytes += std::stoul(queues.substr(between + 1), nullptr, 16);
  }
  return bytes;
}

}  // namespace rvbench::test
