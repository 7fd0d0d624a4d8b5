#include "analysis/shaft_speed.hpp"

#include <catch2/catch.hpp>
#include <functional>

#include "tests/support/signals.hpp"

using namespace rvbench;
using analysis::shaft_speeds;
using analysis::ShaftLines;
using analysis::ShaftSpeed;
using Catch::Matchers::Contains;

namespace {

constexpr double two_pi = 2 * std::numbers::pi;
constexpr double nominal = 0.007;  // turns per sample
constexpr Eigen::Index block = 4096;
const std::vector<double> teeth{32.0 / 3, 64.0 / 3, 32, 128.0 / 3};

// A gearbox on a shaft whose angle is known exactly: lines of its teeth, each of its own strength
// and phase in each channel.
struct Gearbox {
  std::vector<double> orders = teeth;
  std::function<double(double)> turns = [](double i) { return nominal * i; };  // at sample i
  double noise = 0;
  double sidebands = 0;  // of each line, one turn of the shaft to both sides, unequal
  unsigned seed = 1;

  std::vector<Channel> channels(int count = 4, Eigen::Index size = 8 * block) const {
    std::mt19937 draw(seed);
    std::uniform_real_distribution<double> phase(0, two_pi), strength(0.5, 2);
    std::vector<Channel> all;
    for (int c = 0; c < count; ++c) {
      Eigen::VectorXd x = noise * test::white_noise(size, 100 * seed + static_cast<unsigned>(c));
      for (const double order : orders) {
        add_line(x, order, strength(draw), phase(draw));
        if (sidebands == 0) continue;
        add_line(x, order - 1, sidebands * strength(draw), phase(draw));
        add_line(x, order + 1, 0.3 * sidebands * strength(draw), phase(draw));
      }
      all.push_back({{"a" + std::to_string(c), "", "", not_known}, not_known, 0, x});
    }
    return all;
  }

  void add_line(Eigen::VectorXd& x, double order, double amplitude, double phase) const {
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      x[i] += amplitude * std::cos(two_pi * order * turns(double(i)) + phase);
    }
  }
};

ShaftLines near_nominal() { return {teeth, 1.01 * nominal}; }

// Standard deviation of the relative error of blocks at constant speed, and the mean error stated.
struct Errors {
  double made = 0, stated = 0;
};

Errors errors_of(const std::vector<ShaftSpeed>& speeds) {
  Errors errors;
  for (const ShaftSpeed& speed : speeds) {
    errors.made += std::pow(speed.turns_per_sample / nominal - 1, 2) / double(speeds.size());
    errors.stated += std::pow(speed.standard_error / nominal, 2) / double(speeds.size());
  }
  return {std::sqrt(errors.made), std::sqrt(errors.stated)};
}

}  // namespace

TEST_CASE("lines without noise tell the speed exactly", "[analysis][shaft_speed]") {
  const auto speeds = shaft_speeds(Gearbox().channels(), near_nominal(), block);
  REQUIRE(speeds.size() == 15);
  for (const ShaftSpeed& speed : speeds) {
    CHECK(speed.turns_per_sample == Approx(nominal).epsilon(1e-6));
    CHECK(speed.seen == teeth.size());
  }
}

TEST_CASE("the error that is stated is the error that is made", "[analysis][shaft_speed]") {
  Errors errors;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const Gearbox noisy{.noise = 5, .seed = seed};  // lines 8 to 20 dB below the noise
    const Errors once = errors_of(shaft_speeds(noisy.channels(), near_nominal(), block));
    errors.made += once.made / 10;
    errors.stated += once.stated / 10;
  }
  CHECK(errors.made < 2e-4);
  CHECK(errors.stated == Approx(errors.made).epsilon(0.35));
}

TEST_CASE("sidebands of a broken tooth do not pull the speed away", "[analysis][shaft_speed]") {
  const Gearbox broken{.noise = 2, .sidebands = 3};  // up to 10 dB above the lines themselves
  const auto speeds = shaft_speeds(broken.channels(), near_nominal(), block);
  CHECK(errors_of(speeds).made < 2e-4);
  for (const ShaftSpeed& speed : speeds) CHECK(speed.seen > teeth.size() / 2);
}

TEST_CASE("a speed that changes is followed block by block", "[analysis][shaft_speed]") {
  // Slows down by 0.5 % over the record: the mean speed of a block is that of its middle.
  const double end = 8 * block;
  const Gearbox slowing{.turns = [&](double i) { return nominal * (i - 0.0025 * i * i / end); },
                        .noise = 1};
  const auto speeds = shaft_speeds(slowing.channels(), near_nominal(), block);
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    const double middle = 0.5 * block * (double(i) + 1);
    CHECK(speeds[i].turns_per_sample ==
          Approx(nominal * (1 - 0.005 * middle / end)).epsilon(1.5e-4));
  }
}

TEST_CASE("one channel with one line swamped still tells the speed", "[analysis][shaft_speed]") {
  Gearbox machine{.noise = 1};
  auto channels = machine.channels(1);
  machine.add_line(channels[0].samples, 32.3, 100, 0);  // a neighbour's line, within the search
  for (const ShaftSpeed& speed : shaft_speeds(channels, near_nominal(), block)) {
    CHECK(speed.turns_per_sample == Approx(nominal).epsilon(4e-4));
  }
}

TEST_CASE("where the lines are not there, no speed is told", "[analysis][shaft_speed][null]") {
  const auto untold = [](const std::vector<Channel>& channels) {
    std::size_t count = 0;
    for (unsigned i = 0; const ShaftSpeed& speed : shaft_speeds(channels, near_nominal(), block)) {
      INFO("block " << i++);
      CHECK(std::isnan(speed.turns_per_sample));
      CHECK(std::isnan(speed.standard_error));
      count += 1;
    }
    return count;
  };
  SECTION("noise alone") {
    Gearbox noise{.orders = {}, .noise = 1};
    for (noise.seed = 1; noise.seed <= 10; ++noise.seed) CHECK(untold(noise.channels()) == 15);
  }
  SECTION("teeth of another gearbox") {
    CHECK(untold(Gearbox{.orders = {13, 19, 27, 47}, .noise = 1}.channels()) == 15);
  }
  SECTION("one line alone is no family") {
    CHECK(untold(Gearbox{.orders = {32}, .noise = 1}.channels()) == 15);
  }
  SECTION("silence") { CHECK(untold(Gearbox{.orders = {}}.channels()) == 15); }
}

TEST_CASE("a lost sample costs the blocks that it is in, and no others",
          "[analysis][shaft_speed]") {
  auto channels = Gearbox().channels(2);
  channels[1].samples[3 * block] = not_known;
  const auto speeds = shaft_speeds(channels, near_nominal(), block);
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    CHECK(std::isnan(speeds[i].turns_per_sample) == (i == 5 || i == 6));
  }
}

TEST_CASE("too short a record has no block", "[analysis][shaft_speed]") {
  CHECK(shaft_speeds(Gearbox().channels(1, block - 1), near_nominal(), block).empty());
}

TEST_CASE("what cannot be searched is refused by name", "[analysis][shaft_speed]") {
  const auto channels = Gearbox().channels(1, 512);
  const auto refuses = [&](const ShaftLines& lines, Eigen::Index size, const char* why) {
    CHECK_THROWS_WITH(shaft_speeds(channels, lines, size), Contains(why));
  };
  refuses({{}, nominal}, 128, "no order");
  refuses({{-1}, nominal}, 128, "an order must be > 0");
  refuses({{72}, nominal}, 128, "beyond half the sample rate");
  refuses({teeth, 0}, 128, "turns_per_sample must be > 0");
  refuses({teeth, nominal, 0.5}, 128, "within must be in (0, 0.5)");
  refuses({teeth, nominal}, 63, "a block needs 64 samples");
  CHECK_THROWS_WITH(shaft_speeds({}, near_nominal(), 128), Contains("no channel"));
  auto unequal = channels;
  unequal.push_back(unequal[0]);
  unequal[1].samples.conservativeResize(500);
  CHECK_THROWS_WITH(shaft_speeds(unequal, near_nominal(), 128), Contains("unequal lengths"));
}
