#include "bench/sound_units.hpp"

#include <catch2/catch.hpp>

#include "bench/text_file.hpp"
#include "tests/bench/answers.hpp"
#include "tests/bench/entered_run.hpp"
#include "tests/bench/judgements.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/signals.hpp"

namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;
using rvbench::test::ScratchFolder;

analysis::Kinematics one_part() {
  analysis::Kinematics k;
  analysis::Signature part;
  part.component = "shaft";
  part.mechanism = "bend";
  part.depth_limit = 0.5;
  k.signatures = {part};
  return k;
}

analysis::Diagnosis unit(double severity, double visible = 0.001) {
  analysis::Finding finding;
  finding.component = "shaft";
  finding.mechanism = "bend";
  finding.severity = severity;
  finding.smallest_visible = visible;
  analysis::Diagnosis diagnosis;
  diagnosis.below_limit = {finding};
  return diagnosis;
}

std::vector<analysis::Diagnosis> units_like(double mean, double scatter, int count) {
  std::vector<analysis::Diagnosis> units;
  const Eigen::VectorXd noise = rvbench::test::white_noise(count, 11);
  for (const double x : noise) units.push_back(unit(mean + scatter * x));
  return units;
}

double limit_by(const std::vector<analysis::Diagnosis>& units) {
  return with_sound_units(one_part(), units).signatures[0].depth_limit;
}

std::string why_no_files(const std::vector<std::string>& words) {
  const auto found = sound_files(words, "no_runs");
  return found.index() == 1 ? std::get<1>(found) : "";
}

}  // namespace

TEST_CASE("sound units set the limit above their own scatter", "[bench][sound]") {
  const double limit = limit_by(units_like(0.2, 0.01, 40));
  CHECK(limit > 0.2 + 3 * 0.01);
  CHECK(limit < 0.2 + 6 * 0.01);
}

TEST_CASE("a bad unit among twenty sound ones moves the limit by less than a tenth",
          "[bench][sound]") {
  auto units = units_like(0.2, 0.01, 20);
  const double clean = limit_by(units);
  units[7] = unit(1.5);
  CHECK(limit_by(units) == Approx(clean).epsilon(0.1));
}

TEST_CASE("of few units each counts, and their limit is wider", "[bench][sound]") {
  std::vector<analysis::Diagnosis> few, many;
  for (int i = 0; i < 40; ++i) {
    const double alike = 0.2 + 0.01 * std::vector<double>{-1, -0.3, 0.3, 1}[std::size_t(i % 4)];
    many.push_back(unit(alike));
    if (i < 4) few.push_back(unit(alike));
  }
  CHECK(limit_by(few) > limit_by(many));
}

TEST_CASE("few units prove no limit far beyond what they show", "[bench][sound]") {
  const std::vector<analysis::Diagnosis> few{unit(0.1), unit(0.5), unit(0.9)};
  CHECK(limit_by(few) == Approx(1.8));
  const std::vector<analysis::Diagnosis> fewer_still{unit(0.01), unit(0.1), unit(0.2)};
  CHECK(limit_by(fewer_still) == Approx(0.5));  // that assumed
}

TEST_CASE("a part that sound units do not show keeps half the limit assumed", "[bench][sound]") {
  CHECK(limit_by(std::vector<analysis::Diagnosis>(5, unit(0, 0.03))) == Approx(0.25));
  std::vector<analysis::Diagnosis> few_shown(20, unit(0, 0.03));
  few_shown[3] = unit(0.7);
  CHECK(limit_by(few_shown) == Approx(0.25));
}

TEST_CASE("a blow keeps its lower limit, unless sound units reach it", "[bench][sound]") {
  analysis::Kinematics k = one_part();
  k.signatures[0].aligned_limit = 0.1;
  const auto aligned_limit = [&](const std::vector<analysis::Diagnosis>& units) {
    return with_sound_units(k, units).signatures[0].aligned_limit;
  };
  CHECK(aligned_limit(std::vector<analysis::Diagnosis>(5, unit(0, 0.03))) == 0.1);
  const auto louder = units_like(0.2, 0.01, 40);
  CHECK(aligned_limit(louder) == limit_by(louder));
}

TEST_CASE("a record in noise may be held against the limit assumed", "[bench][sound]") {
  const auto k = with_sound_units(one_part(), std::vector<analysis::Diagnosis>(5, unit(0, 0.03)));
  CHECK(k.signatures[0].limit_in_noise == 0.5);
}

TEST_CASE("a part that too few sound units could judge keeps its limit", "[bench][sound]") {
  const std::vector<analysis::Diagnosis> blind(5, unit(0, not_known));
  CHECK(limit_by(blind) == 0.5);
}

TEST_CASE("a part that stands in a set under another's name has its sound units",
          "[bench][sound]") {
  std::vector<analysis::Diagnosis> units = units_like(0.2, 0.01, 40);
  for (analysis::Diagnosis& each : units) {
    each.below_limit[0].component = "wheel";
    each.below_limit[0].one_of = {"wheel", "shaft"};
  }
  CHECK(limit_by(units) == limit_by(units_like(0.2, 0.01, 40)));
}

TEST_CASE("a recording counts as one sound unit, and never as a measure of itself",
          "[bench][sound]") {
  const auto judged = [](double rms, double kurtosis) {
    Judgement judgement = test::passed_run();
    analysis::ChannelExamination channel;
    channel.rms = rms;
    channel.peak = 3 * rms;
    channel.kurtosis = kurtosis;
    judgement.points.resize(1);
    judgement.points[0].examination.channels = {channel, channel};
    judgement.diagnosis.resolvable = true;
    return judgement;
  };
  SoundUnits units;
  CHECK(std::holds_alternative<SoundUnits::Counted>(units.add("a.h5", judged(1.25, 3))));
  const auto again = units.add("copy_of_a.h5", judged(1.25, 3));
  REQUIRE(std::holds_alternative<SoundUnits::Repeated>(again));
  CHECK(std::get<SoundUnits::Repeated>(again).file == "a.h5");
  CHECK(std::holds_alternative<SoundUnits::Counted>(units.add("b.h5", judged(1.25, 3.001))));
  CHECK(units.size() == 2);
  CHECK(units.file_with_samples_of(judged(1.25, 3)) == "a.h5");
  CHECK(units.file_with_samples_of(judged(1.3, 3)).empty());
}

TEST_CASE("a recording that cannot be trusted is no sound unit", "[bench][sound]") {
  Judgement judgement = test::passed_run();
  judgement.diagnosis.resolvable = true;
  judgement.diagnosis.quality.push_back({"a.h5", "no line of this machine", true});
  SoundUnits units;
  CHECK(std::holds_alternative<SoundUnits::Untrusted>(units.add("a.h5", judgement)));
  CHECK(units.size() == 0);
}

TEST_CASE("sound units are found by file, folder and serial", "[bench][sound]") {
  const ScratchFolder scratch;
  Judgement judgement = test::passed_run();
  for (const char* serial : {"S1", "S2"}) {
    judgement.facts.serial = serial;
    test::enter_run(scratch / "runs", judgement);
  }
  const auto below = sound_files({(scratch / "runs").string()}, "no_runs");
  REQUIRE(below.index() == 0);
  CHECK(std::get<0>(below).size() == 2);
  CHECK_THAT(why_no_files({"S3"}), Contains("S3"));
  std::filesystem::create_directory(scratch / "empty");
  CHECK_THAT(why_no_files({(scratch / "empty").string()}), Contains("no verdict.json"));
}

}  // namespace rvbench::bench
