#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/spec/program.hpp"
#include "tests/support/real_data.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/under_sanitizer.hpp"

// What a model leaves out of real machines, which others have measured and identified.
namespace rvbench {
namespace {

using nlohmann::json;

// Null where there are no real recordings, or no time for them.
json explained(const std::string& plant, const std::string& campaign) {
  const auto folder = test::data_folder();
  if (!folder) return nullptr;
  if (test::too_long_under_sanitizer()) return nullptr;
  std::ostringstream text;
  text << std::ifstream(RVBENCH_SOURCE_DIR "/tests/campaigns/" + campaign + ".json").rdbuf();
  json named = json::parse(text.str());
  const std::string beside = "../../../shared/data";
  for (json& file : named.at("files")) {
    const std::string path = file.at("file");
    file["file"] = std::filesystem::absolute(*folder).string() + path.substr(beside.size());
  }
  const test::ScratchFolder scratch;
  std::ofstream(scratch / "campaign.json") << named.dump();
  const test::Answer answer = test::rvbench(
      scratch.path(), {"explain", "--plant", plant, "--rec", "campaign.json", "--json"});
  INFO(answer.err);
  REQUIRE(answer.code == 0);
  return json::parse(answer.out);
}

std::vector<std::string> names(const json& said) {
  std::vector<std::string> all;
  for (const json& effect : said.at("effects")) all.push_back(effect.at("name"));
  return all;
}

}  // namespace

// Janot, Gautier & Brunot (2019): 95.1 kg, 203.5 N·s/m and 20.4 N of Coulomb friction; friction of
// the axis differs by direction.
TEST_CASE("a positioning axis leaves out Coulomb friction, then its asymmetry",
          "[spec][data][explain]") {
  const json said = explained("emps", "emps");
  if (said.is_null()) return;
  INFO(said.dump(1));
  const auto found = names(said);
  REQUIRE(found.size() >= 2);
  CHECK(found[0] == "coulomb_friction");
  CHECK(found[1] == "asymmetric_friction");
  const json& coulomb = said.at("effects")[0];
  const json& asymmetry = said.at("effects")[1];
  CHECK(coulomb.at("held_out").at("before").get<double>() == Approx(0.165).epsilon(0.03));
  CHECK(coulomb.at("held_out").at("after") <= 0.042);
  CHECK(asymmetry.at("held_out").at("after") <= 0.033);
  CHECK(coulomb.at("bootstraps_won") >= 0.95);
  CHECK(asymmetry.at("bootstraps_won") >= 0.95);
  CHECK(said.at("base")[0].at("value").get<double>() == Approx(95.1).epsilon(0.01));
  // One cycle against another: nothing, or the drift of the offset by about 0.3 N.
  REQUIRE_FALSE(said.at("self_null").is_null());
  for (const json& drift : said.at("self_null").at("found")) {
    CHECK(drift.at("unit") == "N");
    CHECK(std::abs(drift.at("value").get<double>()) == Approx(0.3).margin(0.2));
  }
}

TEST_CASE("a robot's joint leaves out dry friction", "[spec][data][explain]") {
  const json said = explained("ur10e_joint", "ur10e_joint_1");
  if (said.is_null()) return;
  INFO(said.dump(1));
  REQUIRE_FALSE(said.at("effects").empty());
  CHECK(names(said)[0] == "coulomb_friction");
  const json& held_out = said.at("fit").at("held_out");
  CHECK(held_out.at("before").get<double>() >= 2.5 * held_out.at("after").get<double>());
}

}  // namespace rvbench
