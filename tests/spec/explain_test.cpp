#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "sim/plant_json.hpp"
#include "tests/bench/moved_slide.hpp"
#include "tests/spec/rvbench.hpp"
#include "tests/support/scratch_folder.hpp"

// The program `explain` from outside: files in, files out, exit codes.
namespace rvbench {
namespace {

using Catch::Matchers::Contains;
using nlohmann::json;
using test::Answer;
using test::ScratchFolder;

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

// slide.json and record_1.csv ... record_3.csv, of amplitudes of their own.
std::vector<std::string> write_slide(const ScratchFolder& scratch, const test::MovedSlide& slide) {
  std::ofstream(scratch / "slide.json") << sim::write_plant(test::MovedSlide::plant());
  const bench::Campaign campaign = slide.campaign();
  std::vector<std::string> files;
  for (std::size_t r = 0; r < 3; ++r) {
    const auto& channels = campaign.records[r].recording.channels;
    files.push_back("record_" + std::to_string(r + 1) + ".csv");
    std::ofstream csv(scratch / files.back());
    csv << "way,force\n";
    csv.precision(9);
    for (Eigen::Index i = 0; i < channels[0].samples.size(); ++i) {
      csv << channels[0].samples[i] << ',' << channels[1].samples[i] << '\n';
    }
  }
  return files;
}

Answer explain(const ScratchFolder& scratch, const std::vector<std::string>& files,
               std::vector<std::string> more = {}) {
  std::vector<std::string> words{"explain", "--plant", "slide.json", "--rate", "500", "--rec"};
  words.insert(words.end(), files.begin(), files.end());
  words.insert(words.end(), more.begin(), more.end());
  return test::rvbench(scratch.path(), words);
}

}  // namespace

TEST_CASE("explain says what was left out, models it, and the model runs", "[spec][explain]") {
  const ScratchFolder scratch;
  test::MovedSlide slide;
  slide.law = [](double, double v) { return v > 0 ? 2.5 : -2.5; };
  slide.length_s = 3;
  const auto files = write_slide(scratch, slide);
  const Answer answer = explain(scratch, files, {"--out", "explained", "--json"});
  INFO(answer.err);
  REQUIRE(answer.code == 0);
  const json said = json::parse(answer.out);
  CHECK(said.at("verdict") == "NAMED");
  REQUIRE(said.at("effects").size() == 1);
  const json& effect = said.at("effects")[0];
  CHECK(effect.at("name") == "coulomb_friction");
  CHECK(effect.at("verdict") == "NAMED");
  CHECK(effect.at("parameters")[0].at("value").get<double>() == Approx(2.5).epsilon(0.05));
  const double low = effect.at("parameters")[0].at("ci90")[0];
  const double high = effect.at("parameters")[0].at("ci90")[1];
  CHECK(low < high);
  CHECK(high - low < 0.1);
  CHECK(effect.at("held_out").at("after").get<double>() <
        0.3 * effect.at("held_out").at("before").get<double>());
  CHECK(said.at("data_sha256").size() == 3);
  CHECK(said.at("self_null").is_null());  // no record repeats another
  CHECK(said.at("records").size() == 3);

  CHECK(json::parse(text_of(scratch / "explained/explain.json")) == said);
  const std::string page = text_of(scratch / "explained/explain.html");
  CHECK_THAT(page, Contains("left out: coulomb_friction") && Contains("<svg"));
  CHECK_THAT(page, !Contains("http://") && !Contains("https://"));

  const Answer checked = test::rvbench(scratch.path(), {"check", "explained/plant_updated.json"});
  CHECK(checked.code == 0);
  const Answer simulated =
      test::rvbench(scratch.path(), {"simulate", "--plant", "explained/plant_updated.json",
                                     "--like", files[0], "--rate", "500", "--out", "sim.csv"});
  INFO(simulated.err);
  REQUIRE(simulated.code == 0);
  CHECK_THAT(text_of(scratch / "sim.csv"), Catch::Matchers::StartsWith("time_s,way,force\n"));

  // Nothing is written over what it would be made from.
  const std::string plant = text_of(scratch / "explained/plant_updated.json");
  const std::string record = text_of(scratch / files[0]);
  const Answer again = test::rvbench(
      scratch.path(), {"explain", "--plant", "explained/plant_updated.json", "--rate", "500",
                       "--rec", files[0], files[1], files[2], "--out", "explained"});
  CHECK(again.code == 2);
  CHECK_THAT(again.err, Contains("would replace the plant"));
  CHECK(text_of(scratch / "explained/plant_updated.json") == plant);
  const Answer over =
      test::rvbench(scratch.path(), {"simulate", "--plant", "explained/plant_updated.json",
                                     "--like", files[0], "--rate", "500", "--out", files[0]});
  CHECK(over.code == 2);
  CHECK_THAT(over.err, Contains("is what it would be made from"));
  CHECK(text_of(scratch / files[0]) == record);
}

TEST_CASE("an interrupted explain ends ABORTED, and writes nothing", "[spec][explain]") {
  const ScratchFolder scratch;
  test::MovedSlide slide;
  slide.law = [](double, double v) { return v > 0 ? 2.5 : -2.5; };
  const auto files = write_slide(scratch, slide);
  test::Program program(scratch.path(),
                        {test::rvbench_path(), "explain", "--plant", "slide.json", "--rate", "500",
                         "--rec", files[0], files[1], files[2], "--out", "explained"});
  REQUIRE(program.says("effect 1"));
  REQUIRE(program.send(SIGINT));
  const Answer answer = program.wait();
  CHECK(answer.code == 50);
  CHECK_THAT(answer.err, Contains("interrupted"));
  CHECK_FALSE(std::filesystem::exists(scratch / "explained"));
}

TEST_CASE("explain refuses what it cannot compare, and says why", "[spec][explain]") {
  const ScratchFolder scratch;
  const auto files = write_slide(scratch, {});
  const auto refused = [&](const Answer& answer, int code, const std::string& told) {
    INFO(answer.out);
    CHECK(answer.code == code);
    CHECK_THAT(answer.err, Contains(told));
  };
  std::ofstream(scratch / "other.csv") << "position,force\n1,2\n2,3\n3,1\n";
  refused(explain(scratch, {"other.csv"}), 20, "the recording has no channel \"way\"");
  std::ofstream(scratch / "short.csv") << "way,force\n1,2\n2,3\n3,1\n";
  refused(explain(scratch, {"short.csv"}), 20, "too short");
  refused(explain(scratch, {"absent.csv"}), 20, "absent.csv");
  refused(explain(scratch, {files[0], files[0]}), 20, "the same recording as");
  refused(explain(scratch, {"slide.json"}), 2, "a campaign file states its rates");
  refused(
      test::rvbench(scratch.path(), {"explain", "--plant", "slide.json", "--rec", "slide.json"}), 3,
      "/campaign: this key is missing");
  refused(test::rvbench(scratch.path(),
                        {"explain", "--plant", "slide.json", "--rec", files[0], "--rate", "0"}),
          2, "--rate must be 0.001 to 1e+08 Hz");
  refused(test::rvbench(scratch.path(),
                        {"explain", "--plant", "slide.json", "--rec", files[0], "--rate", "50"}),
          20, "needs a rate above 80 Hz, not 50");
  refused(test::rvbench(scratch.path(), {"explain", "--plant", "slide.json", "--rec", files[0]}),
          20, "states no sample rate");
  refused(test::rvbench(scratch.path(),
                        {"explain", "--plant", "slyde", "--rec", files[0], "--rate", "500"}),
          3, "slyde");

  const json good = json::parse(text_of(scratch / "slide.json"));
  json plant = good;
  plant["outputs"][0]["channel"] = "way";
  plant["outputs"][0]["gain"] = {{"value", 0}, {"unit", "1"}};
  std::ofstream(scratch / "slide.json") << plant.dump();
  refused(explain(scratch, files), 3, "/outputs/0/channel: \"way\" is an input");
  refused(explain(scratch, files), 3, "/outputs/0/gain/value: 0 shows nothing");
  plant = good;
  plant["bodies"][0]["mass"]["value"] = -3;
  std::ofstream(scratch / "slide.json") << plant.dump();
  refused(explain(scratch, files), 3, "/bodies/0/mass");
}

TEST_CASE("recordings that are of something else are no answer about the plant",
          "[spec][explain]") {
  const ScratchFolder scratch;
  const auto files = write_slide(scratch, {});
  for (const std::string& file : files) {
    const std::string rows = text_of(scratch / file);
    std::ofstream(scratch / file) << "force,way" << rows.substr(rows.find('\n'));
  }
  const Answer answer = explain(scratch, files);
  INFO(answer.out << answer.err);
  CHECK(answer.code == 20);
  CHECK_THAT(answer.out, Contains("NOT_RESOLVABLE"));
  CHECK_THAT(answer.out, Contains("channels, units or the plant are not those"));
}

}  // namespace rvbench
