#include <catch2/catch.hpp>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/drive_probe.hpp"
#include "bench/plug_test.hpp"
#include "bench/rig_file.hpp"
#include "tests/hal/modbus_bench.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace rvbench;
using sim::CommLossAction;
using sim::WireFault;

namespace {

// A motor without slip, and somebody who pulls the cable and plugs it in again.
class PersonAtTheBench final : public hal::Clock {
 public:
  // @param mishap  happens on the way, 2 s after the start
  PersonAtTheBench(test::ModbusBench& bench, double pulls_s, double plugs_s,
                   const std::function<void()>& mishap)
      : bench_(bench),
        acts_{{2, mishap},
              {pulls_s, [&bench] { bench.server->inject({.fault = WireFault::dead}); }},
              {plugs_s, [&bench] { bench.server->inject({}); }}} {}

  double now_s() const override { return bench_.clock.now_s(); }
  bool is_virtual() const override { return true; }
  void wait_until(double time_s) override {
    while (now_s() < time_s - 1e-6) {
      bench_.clock.wait_until(std::min(time_s, now_s() + 0.01));
      bench_.model.set_measured(30 * bench_.model.output_frequency_Hz(), 1);
      while (!acts_.empty() && now_s() >= acts_.begin()->first) {
        acts_.begin()->second();
        acts_.erase(acts_.begin());
      }
    }
  }

 private:
  test::ModbusBench& bench_;
  std::multimap<double, std::function<void()>> acts_;
};

bench::PlugTest pull(
    test::ModbusBench& bench, double pulls_s, double plugs_s, std::vector<std::string>& told,
    const std::function<void()>& mishap = [] {}) {
  PersonAtTheBench person(bench, pulls_s, plugs_s, mishap);
  REQUIRE(bench.drive.connect());
  return bench::pull_the_plug(bench.drive, person, {.patience_s = 20},
                              [&](const std::string& what) { told.push_back(what); }, {});
}

bench::DriveProbe probe(const sim::InverterParameters& parameters) {
  test::ModbusBench bench(parameters);
  return bench::probe_drive(bench.drive, 50, {});
}

// What is wrong with a rig file, as a user sees it.
std::string faults_of(const std::string& text) {
  const test::ScratchFolder folder;
  std::ofstream(folder / "rig.json") << text;
  const auto rig = bench::read_rig(folder / "rig.json", {});
  std::string all;
  if (rig.index() == 0) return all;
  for (const auto& fault : std::get<1>(rig)) all += fault.pointer + ": " + fault.message + "\n";
  return all;
}

}  // namespace

SCENARIO("a probe tells whether a run may arm a drive, and why not", "[bench][probe]") {
  WHEN("its watchdog stops the motor within two seconds") {
    const bench::DriveProbe sound = probe({.comm_loss_timeout_s = 1});
    THEN("nothing speaks against it, and every reading was timed") {
      CHECK(bench::refusal_to_arm(sound) == "");
      CHECK(sound.cycles_s.size() == 50);
      CHECK(sound.lost == 0);
      CHECK(bench::quantile_s(sound, 0.5) <= bench::quantile_s(sound, 1));
      CHECK(bench::proposed_timeout_s(sound) >= 3 * bench::quantile_s(sound, 1));
    }
  }
  WHEN("its watchdog is off, idle or slow") {
    CHECK_THAT(bench::refusal_to_arm(probe({.comm_loss_timeout_s = 0})), Catch::Contains("is off"));
    CHECK_THAT(bench::refusal_to_arm(probe({.comm_loss_action = CommLossAction::ignore})),
               Catch::Contains("does not stop the motor"));
    CHECK_THAT(bench::refusal_to_arm(probe({.comm_loss_timeout_s = 2.1})),
               Catch::Contains("waits 2.1 s, at most 2 s"));
  }
  WHEN("nobody answers") {
    test::ModbusBench bench;
    bench.server.reset();
    const bench::DriveProbe absent = bench::probe_drive(bench.drive, 50, {});
    REQUIRE(absent.failed);
    CHECK(bench::refusal_to_arm(absent) != "");
  }
  WHEN("one reading in the middle has no answer, nor when it is asked again") {
    test::ModbusBench bench;
    bench.server->inject({.fault = WireFault::silent, .after_requests = 20, .requests = 2});
    const bench::DriveProbe lossy = bench::probe_drive(bench.drive, 50, {});
    CHECK(lossy.lost == 1);
    CHECK_THAT(bench::refusal_to_arm(lossy), Catch::Contains("lost"));
  }
}

TEST_CASE("the share of readings that were quicker is counted from the quickest",
          "[bench][probe]") {
  bench::DriveProbe probe;
  for (int i = 1; i <= 101; ++i) probe.cycles_s.push_back(0.001 * i);
  CHECK(bench::quantile_s(probe, 0.5) == Approx(0.051));
  CHECK(bench::quantile_s(probe, 0.99) == Approx(0.100));
  CHECK(bench::quantile_s(probe, 1) == Approx(0.101));
  CHECK(bench::proposed_timeout_s(probe) == Approx(0.303));
}

SCENARIO("pulling the plug proves that the drive stops when its link dies", "[bench][probe]") {
  std::vector<std::string> told;
  WHEN("its watchdog stops the motor") {
    test::ModbusBench bench({.comm_loss_timeout_s = 1});
    const bench::PlugTest test = pull(bench, 3, 12, told);
    INFO(test.finding);
    CHECK(test.passed);
    CHECK_THAT(test.finding, Catch::Contains("stopped by itself, fault code 1"));
    CHECK(told.size() == 4);
    THEN("nothing resumes by itself") {
      bench.wait_s(2);
      CHECK_FALSE(bench.model.output_enabled());
    }
  }
  WHEN("nothing stops the motor") {
    test::ModbusBench bench({.comm_loss_action = CommLossAction::ignore});
    const bench::PlugTest test = pull(bench, 3, 12, told);
    CHECK_FALSE(test.passed);
    CHECK_THAT(test.finding, Catch::Contains("still ran"));
    THEN("it is stopped all the same, now that it can be told") {
      CHECK(bench.model.state().run == sim::RunCommand::stop);
    }
  }
  WHEN("it trips before the cable is pulled") {
    test::ModbusBench bench({.comm_loss_timeout_s = 1});
    const bench::PlugTest test = pull(bench, 12, 20, told, [&] { bench.model.trip(7); });
    CHECK_FALSE(test.passed);
    CHECK_THAT(test.finding, Catch::Contains("stopped before the cable was pulled, fault code 7"));
  }
  WHEN("nobody pulls it") {
    test::ModbusBench bench;
    const bench::PlugTest test = pull(bench, 1e3, 1e3, told);
    CHECK_FALSE(test.passed);
    CHECK_THAT(test.finding, Catch::Contains("was not pulled within 20 s"));
    CHECK(bench.model.state().run == sim::RunCommand::stop);
  }
  WHEN("it is never plugged in again") {
    test::ModbusBench bench;
    const bench::PlugTest test = pull(bench, 3, 1e3, told);
    CHECK_FALSE(test.passed);
    CHECK_THAT(test.finding, Catch::Contains("did not come back"));
  }
}

SCENARIO("a rig file says where a real drive is", "[bench][rig]") {
  const std::string tcp = R"({"rig": "bench", "drive": {"profile": "delta_ms300",
    "tcp": {"host": "192.168.3.10"}, "max_speed_rpm": 1900, "pole_pairs": 2}})";
  CHECK(faults_of(tcp) == "");
  CHECK(faults_of(R"({"rig": "bench", "drive": {"profile": "siemens_v20",
    "serial": {"device": "/dev/ttyUSB0", "baud": 19200, "parity": "E"}, "unit_id": 3,
    "max_speed_rpm": 1900, "pole_pairs": 2, "rated_Hz": 60}})") == "");
  WHEN("it is wrong, all of it is told at once") {
    const std::string faults = faults_of(R"({"rig": "bench", "drive": {"profile": "delta_ms30",
      "tcp": {"host": "192.168.3.10", "port": 0},
      "serial": {"device": "/dev/ttyUSB0", "parity": "X"}, "pole_pairs": 0}})");
    CHECK_THAT(faults, Catch::Contains("/drive/profile: "));
    CHECK_THAT(faults, Catch::Contains("did you mean \"delta_ms300\"?"));
    CHECK_THAT(faults, Catch::Contains("/drive: expected one of \"tcp\" and \"serial\""));
    CHECK_THAT(faults, Catch::Contains("/drive/serial/parity: "));
    CHECK_THAT(faults, Catch::Contains("/drive/max_speed_rpm: this key is missing"));
    CHECK_THAT(faults, Catch::Contains("/drive/pole_pairs: 0 is below 1"));
  }
  WHEN("a host is no address") {
    CHECK_THAT(faults_of(R"({"rig": "bench", "drive": {"profile": "delta_ms300",
      "tcp": {"host": "inverter"}, "max_speed_rpm": 1900, "pole_pairs": 2}})"),
               Catch::Contains("\"inverter\" is not an IPv4 address"));
  }
}
