#include "sim/loopback_listener.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <string>

#include "tests/support/loopback.hpp"
#include "tests/support/wait_until.hpp"

using namespace rvbench;
using sim::LoopbackListener;

namespace {

// As long as it lives, this process can open nothing more.
class NoDescriptorLeft {
 public:
  NoDescriptorLeft() {
    REQUIRE(::getrlimit(RLIMIT_NOFILE, &before_) == 0);
    const int lowest_free = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
    ::close(lowest_free);
    const rlimit none{rlim_t(lowest_free), before_.rlim_max};
    REQUIRE(::setrlimit(RLIMIT_NOFILE, &none) == 0);
  }
  ~NoDescriptorLeft() { ::setrlimit(RLIMIT_NOFILE, &before_); }
  NoDescriptorLeft(const NoDescriptorLeft&) = delete;
  NoDescriptorLeft& operator=(const NoDescriptorLeft&) = delete;

 private:
  rlimit before_{};
};

// Whether poll() tells of a client, as a server asks it.
bool is_told(const LoopbackListener& listener, int timeout_ms) {
  pollfd watched{listener.watched(), POLLIN, 0};
  return ::poll(&watched, 1, timeout_ms) > 0 && watched.revents != 0;
}

}  // namespace

TEST_CASE("a client that waits is told of, and taken in", "[sim]") {
  LoopbackListener listener(0);
  CHECK(listener.accept() == -1);
  CHECK(listener.patience_ms() == -1);  // nobody waits: that is no failure
  const test::Socket client = test::connected_to(listener.port());
  REQUIRE(client);
  REQUIRE(is_told(listener, 30'000));
  const test::Socket served(listener.accept());
  CHECK(served);
}

TEST_CASE("a listener whose process has no descriptor left rests, and then takes the client in",
          "[sim]") {
  LoopbackListener listener(0);
  const test::Socket client = test::connected_to(listener.port());
  REQUIRE(client);
  REQUIRE(is_told(listener, 30'000));
  {
    const NoDescriptorLeft none;
    // A busy computer may look only when the rest is over.
    REQUIRE(test::wait_until([&] {
      CHECK(listener.accept() == -1);
      CHECK(listener.patience_ms() <= 100);
      return listener.watched() == -1;
    }));
  }
  REQUIRE(test::wait_until([&] { return listener.watched() >= 0; }));
  CHECK(listener.patience_ms() == -1);
  REQUIRE(is_told(listener, 0));
  const test::Socket served(listener.accept());
  CHECK(served);
}

TEST_CASE("a listener whose port is taken tells which", "[sim]") {
  const LoopbackListener first(0);
  const std::string port = std::to_string(first.port());
  CHECK_THROWS_WITH(LoopbackListener(first.port()),
                    "cannot listen on 127.0.0.1:" + port + ": Address already in use");
}
