#include "bench/programme_cells.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace rvbench;
using analysis::LockedTo;
using bench::ProgrammeRecord;

namespace {

constexpr int samples = 2400;
constexpr double length_s = 6;

std::vector<sim::OutputSpec> force() {
  sim::OutputSpec output;
  output.channel = "force";
  output.unit = "N";
  return {output};
}

// Repeats of a cycle of 6 s, of which 0.5 s was left out, that are off by noise of 1 N.
std::vector<ProgrammeRecord> repeats(int count, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  std::vector<ProgrammeRecord> records;
  for (int i = 0; i < count; ++i) {
    records.push_back({"cycle", 0.5, length_s, {Eigen::VectorXd::NullaryExpr(samples, [&] {
                         return normal(engine);
                       })}});
  }
  return records;
}

std::vector<analysis::ResidualCluster> places(const std::vector<ProgrammeRecord>& records) {
  const bench::Twin::Cells cells = bench::programme_cells(force(), records);
  return analysis::locate(cells.all, cells.beside);
}

}  // namespace

TEST_CASE("what every repeat is off by is found at its time of the programme",
          "[bench][explain][locate]") {
  std::vector<ProgrammeRecord> records = repeats(4, 1);
  // From 2 to 3 s of what is compared, 2.5 to 3.5 s of the programme.
  for (ProgrammeRecord& record : records) record.apart[0].segment(800, 400).array() += 0.6;
  const auto found = places(records);
  REQUIRE(!found.empty());
  CHECK(found[0].channel == "force");
  CHECK(found[0].locked_to == LockedTo::programme);
  CHECK(found[0].first == Approx(2.625));
  CHECK(found[0].last == Approx(3.375));
  CHECK(found[0].apart == Approx(0.6).margin(0.2));
  CHECK(found[0].conditions == std::vector<std::string>{"cycle"});
}

TEST_CASE("noise that no repeat shares is found nowhere, but once in twenty times",
          "[bench][explain][locate]") {
  int false_alarms = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed)
    false_alarms += !places(repeats(4, seed)).empty();
  CHECK(false_alarms <= 18);  // 10 expected; 18 and more have a probability of 1 %
}

TEST_CASE("what a stretch differs by from repeat to repeat is told", "[bench][explain][locate]") {
  const bench::Twin::Cells cells = bench::programme_cells(force(), repeats(4, 3));
  REQUIRE(cells.noise.size() == 1);
  // Means over 0.25 s, 100 samples of 1 N; of 72 degrees of freedom within 20 %.
  CHECK(cells.noise[0].standard_deviation == Approx(0.1).epsilon(0.2));
  CHECK(cells.noise[0].of == "mean over 0.25 s, from repeat to repeat of cycle");
  CHECK(cells.all.size() == 24);
}

TEST_CASE("repeats that are too few to tell chance by have no cells", "[bench][explain][locate]") {
  CHECK(bench::programme_cells(force(), repeats(1, 1)).all.empty());
  CHECK(bench::programme_cells(force(), repeats(2, 1)).all.empty());  // 24 degrees of freedom
  CHECK(bench::programme_cells(force(), repeats(3, 1)).all.size() == 24);
  CHECK(bench::programme_cells(force(), {}).all.empty());
}
