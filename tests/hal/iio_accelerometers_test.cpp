#include "hal/daq/iio_accelerometers.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include "hal/steady_clock.hpp"
#include "sim/iio_server.hpp"
#include "tests/support/wait_until.hpp"

using namespace rvbench;
using hal::IioOptions;
using sim::IioServer;

namespace {

constexpr double rate_Hz = 5000;

// A front end of four inputs that counts scans; sends ten of them every 2 ms.
class CountingDaq {
 public:
  using Attributes = std::map<std::string, std::string>;

  explicit CountingDaq(Attributes attributes = {})
      : server_(std::make_unique<IioServer>(front_end(std::move(attributes)))) {
    go_on();
  }
  ~CountingDaq() { pause(); }

  void go_on() {
    thread_ = std::jthread([this](const std::stop_token& stop) {
      for (double due_s = clock_.now_s(); !stop.stop_requested(); due_s += 0.002) {
        clock_.wait_until(due_s);
        hal::AccelerationBlock::Scans scans(10, 4);
        for (int i = 0; i < 10; ++i, ++scan_) {
          for (int input = 0; input < 4; ++input) {
            scans(i, input) = float(scan_ % 10'000) / 100 + float(input) * 1000;
          }
        }
        server_->push(scans);
      }
    });
  }
  void pause() {
    thread_.request_stop();
    if (thread_.joinable()) thread_.join();
  }
  void vanish() {
    pause();
    server_.reset();
  }
  std::uint16_t port() const { return server_->port(); }

 private:
  static sim::IioFrontEnd front_end(Attributes attributes) {
    sim::IioFrontEnd daq;
    daq.attributes = std::move(attributes);
    daq.rate_Hz = rate_Hz;
    daq.m_s2_per_count = 0.001;
    daq.labels = {"a", "b", "c", "d"};
    return daq;
  }

  hal::SteadyClock clock_;
  std::unique_ptr<IioServer> server_;
  long scan_ = 0;
  std::jthread thread_;
};

IioOptions options(std::uint16_t port) {
  IioOptions options;
  options.uri = "ip:127.0.0.1:" + std::to_string(port);
  options.device = "rvbench-daq";
  options.rate_Hz = rate_Hz;
  options.deadline_s = 2;  // this computer may be busy elsewhere
  for (const int input : {0, 3}) {
    hal::DaqInput daq;
    daq.device_channel = "accel" + std::to_string(input);
    daq.info = {"accel_" + std::to_string(input), "m/s²", "+X"};
    options.inputs.push_back(daq);
  }
  return options;
}

struct Connected {
  explicit Connected(const IioOptions& how) : accelerometers(make_iio_accelerometers(how, clock)) {}

  // Reads until so many scans are there.
  hal::AccelerationBlock::Scans read(Eigen::Index count) {
    hal::AccelerationBlock::Scans all(0, 2);
    CHECK(test::wait_until([&] {
      const auto block = accelerometers->read();
      INFO((block ? "" : describe(block.error())));
      REQUIRE(block);
      const Eigen::Index before = all.rows();
      all.conservativeResize(before + block.value().scans.rows(), 2);
      all.bottomRows(block.value().scans.rows()) = block.value().scans;
      return all.rows() >= count;
    }));
    return all;
  }
  // Reads until an error comes.
  IoError error() {
    IoError found{IoErrc::refused, "no error came"};
    CHECK(test::wait_until([&] {
      const auto block = accelerometers->read();
      if (!block) found = block.error();
      return !block;
    }));
    return found;
  }

  hal::SteadyClock clock;
  std::unique_ptr<hal::StreamedAccelerometers> accelerometers;
};

void check_in_a_row(const hal::AccelerationBlock::Scans& scans) {
  const long first = std::lround(double(scans(0, 0)) * 100);
  for (Eigen::Index i = 0; i < scans.rows(); ++i) {
    REQUIRE(std::lround(double(scans(i, 0)) * 100) == (first + i) % 10'000);
    REQUIRE(double(scans(i, 1) - scans(i, 0)) == Approx(3000).margin(0.01));
  }
}

}  // namespace

TEST_CASE("every scan of the chosen inputs comes, in physical units", "[hal][daq]") {
  const CountingDaq daq;
  Connected bench(options(daq.port()));
  CHECK_FALSE(bench.accelerometers->read());
  CHECK_FALSE(bench.accelerometers->start());
  REQUIRE(bench.accelerometers->connect());
  CHECK(bench.accelerometers->rate_Hz() == rate_Hz);
  CHECK(bench.accelerometers->hole_told_after_s() == 2.5);  // a record waits for it
  CHECK(bench.accelerometers->range_m_s2() == 490);
  CHECK(bench.accelerometers->channels().at(1).name == "accel_3");
  REQUIRE(bench.accelerometers->start());
  check_in_a_row(bench.read(5000));
  bench.accelerometers->stop();
  CHECK_FALSE(bench.accelerometers->read());
  REQUIRE(bench.accelerometers->start());
  check_in_a_row(bench.read(1000));
}

TEST_CASE("time stamps are those of the rig's clock, and go on", "[hal][daq]") {
  const CountingDaq daq;
  Connected bench(options(daq.port()));
  REQUIRE(bench.accelerometers->connect());
  REQUIRE(bench.accelerometers->start());
  double end_s = not_known;
  double time_uncertainty_s = not_known;
  const double until_s = bench.clock.now_s() + 4;
  while (bench.clock.now_s() < until_s) {
    bench.clock.wait_until(bench.clock.now_s() + 0.001);
    const auto block = bench.accelerometers->read();
    INFO((block ? "" : describe(block.error())));
    REQUIRE(block);
    if (block.value().scans.rows() == 0) continue;
    time_uncertainty_s = block.value().time_uncertainty_s;
    if (std::isfinite(end_s)) CHECK(block.value().t0_s == Approx(end_s).margin(1 / rate_Hz));
    end_s = block.value().t0_s + double(block.value().scans.rows()) / rate_Hz;
    CHECK(end_s <= bench.clock.now_s() + 0.05);  // the first block may have been late
  }
  CHECK(end_s >= bench.clock.now_s() - 1);  // a busy computer may be late with the last block
  CHECK(time_uncertainty_s > 0);            // told from the third second on
  CHECK(time_uncertainty_s < 0.2);
}

TEST_CASE("the converter's full scale counts where it is below the sensors'", "[hal][daq]") {
  const CountingDaq daq;
  IioOptions how = options(daq.port());
  how.range_m_s2 = 1e9;
  Connected bench(how);
  REQUIRE(bench.accelerometers->connect());
  CHECK(bench.accelerometers->range_m_s2() == Approx(0.001 * 2147483647));
}

TEST_CASE("a converter whose middle is moved reaches less far on one side", "[hal][daq]") {
  const CountingDaq daq(CountingDaq::Attributes{{"offset", "1000000000"}});
  IioOptions how = options(daq.port());
  how.range_m_s2 = 1e9;
  Connected bench(how);
  REQUIRE(bench.accelerometers->connect());
  CHECK(bench.accelerometers->range_m_s2() == Approx(0.001 * (2147483648 - 1000000000)));
  REQUIRE(bench.accelerometers->start());
  const auto scans = bench.read(1);
  CHECK(double(scans(0, 0)) == Approx(1e6 + 50).margin(51));
}

TEST_CASE("what a channel's counts mean is read, and never guessed", "[hal][daq]") {
  const auto error_with = [](const CountingDaq::Attributes& attributes) {
    const CountingDaq daq(attributes);
    Connected bench(options(daq.port()));
    const auto status = bench.accelerometers->connect();
    REQUIRE_FALSE(status);
    return describe(status.error());
  };
  SECTION("a scale that cannot be read") {
    CHECK_THAT(error_with({{"scale", ""}}),
               Catch::Contains("accel0: scale: Input/output error") && Catch::Contains("refused"));
  }
  SECTION("an offset that cannot be read") {
    CHECK_THAT(error_with({{"offset", ""}}), Catch::Contains("accel0: offset: Input/output error"));
  }
  SECTION("a scale that is no number") {
    CHECK_THAT(error_with({{"scale", "0.001 m/s"}}),
               Catch::Contains("accel0: scale: expected a number, found \"0.001 m/s\""));
    CHECK_THAT(error_with({{"scale", "nan"}}), Catch::Contains("accel0: scale: expected a number"));
  }
  SECTION("an offset that is no number") {
    CHECK_THAT(error_with({{"offset", "middle"}}),
               Catch::Contains("accel0: offset: expected a number, found \"middle\""));
  }
}

TEST_CASE("a front end that tells m/s² by itself is given no sensitivity", "[hal][daq]") {
  const CountingDaq daq;
  IioOptions how = options(daq.port());
  how.inputs[1].info.sensitivity = 0.01;
  Connected bench(how);
  const auto status = bench.accelerometers->connect();
  REQUIRE_FALSE(status);
  CHECK_THAT(status.error().where, Catch::Contains("accel3: it tells m/s²"));
}

TEST_CASE("what is not there is told with what is", "[hal][daq]") {
  const CountingDaq daq;
  IioOptions how = options(daq.port());
  SECTION("a device") {
    how.device = "rvbench-dac";
    Connected bench(how);
    const auto status = bench.accelerometers->connect();
    REQUIRE_FALSE(status);
    CHECK(status.error().code == IoErrc::refused);
    CHECK_THAT(status.error().where, Catch::Contains("no device \"rvbench-dac\"") &&
                                         Catch::Contains("there is: rvbench-daq"));
  }
  SECTION("an input") {
    how.inputs[1].device_channel = "accel4";
    Connected bench(how);
    const auto status = bench.accelerometers->connect();
    REQUIRE_FALSE(status);
    CHECK_THAT(status.error().where,
               Catch::Contains("no input \"accel4\"") && Catch::Contains("accel0, accel1"));
  }
  SECTION("a server") {
    how.uri = "ip:127.0.0.1:1";
    Connected bench(how);
    const auto status = bench.accelerometers->connect();
    REQUIRE_FALSE(status);
    CHECK(status.error().code == IoErrc::disconnected);
    CHECK_THAT(status.error().where, Catch::Contains("accelerometers ip:127.0.0.1:1: connect"));
  }
}

TEST_CASE("a front end that falls silent is late, one that is gone is lost", "[hal][daq]") {
  CountingDaq daq;
  Connected bench(options(daq.port()));
  REQUIRE(bench.accelerometers->connect());
  REQUIRE(bench.accelerometers->start());
  bench.read(100);
  SECTION("silent") {
    daq.pause();
    CHECK(bench.error().code == IoErrc::timeout);
  }
  SECTION("gone") {
    daq.vanish();
    const IoErrc code = bench.error().code;
    CHECK((code == IoErrc::disconnected || code == IoErrc::timeout));
    CHECK_FALSE(bench.accelerometers->connect());
  }
}

TEST_CASE("a front end with options that make no sense is the caller's bug", "[hal][daq]") {
  hal::SteadyClock clock;
  const auto bad = [&](void (*spoil)(IioOptions&)) {
    IioOptions how = options(1);
    spoil(how);
    CHECK_THROWS_AS(make_iio_accelerometers(how, clock), std::invalid_argument);
  };
  bad([](IioOptions& how) { how.uri.clear(); });
  bad([](IioOptions& how) { how.device.clear(); });
  bad([](IioOptions& how) { how.inputs.clear(); });
  bad([](IioOptions& how) { how.inputs[0].info.sensitivity = 0; });
  bad([](IioOptions& how) { how.rate_Hz = 0; });
  bad([](IioOptions& how) { how.range_m_s2 = -1; });
  bad([](IioOptions& how) { how.block_s = 1; });
  bad([](IioOptions& how) { how.deadline_s = 0; });
}
