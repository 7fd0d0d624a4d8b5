#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "analysis/compare/comparison.hpp"
#include "analysis/compare/headlines.hpp"
#include "tests/analysis/compare/compared_records.hpp"
#include "tests/support/under_sanitizer.hpp"

// How often something is said to have changed where nothing has.
namespace rvbench::analysis {
namespace {

using test::compared;
using test::repeats;

// The stated rate, and three standard deviations of the count to either side.
double most_of(double rate, int draws) { return rate * draws + 3 * std::sqrt(rate * draws); }
double fewest_of(double rate, int draws) { return rate * draws - 3 * std::sqrt(rate * draws); }

// Draws in which a change was called: of what is seen, and of the noise where no line is.
struct Calls {
  int seen = 0, noise = 0;

  void add(const Comparison& c) {
    const ChangeCounts counts = counts_of(c);
    seen += counts.changed > 0 ? 1 : 0;
    noise += counts.noise_changed > 0 ? 1 : 0;
  }
};

// A matrix of levels without records: strong lines scatter by their own amount, weak ones as noise
// does.
std::vector<RecordLevels> drawn_matrix(int points, int repeats, std::size_t quantities,
                                       std::mt19937& engine) {
  std::normal_distribution<double> gaussian;
  std::exponential_distribution<double> noise_power;
  std::vector<RecordLevels> records;
  for (int point = 0; point < points; ++point) {
    for (int repeat = 0; repeat < repeats; ++repeat) {
      RecordLevels record;
      record.source = "drawn";
      record.speed_rpm = record.measured_rpm = 600;
      record.load_pct = 25 * point;
      for (const char* name : {"accel_1x", "accel_1y", "accel_1z"}) {
        ChannelLevels channel{{name, "m/s²", "", not_known}, 2000, 10, {}};
        for (std::size_t q = 0; q < quantities; ++q) {
          const bool strong = q % 3 != 0;
          const double scatter_dB = 0.05 * std::pow(4.0, double(q % 4)) * (1 + point % 2);
          const double power = noise_power(engine);
          Level level;
          level.whole_dB = strong ? 10 + scatter_dB * gaussian(engine) : 10 * std::log10(power);
          level.above_floor_dB = strong ? 30 : 0;
          level.p_value = strong ? 0 : std::exp(-power);
          channel.levels.push_back(level);
        }
        record.channels.push_back(channel);
      }
      records.push_back(record);
    }
  }
  return records;
}

}  // namespace

TEST_CASE("a matrix in which nothing changed is called changed once in twenty", "[analysis]") {
  const std::vector<Quantity> quantities = quantities_to_compare(test::small_gear());
  std::mt19937 engine(11);
  Calls calls;
  constexpr int draws = 300;
  for (int i = 0; i < draws; ++i) {
    const auto a = drawn_matrix(4, 3, quantities.size(), engine);
    const auto b = drawn_matrix(4, 3, quantities.size(), engine);
    calls.add(compare(a, b, quantities, {.least_dB = 0}));
  }
  CHECK(calls.seen <= most_of(0.05, draws));
  CHECK(calls.noise <= most_of(0.05, draws));
}

TEST_CASE("two draws of one unit are called changed once in twenty at most", "[analysis]") {
  if (test::too_long_under_sanitizer()) return;
  const auto count = GENERATE(1u, 2u, 3u);  // repeats
  Calls calls;
  constexpr int draws = 100;
  for (unsigned seed = 0; seed < draws; ++seed) {
    const double scatter_dB = count > 1 ? 0.2 : 0;
    const test::GearRecord unit{.scatter_dB = scatter_dB, .count = 7000};
    const Comparison c = compared(repeats(unit, count, 2 * seed + 1),
                                  repeats(unit, count, 2 * seed + 2), {.least_dB = 0});
    calls.add(c);
  }
  INFO(count << " repeats");
  CHECK(calls.seen <= most_of(0.05, draws));
  CHECK(calls.noise <= most_of(0.05, draws));
}

TEST_CASE("where scatter is of one size nothing is called changed more rarely than stated",
          "[analysis]") {
  // Then all estimates are of one variance, tests are independent, and the rate is exact.
  const std::vector<Quantity> quantities = quantities_to_compare(test::small_gear());
  std::mt19937 engine(23);
  std::normal_distribution<double> gaussian;
  const auto draw = [&] {
    auto records = drawn_matrix(4, 3, quantities.size(), engine);
    for (RecordLevels& record : records) {
      for (ChannelLevels& channel : record.channels) {
        for (Level& level : channel.levels) {
          level = {.whole_dB = 10 + gaussian(engine), .above_floor_dB = 30, .p_value = 0};
        }
      }
    }
    return records;
  };
  Calls calls;
  constexpr int draws = 300;
  for (int i = 0; i < draws; ++i) calls.add(compare(draw(), draw(), quantities, {.least_dB = 0}));
  CHECK(calls.seen <= most_of(0.05, draws));
  CHECK(calls.seen >= fewest_of(0.05, draws));
}

TEST_CASE("of many changes one in twenty is false at most", "[analysis]") {
  const std::vector<Quantity> quantities = quantities_to_compare(test::small_gear());
  std::mt19937 engine(13);
  double called = 0, falsely = 0;
  for (int i = 0; i < 60; ++i) {
    const auto a = drawn_matrix(4, 3, quantities.size(), engine);
    auto b = drawn_matrix(4, 3, quantities.size(), engine);
    for (RecordLevels& record : b) {
      for (ChannelLevels& channel : record.channels) channel.levels[4].whole_dB += 6;
    }
    for (const Change& change : compare(a, b, quantities, {.least_dB = 0}).changes) {
      if (!change.seen || change.word != ChangeWord::changed) continue;
      ++called;
      falsely += change.quantity != 4 ? 1 : 0;
    }
  }
  CHECK(called > 60 * 12 * 0.9);  // nearly all that are true
  CHECK(falsely <= 0.06 * called);
}

TEST_CASE("noise that rose at every place of no line lends no line a change", "[analysis]") {
  const std::vector<Quantity> quantities = quantities_to_compare(test::small_gear());
  std::mt19937 engine(17);
  Calls calls;
  constexpr int draws = 200;
  for (int i = 0; i < draws; ++i) {
    const auto a = drawn_matrix(4, 3, quantities.size(), engine);
    auto b = drawn_matrix(4, 3, quantities.size(), engine);
    for (RecordLevels& record : b) {
      for (ChannelLevels& channel : record.channels) {
        for (std::size_t q = 0; q < quantities.size(); ++q) {
          Level& level = channel.levels[q];
          if (quantities[q].is_line() && level.p_value > 0) level.whole_dB += 30;
        }
      }
    }
    calls.add(compare(a, b, quantities, {.least_dB = 0}));
  }
  CHECK(calls.noise == draws);
  CHECK(calls.seen <= most_of(0.05, draws));
}

TEST_CASE("a line is no likelier to have changed because it is just seen", "[analysis]") {
  // Powers of one record each, of one distribution and about as high as is seen: one is more than
  // nine times the other in a fifth of all pairs, and so it must be in those that are seen.
  const std::vector<Quantity> quantities = quantities_to_compare(test::small_gear());
  std::mt19937 engine(19);
  std::exponential_distribution<double> power_drawn(1.0 / 6);
  const auto draw = [&] {
    auto records = drawn_matrix(1, 1, quantities.size(), engine);
    for (ChannelLevels& channel : records.front().channels) {
      for (Level& level : channel.levels) {
        const double power = power_drawn(engine);
        level.whole_dB = 10 * std::log10(power);
        level.p_value = std::exp(-power);
      }
    }
    return records;
  };
  int seen = 0, far_apart = 0;
  for (int i = 0; i < 300; ++i) {
    for (const Change& change : compare(draw(), draw(), quantities).changes) {
      if (!change.seen || !quantities[change.quantity].is_line()) continue;
      ++seen;
      far_apart += std::abs(change.change_dB) > 10 * std::log10(9.0) ? 1 : 0;
    }
  }
  REQUIRE(seen > 1000);
  CHECK(far_apart == Approx(0.2 * seen).margin(3 * std::sqrt(0.16 * seen)));
}

}  // namespace rvbench::analysis
