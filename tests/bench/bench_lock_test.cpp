#include "bench/bench_lock.hpp"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "bench/cli.hpp"
#include "bench/commands/commands.hpp"
#include "bench/text_file.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/this_build.hpp"

namespace rvbench::bench {
namespace {

using Catch::Contains;

BenchRig rig_on(const std::string& adapter, const std::string& host) {
  BenchRig rig;
  rig.drive.options.path = hal::ModbusTcp{host, 502};
  rig.can.emplace().bus = hal::SlcanOptions{.device = adapter};
  hal::IioOptions front_end;
  front_end.uri = "ip:192.168.3.30";
  front_end.device = "ad7768-1";
  rig.accelerometers.emplace().options = front_end;
  rig.safety.emplace().options.path = hal::ModbusTcp{host, 502};
  return rig;
}

}  // namespace

SCENARIO("two processes do not use one device", "[bench][lock]") {
  const rvbench::test::ScratchFolder folder;
  const auto take = [&](const BenchRig& rig) {
    return BenchLock::take(devices_of(rig), folder.path());
  };
  const BenchRig rig = rig_on("/dev/ttyACM0", "192.168.3.10");
  GIVEN("one that has a bench, drive and coupler behind one gateway") {
    auto first = take(rig);
    REQUIRE(first.index() == 0);
    THEN("another is told which of its devices are in use, by whom") {
      const auto second = take(rig_on("/dev/ttyACM1", "192.168.3.10"));
      REQUIRE(second.index() == 1);
      CHECK(std::get<1>(second) == "in use by another rvbench, process " +
                                       std::to_string(::getpid()) +
                                       ": 192.168.3.10:502, ip:192.168.3.30 ad7768-1");
    }
    THEN("one on other devices goes ahead") {
      BenchRig other = rig_on("/dev/ttyACM1", "192.168.3.11");
      std::get<hal::IioOptions>(other.accelerometers->options).uri = "local:";
      CHECK(take(other).index() == 0);
    }
    WHEN("it has ended, the devices are free") {
      { const BenchLock ended = std::get<0>(std::move(first)); }
      CHECK(take(rig).index() == 0);
    }
  }
  GIVEN("a link to the adapter's device, as in /dev/serial/by-id") {
    std::filesystem::create_symlink("/dev/null", folder / "by-id");
    const auto first = take(rig_on("/dev/null", "192.168.3.10"));
    const auto second = take(rig_on(folder / "by-id", "192.168.3.11"));
    REQUIRE(second.index() == 1);
    CHECK_THAT(std::get<1>(second), Contains("/dev/null"));
  }
}

TEST_CASE("a front end is one device, whatever name the rig file has for it", "[bench][lock]") {
  const auto names_of = [](const std::string& uri) {
    BenchRig rig;
    rig.drive.options.path = hal::ModbusRtu{.device = "/dev/null"};
    hal::IioOptions front_end;
    front_end.uri = uri;
    front_end.device = "ad7768-1";
    rig.accelerometers.emplace().options = front_end;
    auto names = devices_of(rig);
    std::erase(names, "/dev/null");
    return names;
  };
  using Names = std::vector<std::string>;
  for (const char* uri : {"ip:127.0.0.1", "ip:localhost", "ip:LOCALHOST", "ip:127.0.0.1:30431",
                          "ip:localhost:30431", "ip:::1", "ip:[::1]", "ip:[::1]:30431"}) {
    CAPTURE(uri);
    CHECK(names_of(uri) == Names{"ip:127.0.0.1 ad7768-1"});
  }
  CHECK(names_of("ip:localhost:30500") == Names{"ip:127.0.0.1:30500 ad7768-1"});
  CHECK(names_of("ip:192.168.3.30") == Names{"ip:192.168.3.30 ad7768-1"});
  CHECK(names_of("ip:[fe80:0:0::30]") == names_of("ip:fe80::30"));
  SECTION("a name that nobody resolves stays as it is") {
    const std::string too_long(64, 'x');  // of which no name server is asked
    CHECK(names_of("ip:" + too_long) == Names{"ip:" + too_long + " ad7768-1"});
    CHECK(names_of("ip:") == Names{"ip: ad7768-1"});
  }
  SECTION("one on a serial line is known by the line, as any device is") {
    const rvbench::test::ScratchFolder folder;
    std::filesystem::create_symlink("/dev/zero", folder / "by-id");
    CHECK(names_of("serial:" + (folder / "by-id").string() + ",115200,8n1") ==
          names_of("serial:/dev/zero"));
  }
}

TEST_CASE("two front ends behind one address are two devices", "[bench][lock]") {
  BenchRig rig = rig_on("/dev/ttyACM0", "192.168.3.10");
  const auto devices = devices_of(rig);
  std::get<hal::IioOptions>(rig.accelerometers->options).device = "ad4630-24";
  CHECK(devices_of(rig) != devices);
}

TEST_CASE("what anybody may have written into a lock is not shown", "[bench][lock]") {
  const rvbench::test::ScratchFolder folder;
  const auto held = BenchLock::take({"can0"}, folder.path());
  REQUIRE(held.index() == 0);
  for (const char* text : {"\x1b[31m1\n", "", "12345678901\n", "12 34\n"}) {
    std::ofstream(folder / "rvbench-can0.lock") << text;
    const auto second = BenchLock::take({"can0"}, folder.path());
    REQUIRE(second.index() == 1);
    CHECK(std::get<1>(second) == "in use by another rvbench: can0");
  }
}

TEST_CASE("any user may lock what another user has locked before", "[bench][lock]") {
  const rvbench::test::ScratchFolder folder;
  REQUIRE(BenchLock::take({"can0"}, folder.path()).index() == 0);
  using std::filesystem::perms;
  const auto mode = std::filesystem::status(folder / "rvbench-can0.lock").permissions();
  CHECK((mode & perms::others_write) != perms::none);
}

TEST_CASE("run, probe and qualify leave a bench alone that another process has", "[bench][lock]") {
  const rvbench::test::ScratchFolder folder;
  std::string text = read_file(test::source_dir() / "bench/rigs/rv20e_bench.json").value();
  const std::string host = "192.168.3.10";
  text.replace(text.find(host), host.size(), "127.0.0.1");  // nobody there, and refused at once
  const std::string plant = "\"plant\":";
  text.replace(text.find(plant), plant.size(),
               R"("qualification": {"station": "EOL 3", "self_test": {}}, "plant":)");
  write_file(folder / "rig.json", text);
  const auto taken = BenchLock::take({"127.0.0.1:502"}, folder.path());
  REQUIRE(taken.index() == 0);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"probe", "--rig", folder / "rig.json"},
        {"qualify", "--yes", "--rig", folder / "rig.json", "--out", folder / "runs"},
        {"run", "quick", "--rig", folder / "rig.json", "--serial", "A", "--out",
         folder / "runs"}}) {
    std::vector<std::unique_ptr<Command>> commands;
    commands.push_back(make_run_command(folder.path()));
    commands.push_back(make_probe_command(folder.path()));
    commands.push_back(make_qualify_command(folder.path()));
    std::ostringstream out, err;
    Console console{out, err};
    CHECK(run_cli(words, commands, console) == 2);
    CHECK_THAT(err.str(), Contains(words[0] + ": in use by another rvbench, process ") &&
                              Contains(": 127.0.0.1:502"));
  }
  CHECK_FALSE(std::filesystem::exists(folder / "runs"));
}

}  // namespace rvbench::bench
