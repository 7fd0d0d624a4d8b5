#include "bench/kinematics_file.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "bench/kinematics_files.hpp"
#include "bench/text_file.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::bench {
namespace {

std::variant<analysis::Kinematics, std::vector<hal::ConfigFault>> read(const std::string& text) {
  const rvbench::test::ScratchFolder scratch;
  write_file(scratch.path() / "machine.json", text);
  return read_kinematics((scratch.path() / "machine.json").string());
}

analysis::Kinematics machine_of(const std::string& text) {
  const auto file = read(text);
  if (const auto* faults = std::get_if<1>(&file)) {
    for (const auto& fault : *faults) UNSCOPED_INFO(describe("machine.json", fault));
  }
  REQUIRE(file.index() == 0);
  return std::get<0>(file);
}

bool has_order(const analysis::Kinematics& machine, double order) {
  return std::ranges::any_of(machine.signatures, [&](const analysis::Signature& signature) {
    return std::abs(signature.order - order) < 1e-9 * order;
  });
}

std::vector<hal::ConfigFault> faults_of(const std::string& text) {
  auto file = read(text);
  REQUIRE(file.index() == 1);
  return std::get<1>(std::move(file));
}

std::vector<std::string> lines_of(const std::vector<hal::ConfigFault>& faults) {
  std::vector<std::string> lines;
  for (const auto& fault : faults) lines.push_back(describe("machine.json", fault));
  return lines;
}

std::vector<std::string> places_of(const std::string& text) {
  std::vector<std::string> places;
  for (const auto& fault : faults_of(text)) places.push_back(fault.pointer);
  return places;
}

}  // namespace

TEST_CASE("every shipped machine can be read by its name", "[bench]") {
  for (const EmbeddedFile& file : kinematics_files()) {
    CAPTURE(file.name);
    const auto read = read_kinematics(file.name);
    REQUIRE(read.index() == 0);
    CHECK_FALSE(std::get<0>(read).machine.empty());
    CHECK_FALSE(std::get<0>(read).signatures.empty());
  }
}

TEST_CASE("a machine that is neither shipped nor a file is told by name", "[bench]") {
  const auto read = read_kinematics("cwru");
  REQUIRE(read.index() == 1);
  CHECK_THAT(describe("cwru", std::get<1>(read).at(0)), Catch::Contains("cwru: cannot be read"));
}

TEST_CASE("a gear pair turns its shafts by its teeth", "[bench]") {
  const analysis::Kinematics machine = machine_of(R"({"machine": "pair", "source": "by hand",
        "shafts": [{"name": "in"}, {"name": "out", "component": "carrier"}],
        "meshes": [{"name": "pair", "driver": "in", "driver_teeth": 20,
                    "driven": "out", "driven_teeth": 60}]})");
  CHECK(machine.machine == "pair");
  CHECK(has_order(machine, 1));
  CHECK(has_order(machine, 1.0 / 3));
  CHECK_FALSE(has_order(machine, 0.5));
}

TEST_CASE("a bearing's orders are those of its geometry, on the shaft that it carries", "[bench]") {
  // The textbook's own example, 6205: n = 9, d = 7.94 mm, D = 39.04 mm; inner race 5.4152,
  // outer race 3.5848, cage 0.39828 times the shaft speed. Here the shaft turns at half speed.
  const analysis::Kinematics machine =
      machine_of(R"({"machine": "bearing", "shafts": [{"name": "in"}, {"name": "out"}],
        "meshes": [{"name": "pair", "driver": "in", "driver_teeth": 30,
                    "driven": "out", "driven_teeth": 60}],
        "bearings": [{"name": "rear", "shaft": "out", "rolling_elements": 9, "slip": 0,
                      "ball_diameter_mm": 7.94, "pitch_diameter_mm": 39.04}]})");
  const double ratio = 7.94 / 39.04;
  CHECK(has_order(machine, 0.5 * 9 / 2 * (1 + ratio)));
  CHECK(has_order(machine, 0.5 * 9 / 2 * (1 - ratio)));
  CHECK(0.5 * 9 / 2 * (1 + ratio) == Approx(0.5 * 5.4152).epsilon(5e-4));
}

TEST_CASE("a planetary stage is known by its teeth, and a bearing by the orders of its races",
          "[bench]") {
  const auto machine = machine_of(R"({"machine": "P", "planetary": {
      "sun_teeth": 20, "planet_teeth": 20, "ring_teeth": 60, "planets": 3,
      "planet_bearing": {"outer_race_order": 3.585, "inner_race_order": 5.415}}})");
  CHECK(machine.gear_ratio == 4);
  CHECK(has_order(machine, 0.75 * 3.585));
  // The pin that it turns on stands, unless the file says otherwise.
  CHECK(has_order(machine, 0.75 * 5.415 / 9));
  const auto other = machine_of(R"({"machine": "P", "planetary": {
      "sun_teeth": 20, "planet_teeth": 20, "ring_teeth": 60, "planets": 3, "planet_bearing": {
      "outer_race_order": 3.585, "inner_race_order": 5.415, "fixed_race": "outer"}}})");
  CHECK(has_order(other, 0.75 * 3.585 / 9));
}

TEST_CASE("races that pass no whole number of rolling elements are a fault", "[bench]") {
  const auto text = [](const char* inner) {
    return std::string(R"({"machine": "M", "shafts": [{"name": "s"}], "bearings": [
        {"name": "b", "shaft": "s", "outer_race_order": 3.585, "inner_race_order": )") +
           inner + "}]}";
  };
  CHECK(machine_of(text("5.4")).bearings.size() == 1);  // 8.985 is 9, as printed figures go
  CHECK(places_of(text("5.39")) == std::vector<std::string>{"/bearings/0/inner_race_order"});
  CHECK(places_of(text("2.415")) == std::vector<std::string>{"/bearings/0/inner_race_order"});
}

TEST_CASE("faults of races and of teeth are told beside each other", "[bench]") {
  CHECK(places_of(R"({"machine": "P", "planetary": {"sun_teeth": 20, "planet_teeth": 20,
                      "ring_teeth": 70, "planets": 3, "planet_bearing": {
                      "outer_race_order": 3.585, "inner_race_order": 5.2}}})") ==
        std::vector<std::string>{"/planetary/ring_teeth",
                                 "/planetary/planet_bearing/inner_race_order"});
  // A tooth count that is missing says nothing of the others.
  CHECK(places_of(R"({"machine": "P", "planetary": {"planet_teeth": 20, "ring_teeth": 60,
                      "planets": 3}})") == std::vector<std::string>{"/planetary/sun_teeth"});
}

TEST_CASE("planets that do not fit between sun and ring are a fault", "[bench]") {
  CHECK(places_of(R"({"machine": "P", "planetary": {"sun_teeth": 20, "planet_teeth": 20,
                      "ring_teeth": 70, "planets": 3}})") ==
        std::vector<std::string>{"/planetary/ring_teeth"});
}

TEST_CASE("planets and rolling elements that overlap are doubted, and judged by all the same",
          "[bench]") {
  const auto doubts_of = [](const std::string& text) {
    const rvbench::test::ScratchFolder scratch;
    write_file(scratch / "machine.json", text);
    const auto read = read_machine((scratch / "machine.json").string());
    REQUIRE(read.index() == 0);
    std::vector<std::string> places;
    for (const hal::ConfigFault& doubt : std::get<0>(read).doubts) places.push_back(doubt.pointer);
    return places;
  };
  const auto stage = [](int planets) {
    return R"({"machine": "P", "planetary": {"sun_teeth": 20, "planet_teeth": 20,
               "ring_teeth": 60, "planets": )" +
           std::to_string(planets) + "}}";
  };
  // Six pitch circles of one size touch each other round a seventh: their teeth overlap.
  CHECK(doubts_of(stage(5)).empty());
  CHECK(doubts_of(stage(6)) == std::vector<std::string>{"/planetary/planets"});
  CHECK(doubts_of(R"({"machine": "R", "rv_reducer": {"sun_teeth": 9, "planet_teeth": 27,
                      "planets": 4, "lobes": 39, "pins": 40}})") ==
        std::vector<std::string>{"/rv_reducer/planets"});
  const auto bearing = [](int elements) {
    return R"({"machine": "M", "shafts": [{"name": "s"}], "bearings": [{"name": "b",
               "shaft": "s", "ball_diameter_mm": 8, "pitch_diameter_mm": 40,
               "rolling_elements": )" +
           std::to_string(elements) + "}]}";
  };
  CHECK(doubts_of(bearing(15)).empty());  // 40 mm · sin 12° = 8.3 mm
  CHECK(doubts_of(bearing(16)) == std::vector<std::string>{"/bearings/0"});
}

TEST_CASE("two ways to one shaft that contradict each other are a fault", "[bench]") {
  const auto train = [](int teeth) {
    return R"({"machine": "T", "shafts": [{"name": "in"}, {"name": "lay"}, {"name": "out"}],
      "meshes": [
        {"name": "a", "driver": "in", "driver_teeth": 20, "driven": "lay", "driven_teeth": 40},
        {"name": "b", "driver": "lay", "driver_teeth": 20, "driven": "out", "driven_teeth": 40},
        {"name": "c", "driver": "in", "driver_teeth": 20, "driven": "out", "driven_teeth": )" +
           std::to_string(teeth) + "}]}";
  };
  CHECK(has_order(machine_of(train(80)), 0.25));
  CHECK(places_of(train(60)) == std::vector<std::string>{"/meshes"});
}

TEST_CASE("a shaft that no mesh leads to is a fault", "[bench]") {
  const auto places =
      places_of(R"({"machine": "loose", "shafts": [{"name": "in"}, {"name": "free"}]})");
  CHECK(places == std::vector<std::string>{"/shafts"});
}

TEST_CASE("no two parts of a machine have one name", "[bench]") {
  const auto faults = faults_of(R"({"machine": "twins",
"shafts": [{"name": "in", "component": "axle"}, {"name": "out", "component": "axle"}],
"meshes": [
{"name": "pair", "driver": "in", "driver_teeth": 20, "driver_component": "wheel",
 "driven": "out", "driven_teeth": 60,
 "driven_component": "wheel"},
{"name": "pair", "driver": "in", "driver_teeth": 20}],
"bearings": [
{"name": "front", "shaft": "in", "rolling_elements": 9,
 "ball_diameter_mm": 8, "pitch_diameter_mm": 40},
{"name": "front", "shaft": "out", "rolling_elements": 9,
 "ball_diameter_mm": 8, "pitch_diameter_mm": 40}]})");
  CHECK(lines_of(faults) ==
        std::vector<std::string>{
            R"(machine.json:2: /shafts/1/component: there is already a shaft of component "axle")",
            R"(machine.json:6: /meshes/0/driven_component: there is already a gear "wheel", )"
            "of other teeth or shaft",
            R"(machine.json:7: /meshes/1/name: there is already a mesh "pair")",
            R"(machine.json:11: /bearings/1/name: there is already a bearing "front")"});
}

TEST_CASE("an idler is one gear in two meshes", "[bench]") {
  const analysis::Kinematics machine = machine_of(R"({"machine": "train",
"shafts": [{"name": "in"}, {"name": "middle"}, {"name": "out"}],
"meshes": [{"name": "first", "driver": "in", "driver_teeth": 20,
            "driven": "middle", "driven_teeth": 30, "driven_component": "idler"},
           {"name": "second", "driver": "middle", "driver_teeth": 30, "driver_component": "idler",
            "driven": "out", "driven_teeth": 40}]})");
  CHECK(has_order(machine, 0.5));
}

TEST_CASE("pins that are missing are one fault, pins that do not fit the lobes another",
          "[bench]") {
  const auto reducer = [](const std::string& pins) {
    return R"({"machine": "rv", "rv_reducer": {"sun_teeth": 9, "planet_teeth": 27, "lobes": 39)" +
           pins + "}}";
  };
  CHECK(places_of(reducer("")) == std::vector<std::string>{"/rv_reducer/pins"});
  CHECK(places_of(reducer(", \"pins\": 39")) == std::vector<std::string>{"/rv_reducer/pins"});
  CHECK(has_order(machine_of(reducer(", \"pins\": 40")), 1));
}

TEST_CASE("a missing name, missing shafts and missing teeth are faults", "[bench]") {
  const auto first_of = [](const std::string& text) { return lines_of(faults_of(text)).front(); };
  CHECK_THAT(first_of(R"({"shafts": [{"name": "in"}]})"),
             Catch::Contains(":1: /machine: this key is missing"));
  CHECK_THAT(first_of(R"({"machine": "m"})"), Catch::Contains(":1: /shafts: this key is missing"));
  CHECK_THAT(first_of(R"({"machine": "m", "shafts": [{"name": "in"}],
"meshes": [{"name": "pair", "driver": "in", "driver_teeth": 0}]})"),
             Catch::Contains(":2: /meshes/0/driver_teeth: 0 is below 1"));
}

TEST_CASE("every fault of a machine is reported at once", "[bench]") {
  const auto lines = lines_of(faults_of(R"({"machine": "",
"shafts": [{"name": "in"}, {"nam": "out"}],
"meshes": [{"name": "pair", "driver": "inn", "driver_teeth": 1.5}],
"bearings": [{"name": "b", "shaft": "in", "rolling_elements": 1, "ball_diameter_mm": 8,
"pitch_diameter_mm": 8, "contact_angle_deg": 90}]})"));
  for (const std::string begin :
       {":1: /machine: must not be empty", ":2: /shafts/1/name: this key is missing",
        ":2: /shafts/1/nam: unknown key", ":3: /meshes/0/driver: no shaft is called \"inn\"",
        ":3: /meshes/0/driver_teeth: expected a whole number, found 1.5",
        ":4: /bearings/0/rolling_elements: 1 is below",
        ":4: /bearings/0/ball_diameter_mm: must be below pitch_diameter_mm",
        ":5: /bearings/0/contact_angle_deg: "}) {
    CAPTURE(begin);
    CHECK(std::ranges::any_of(
        lines, [&](const std::string& line) { return line.starts_with("machine.json" + begin); }));
  }
}

}  // namespace rvbench::bench
