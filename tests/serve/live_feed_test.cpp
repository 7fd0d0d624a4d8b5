#include "bench/serve/live_feed.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "bench/serve/event_hub.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/wait_until.hpp"

namespace rvbench::bench {
namespace {

// The first letter of that kind that comes.
nlohmann::json letter_of(LiveSocket& mailbox, const std::string& kind) {
  nlohmann::json found;
  (void)rvbench::test::wait_until([&] {
    while (const auto letter = mailbox.next()) {
      auto json = nlohmann::json::parse(*letter);
      if (json.at("kind") == kind) {
        found = std::move(json);
        return true;
      }
    }
    return false;
  });
  return found;
}

}  // namespace

TEST_CASE("a run's feed tells means, the liveliest channel and its spectrum", "[bench][serve]") {
  const rvbench::test::ScratchFolder scratch;
  LiveSocket mailbox = LiveSocket::open(scratch / "live.sock");
  LiveFeed feed(LiveSocket::to(scratch / "live.sock"), "A17/20260102T030405Z", 3);

  // 1200 rpm for 0.1 s at a torque that swings about 3 N·m.
  hal::TorqueBlock torque;
  torque.t0_s = 10;
  for (int i = 0; i < 100; ++i) {
    torque.samples.push_back({3 + (i % 2 == 0 ? 0.5 : -0.5), i * 1e-3 * 40 * std::numbers::pi});
  }
  // A tone of 1 g amplitude on line 100, beside a channel that only stands 2 g off.
  constexpr int scans = LiveFeed::spectrum_samples;
  constexpr double g = 9.80665, rate_Hz = 4096;
  hal::AccelerationBlock acceleration;
  acceleration.t0_s = 10;
  acceleration.scans.resize(scans, 2);
  for (int i = 0; i < scans; ++i) {
    acceleration.scans(i, 0) = float(g * std::sin(2 * std::numbers::pi * 100 * i / scans));
    acceleration.scans(i, 1) = float(2 * g);
  }
  feed.take_temperature(31.5);
  feed.take(torque, 1000);
  feed.take(acceleration, rate_Hz, "accel_1x");

  const auto strip = letter_of(mailbox, "strip");
  CHECK(strip.at("torque_Nm").get<double>() == Approx(3));
  CHECK(strip.at("speed_rpm").get<double>() == Approx(1200));
  CHECK(strip.at("temperature_C").get<double>() == Approx(31.5));
  CHECK(strip.at("vibration_g").get<double>() == Approx(1 / std::numbers::sqrt2).epsilon(1e-3));
  CHECK(strip.at("t_s").get<double>() == Approx(10.25));

  const auto spectrum = letter_of(mailbox, "spectrum");
  CHECK(spectrum.at("channel") == "accel_1x");
  CHECK(spectrum.at("step_Hz").get<double>() == Approx(4));
  const auto levels = spectrum.at("levels_dB").get<std::vector<double>>();
  REQUIRE(levels.size() == scans / 2 + 1);
  CHECK(levels[100] == Approx(0).margin(0.11));  // dB re 1 g
  CHECK(levels[300] < -80);
}

TEST_CASE("no spectrum is made of samples on both sides of a hole", "[bench][serve]") {
  const rvbench::test::ScratchFolder scratch;
  LiveSocket mailbox = LiveSocket::open(scratch / "live.sock");
  LiveFeed feed(LiveSocket::to(scratch / "live.sock"), "A17/20260102T030405Z", 3);
  constexpr int scans = LiveFeed::spectrum_samples;
  constexpr double g = 9.80665, rate_Hz = 4096, half_s = scans / 2 / rate_Hz;
  const auto take = [&](double t0_s, double amplitude_m_s2) {
    hal::AccelerationBlock half;
    half.t0_s = t0_s;
    half.scans.resize(scans / 2, 1);
    for (int i = 0; i < scans / 2; ++i) {
      half.scans(i, 0) = float(amplitude_m_s2 * std::sin(2 * std::numbers::pi * 100 * i / scans));
    }
    feed.take(half, rate_Hz, "accel_1x");
  };
  take(10, 0);
  take(10 + 2 * half_s, g);  // between them one was not waited for
  take(10 + 3 * half_s, g);
  const auto levels = letter_of(mailbox, "spectrum").at("levels_dB").get<std::vector<double>>();
  CHECK(levels.at(100) == Approx(0).margin(0.11));  // dB re 1 g; with the silence it would be -6
}

// As a clock that is estimated better and better moves them.
TEST_CASE("time stamps that move by half a sample are no hole", "[bench][serve]") {
  const double moved = GENERATE(-0.5, 0.5);
  const rvbench::test::ScratchFolder scratch;
  LiveSocket mailbox = LiveSocket::open(scratch / "live.sock");
  LiveFeed feed(LiveSocket::to(scratch / "live.sock"), "A17/20260102T030405Z", 3);
  constexpr int blocks = 16, scans = LiveFeed::spectrum_samples / blocks;
  constexpr double rate_Hz = 25600;
  hal::AccelerationBlock block;
  block.t0_s = 10;
  block.scans.resize(scans, 1);
  block.scans.setConstant(float(9.80665));
  for (int i = 0; i < blocks; ++i) {
    feed.take(block, rate_Hz, "accel_1x");
    block.t0_s += (scans + moved) / rate_Hz;
  }
  CHECK_FALSE(letter_of(mailbox, "spectrum").is_null());
}

TEST_CASE("a feed tells how far the run and each point is, and where nothing came no strip",
          "[bench][serve]") {
  const rvbench::test::ScratchFolder scratch;
  LiveSocket mailbox = LiveSocket::open(scratch / "live.sock");
  {
    LiveFeed feed(LiveSocket::to(scratch / "live.sock"), "A17/20260102T030405Z", 4);
    feed.progress("measure", 0.25, std::nan(""), "record 1210 rpm");
    feed.begin_point(0);
    feed.end_point(0, true);
    feed.begin_point(1);
    feed.end_point(1, false);
    feed.begin_point(2);
    feed.begin_point(9);  // of no such point nothing is told
  }
  std::string last;
  while (const auto letter = mailbox.next()) {
    last = *letter;
    CHECK(nlohmann::json::parse(last).at("kind") == "state");
  }
  const auto state = nlohmann::json::parse(last);
  CHECK(state.at("run") == "A17/20260102T030405Z");
  CHECK(state.at("stage") == "measure");
  CHECK(state.at("done").get<double>() == Approx(0.25));
  CHECK(state.at("left_s").is_null());
  CHECK(state.at("points") == "dfmo");
}

TEST_CASE("a mailbox that nobody has, or that nobody empties, holds up nobody", "[bench][serve]") {
  const rvbench::test::ScratchFolder scratch;
  LiveSocket sender = LiveSocket::to(scratch / "live.sock");
  CHECK_FALSE(sender.send("lost"));
  {
    LiveSocket mailbox = LiveSocket::open(scratch / "live.sock");
    int sent = 0;
    while (sender.send(std::string(1000, 'x')) && sent < 100000) ++sent;
    CHECK(sent > 0);
    CHECK(sent < 100000);  // then it was full
    CHECK_FALSE(sender.send(std::string(200000, 'x')));
    CHECK(mailbox.next().value_or("").size() == 1000);
  }
  CHECK_FALSE(sender.send("lost"));
  LiveSocket again = LiveSocket::open(scratch / "live.sock");  // as after a restart
  CHECK(sender.send("heard"));
  CHECK(again.next() == "heard");
  CHECK_FALSE(again.next());
  CHECK_THROWS_AS(LiveSocket::to(scratch / "no folder" / "live.sock"), std::system_error);
}

TEST_CASE("a listener is told what came after what it knows, or that it has missed some",
          "[bench][serve]") {
  EventHub hub;
  CHECK(hub.wait_after(0, 0).events.empty());
  hub.publish("strip", "{}");
  hub.publish("state", "");
  const auto news = hub.wait_after(0, 0);
  REQUIRE(news.events.size() == 2);
  CHECK(news.events[1].name == "state");
  CHECK_FALSE(news.has_hole);
  CHECK(hub.wait_after(hub.newest(), 0).events.empty());
  for (std::size_t i = 0; i < EventHub::kept; ++i) hub.publish("strip", "{}");
  CHECK(hub.wait_after(1, 0).has_hole);
  CHECK_FALSE(hub.wait_after(2, 0).has_hole);
  CHECK(hub.strips().size() == EventHub::kept_strips);
  hub.forget_strips();
  CHECK(hub.strips().empty());
  hub.close();
  CHECK(hub.wait_after(hub.newest(), 60).is_over);
}

}  // namespace rvbench::bench
