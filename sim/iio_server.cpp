#include "sim/iio_server.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <limits>
#include <list>
#include <stdexcept>
#include <thread>

#include "sim/iio_session.hpp"
#include "sim/loopback_listener.hpp"
#include "sim/scan_ring.hpp"

namespace rvbench::sim {
namespace {

constexpr double kept_s = 10;
constexpr std::size_t longest_line = 4096;

std::int32_t count_of(float value_m_s2, double m_s2_per_count) {
  constexpr double most = std::numeric_limits<std::int32_t>::max();
  if (std::isnan(value_m_s2)) return std::numeric_limits<std::int32_t>::max();
  return std::int32_t(std::clamp(std::round(double(value_m_s2) / m_s2_per_count), -most, most));
}

bool send_all(int socket, const std::string& bytes) {
  for (std::size_t sent = 0; sent < bytes.size();) {
    const auto more = ::send(socket, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (more <= 0) return false;
    sent += std::size_t(more);
  }
  return true;
}

}  // namespace

class IioServer::Service {
 public:
  Service(const IioFrontEnd& front_end, std::uint16_t port)
      : front_end_(front_end),
        ring_(front_end.labels.size(), std::size_t(kept_s * front_end.rate_Hz) + 1),
        listener_(port),
        ending_(::eventfd(0, EFD_CLOEXEC)),
        thread_([this] { accept_clients(); }) {}

  ~Service() {
    is_ending_ = true;
    ring_.close();
    const std::uint64_t one = 1;
    (void)!::write(ending_, &one, sizeof one);
    thread_.join();
    for (Client& client : clients_) {
      ::shutdown(client.socket, SHUT_RDWR);
      client.thread.join();
      ::close(client.socket);
    }
    ::close(ending_);
  }

  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;

  std::uint16_t port() const { return listener_.port(); }

  void push(const hal::AccelerationBlock::Scans& scans) {
    if (scans.cols() != Eigen::Index(front_end_.labels.size())) {
      throw std::invalid_argument("IioServer::push: wrong number of inputs");
    }
    std::vector<std::int32_t> counts;
    counts.reserve(std::size_t(scans.size()));
    for (Eigen::Index i = 0; i < scans.size(); ++i) {
      counts.push_back(count_of(scans.data()[i], front_end_.m_s2_per_count));
    }
    ring_.push(counts);
  }

 private:
  struct Client {
    int socket = -1;
    std::atomic<bool> is_gone = false;
    std::thread thread;
  };

  void accept_clients() {
    while (!is_ending_) {
      std::array<pollfd, 2> watched{{{ending_, POLLIN, 0}, {listener_.watched(), POLLIN, 0}}};
      if (::poll(watched.data(), watched.size(), listener_.patience_ms()) < 0 && errno != EINTR) {
        return;
      }
      bury_the_gone();
      if (watched[1].revents == 0) continue;
      const int socket = listener_.accept();
      if (socket < 0) continue;
      Client& client = clients_.emplace_back();
      client.socket = socket;
      client.thread = std::thread([this, &client] {
        serve(client.socket);
        client.is_gone = true;
      });
    }
  }

  void bury_the_gone() {
    clients_.remove_if([](Client& client) {
      if (!client.is_gone) return false;
      client.thread.join();
      ::close(client.socket);
      return true;
    });
  }

  void serve(int socket) {
    IioSession session(front_end_, ring_);
    std::string received;
    std::array<char, 4096> bytes{};
    for (;;) {
      const auto count = ::recv(socket, bytes.data(), bytes.size(), 0);
      if (count <= 0 || is_ending_) break;
      received.append(bytes.data(), std::size_t(count));
      if (!answer(socket, session, received) || received.size() > longest_line) break;
    }
    ::shutdown(socket, SHUT_RDWR);
  }

  // Every whole command that has come. False if the client is gone, or says good-bye.
  static bool answer(int socket, IioSession& session, std::string& received) {
    for (;;) {
      std::string told;
      if (const std::size_t awaited = session.awaited_bytes(); awaited > 0) {
        if (received.size() < awaited) return true;
        received.erase(0, awaited);
        told = session.answer_to_bytes();
      } else {
        const std::size_t end = received.find('\n');
        if (end == std::string::npos) return true;
        std::string line = received.substr(0, end);
        received.erase(0, end + 1);
        if (line.ends_with('\r')) line.pop_back();
        if (line.empty()) continue;
        auto answered = session.answer(line);
        if (!answered) return false;
        told = std::move(*answered);
      }
      if (!send_all(socket, told)) return false;
    }
  }

  const IioFrontEnd front_end_;
  ScanRing ring_;
  LoopbackListener listener_;
  int ending_;
  std::atomic<bool> is_ending_ = false;
  std::list<Client> clients_;
  std::thread thread_;
};

IioServer::IioServer(const IioFrontEnd& front_end, std::uint16_t port) {
  if (front_end.labels.empty() || front_end.labels.size() > 32) {
    throw std::invalid_argument("IioServer: 1 to 32 inputs");
  }
  if (!(front_end.rate_Hz > 0) || !(front_end.m_s2_per_count > 0)) {
    throw std::invalid_argument("IioServer: rate and scale must be above 0");
  }
  service_ = std::make_unique<Service>(front_end, port);
}

IioServer::~IioServer() = default;

std::uint16_t IioServer::port() const { return service_->port(); }

void IioServer::push(const hal::AccelerationBlock::Scans& scans) { service_->push(scans); }

}  // namespace rvbench::sim
