#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/spec/rvbench.hpp"
#include "tests/support/real_data.hpp"

// What each file shows is stated by those who measured it: the Bearing Data Center in the names
// of its files, the gear rig's owner by speed and teeth.
namespace rvbench {
namespace {

using Catch::Matchers::Contains;
using nlohmann::json;

test::Answer judge(const std::filesystem::path& file, std::vector<std::string> words) {
  words.insert(words.begin(), {"judge", file.string()});
  return test::rvbench(std::filesystem::temp_directory_path(), words);
}

json verdict_on(const std::filesystem::path& file, std::vector<std::string> words) {
  words.emplace_back("--json");
  const test::Answer answer = judge(file, std::move(words));
  INFO(answer.err);
  REQUIRE((answer.code == 0 || answer.code == 10 || answer.code == 20));
  return json::parse(answer.out);
}

json verdict_on_bearing(const std::string& name, const std::string& rate_Hz = "12000") {
  const auto folder = test::data_folder();
  if (!folder) return nullptr;
  return verdict_on(*folder / "cwru" / name, {"--kinematics", "cwru_6205", "--rate", rate_Hz});
}

std::vector<std::string> bearing_parts(const json& verdict) {
  std::vector<std::string> parts;
  for (const json& finding : verdict.at("findings")) {
    const std::string component = finding.at("component");
    if (component.starts_with("bearing_")) parts.push_back(component);
  }
  return parts;
}

// Whether some line of the channel has this meaning, and where.
std::optional<double> frequency_of(const json& channel, const std::string& meaning) {
  for (const json& line : channel.at("lines")) {
    if (line.at("meaning") == meaning) return line.at("frequency_Hz").get<double>();
  }
  return std::nullopt;
}

}  // namespace

TEST_CASE("a spalled race of a real bearing is named", "[spec][data]") {
  const auto [name, race] = GENERATE(table<std::string, std::string>({
      {"IR007_0.mat", "bearing_inner"},
      {"IR007_1.mat", "bearing_inner"},
      {"IR014_0.mat", "bearing_inner"},
      {"IR021_0.mat", "bearing_inner"},
      {"IR021_1.mat", "bearing_inner"},
      {"OR007@6_0.mat", "bearing_outer"},
      {"OR007@6_1.mat", "bearing_outer"},
      {"OR021@6_0.mat", "bearing_outer"},
  }));
  const json verdict = verdict_on_bearing(name);
  if (verdict.is_null()) return;
  INFO(name);
  CHECK(verdict.at("verdict") == "FAIL");
  REQUIRE_FALSE(verdict.at("findings").empty());
  CHECK(verdict.at("findings").front().at("component") == race);
}

TEST_CASE("a sound bearing has no finding", "[spec][data]") {
  const json verdict = verdict_on_bearing("normal_0.mat", "48000");
  if (verdict.is_null()) return;
  CHECK(verdict.at("verdict") == "PASS");
  CHECK(bearing_parts(verdict).empty());
}

TEST_CASE("a fault that cannot be seen at this rate gets no false name", "[spec][data]") {
  const auto [name, part] = GENERATE(table<std::string, std::string>({
      {"OR014@6_0.mat", "bearing_outer"},
      {"B007_0.mat", "bearing_ball"},
      {"B014_0.mat", "bearing_ball"},
  }));
  const json verdict = verdict_on_bearing(name);
  if (verdict.is_null()) return;
  INFO(name);
  for (const std::string& found : bearing_parts(verdict)) CHECK(found == part);
}

TEST_CASE("shaft and mesh of a real gear are found in every channel", "[spec][data]") {
  const auto folder = test::data_folder();
  if (!folder) return;
  const int number = GENERATE(1, 2, 3, 4, 5, 6);
  INFO("channel " << number);
  const json verdict =
      verdict_on(*folder / "gear0" / ("3027_217_Data_Chan" + std::to_string(number) + ".mat"),
                 {"--kinematics", "gear0", "--speed", "2000"});
  const json& channel = verdict.at("points").at(0).at("channels").at(0);
  const auto shaft_Hz = frequency_of(channel, "pinion shaft");
  const auto mesh_Hz = frequency_of(channel, "pinion mesh");
  REQUIRE(shaft_Hz);
  REQUIRE(mesh_Hz);
  CHECK(*shaft_Hz == Approx(33.333).margin(0.05));
  CHECK(*mesh_Hz == Approx(766.6).margin(0.1));
}

TEST_CASE("a family that shaft and teeth leave unexplained is no sound machine, and is listed",
          "[spec][data]") {
  const auto folder = test::data_folder();
  if (!folder) return;
  std::vector<std::string> words{"judge", "--json", "--kinematics", "gear0", "--speed", "2000"};
  for (int i = 1; i <= 6; ++i) {
    words.push_back(
        (*folder / "gear0" / ("3027_217_Data_Chan" + std::to_string(i) + ".mat")).string());
  }
  const test::Answer answer = test::rvbench(std::filesystem::temp_directory_path(), words);
  INFO(answer.err);
  REQUIRE(answer.code == 20);
  const json verdict = json::parse(answer.out);
  REQUIRE(verdict.at("unknown").size() == 1);
  const json& unknown = verdict.at("unknown").front();
  CHECK(unknown.at("component") == "unknown");
  CHECK(unknown.at("spacing").get<double>() == Approx(171.56 / 33.33).epsilon(1e-3));
  CHECK(unknown.at("harmonics") == 6);
  CHECK(unknown.at("sidebands") == 4);
  std::string seen_as;
  for (const json& line : verdict.at("unexplained")) {
    if (std::abs(line.at("frequency_Hz").get<double>() - 171.56) < 0.1) {
      seen_as = line.at("meaning").get<std::string>();
    }
  }
  CHECK_THAT(seen_as, Contains("x2") && Contains("x3") && Contains("pinion mesh + 1x") &&
                          Contains("pinion mesh - 1x"));
}

TEST_CASE("a recording whose rate nobody knows is not judged by a guess", "[spec][data]") {
  const auto folder = test::data_folder();
  if (!folder) return;
  const test::Answer answer = judge(*folder / "oedi/h30hz0.csv", {"--kinematics", "two_stage"});
  CHECK(answer.code == 2);
  CHECK(answer.out.empty());
  CHECK_THAT(answer.err, Contains("h30hz0.csv") && Contains("--rate"));
}

// The strongest line of each record near 32/3 orders, in Hz, times 60 and 3/32: read off spectra
// that rvbench has no part in. A speed of 1780 rpm is what a user reads off the motor's plate.
TEST_CASE("a gear train's own lines say at which speed within the motor's slip it turned",
          "[spec][data]") {
  const auto [name, speed_rpm] = GENERATE(table<std::string, double>({
      {"h30hz0", 1785.3},
      {"h30hz30", 1783.7},
      {"h30hz60", 1779.6},
      {"h30hz90", 1777.7},
      {"b30hz00", 1785.3},
      {"b30hz30", 1783.4},
      {"b30hz60", 1779.5},
      {"b30hz90", 1776.0},
  }));
  const auto folder = test::data_folder();
  if (!folder) return;
  const json verdict =
      verdict_on(*folder / "oedi" / (name + ".csv"),
                 {"--kinematics", "two_stage", "--rate", "4266.67", "--speed", "1780"});
  INFO(name);
  const json& point = verdict.at("points").at(0);
  CHECK(point.at("speed_rpm").get<double>() == Approx(speed_rpm).margin(0.4));
}
}  // namespace rvbench
