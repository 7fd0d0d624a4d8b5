#include "hal/service_watchdog.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <cstdlib>

#include "tests/hal/service_manager.hpp"
#include "tests/support/scratch_folder.hpp"

using rvbench::hal::ServiceWatchdog;
using rvbench::test::ServiceManager;

TEST_CASE("systemd's watchdog is fed four times within its time", "[hal][safety]") {
  const rvbench::test::ScratchFolder scratch;
  const std::string abstract = "@rvbench-" + scratch.path().filename().string();
  const ServiceManager manager(GENERATE(true, false) ? (scratch / "notify").string() : abstract);
  ServiceWatchdog watchdog;
  CHECK(watchdog.is_on());
  watchdog.feed(10);
  CHECK(manager.heard() == "WATCHDOG=1");
  watchdog.feed(10.4);
  CHECK(manager.heard().empty());
  watchdog.feed(10.5);
  CHECK(manager.heard() == "WATCHDOG=1");
}

TEST_CASE("a service manager that does not listen holds up nobody, and is told once it does",
          "[hal][safety]") {
  const rvbench::test::ScratchFolder scratch;
  const ServiceManager manager((scratch / "notify").string());
  ServiceWatchdog watchdog;
  // The kernel keeps some ten datagrams, net.unix.max_dgram_qlen, and would make us wait then.
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < 1000; ++i) watchdog.feed(i);
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(5));
  int kept = 0;
  while (!manager.heard().empty()) ++kept;
  REQUIRE(kept > 0);
  REQUIRE(kept < 1000);
  watchdog.feed(999.001);  // what it did not take is told anew, not a quarter of its time later
  CHECK(manager.heard() == "WATCHDOG=1");
}

TEST_CASE("without a service manager there is nothing to feed", "[hal]") {
  ::unsetenv("WATCHDOG_USEC");
  ServiceWatchdog watchdog;
  CHECK_FALSE(watchdog.is_on());
  watchdog.feed(1);
}
