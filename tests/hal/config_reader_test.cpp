#include "hal/config_reader.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "tests/support/scratch_folder.hpp"

using rvbench::hal::Bounds;
using rvbench::hal::ConfigFault;
using rvbench::hal::ConfigReader;

namespace {

ConfigReader read(std::string_view text) { return ConfigReader::from_text(text, "plan.json"); }

// All faults as they are printed, one a line.
std::string printed(const ConfigReader& reader) {
  std::string all;
  for (const ConfigFault& fault : reader.faults()) all += describe(reader.file(), fault) + '\n';
  return all;
}

constexpr Bounds any{-1e9, 1e9};

}  // namespace

TEST_CASE("a sound file gives its values and no fault", "[hal][config]") {
  ConfigReader root = read(R"({
    "name": "quick", "count": 3, "whole": 4.0, "on": true, "kind": "ramp",
    "speeds": [605, 1210.5], "inner": {"deep": -1}, "list": [{"a": 1}, {"a": 2}],
    "map": {"pump": {"n": 1}, "fan": {"n": 2}}
  })");
  CHECK(root.text("name") == "quick");
  CHECK(root.integer("count", {1, 5}) == 3);
  CHECK(root.integer("whole", {1, 5}, 1) == 4);
  CHECK(root.boolean("on", false));
  CHECK(root.choice("kind", {"step", "ramp"}) == "ramp");
  CHECK(root.numbers("speeds", any) == std::vector<double>{605, 1210.5});
  CHECK(root.object("inner").number("deep", any) == -1);
  auto list = root.objects("list");
  REQUIRE(list.size() == 2);
  CHECK(list[0].number("a", any) + 10 * list[1].number("a", any) == 21);
  auto map = root.object("map").members();
  REQUIRE(map.size() == 2);
  CHECK(map[0].first == "pump");
  CHECK(root.object("map").object("pump").integer("n", any) == 1);  // read twice is no harm
  CHECK(map[1].second.integer("n", any) == 2);
  root.finish();
  CHECK(printed(root) == "");
}

TEST_CASE("what is absent falls back in silence, and only that", "[hal][config]") {
  ConfigReader root = read("{}");
  CHECK(root.number("a", any, 2.5) == 2.5);
  CHECK(root.integer("b", any, 7) == 7);
  CHECK(root.boolean("c", true));
  CHECK(root.text("d", "x") == "x");
  CHECK(root.choice("e", {"one", "two"}, "two") == "two");
  CHECK_FALSE(root.optional_object("f"));
  CHECK(root.objects("g", false).empty());
  CHECK_FALSE(root.has("h"));
  root.finish();
  CHECK(printed(root) == "");
}

TEST_CASE("every fault is told at once, with its line and place", "[hal][config]") {
  ConfigReader root = read(
      "{\n"
      "  \"speed_rpm\": 9000,\n"
      "  \"turns\":\n"
      "    4.5,\n"
      "  \"order\": \"nestd\",\n"
      "  \"loads_pct\": [0,\n"
      "    -25,\n"
      "    \"fifty\"],\n"
      "  \"main\": [{},\n"
      "    7,\n"
      "    {\"a/b\": null}],\n"
      "  \"name\": \"\",\n"
      "  \"title\": 7\n"
      "}\n");
  CHECK(root.number("speed_rpm", {0, 6000}) == 0);
  root.integer("turns", {1, 100});
  root.choice("order", {"nested", "randomised"});
  CHECK(root.numbers("loads_pct", {0, 150}) == std::vector<double>{0, 0, 0});
  auto phases = root.objects("main");
  REQUIRE(phases.size() == 2);
  phases[1].number("a/b", any);
  root.text("name");
  root.text("title");
  root.number("repeats", any);
  root.finish();
  CHECK(printed(root) ==
        "plan.json:1: /repeats: this key is missing\n"
        "plan.json:2: /speed_rpm: 9000 is above 6000\n"
        "plan.json:4: /turns: expected a whole number, found 4.5\n"
        "plan.json:5: /order: expected one of \"nested\", \"randomised\"; found \"nestd\", did you "
        "mean \"nested\"?\n"
        "plan.json:7: /loads_pct/1: -25 is below 0\n"
        "plan.json:8: /loads_pct/2: expected a number, found \"fifty\"\n"
        "plan.json:10: /main/1: expected an object, found 7\n"
        "plan.json:11: /main/2/a~1b: expected a number, found null\n"
        "plan.json:12: /name: must not be empty\n"
        "plan.json:13: /title: expected a text, found 7\n");
}

TEST_CASE("a missing or wrong object is one fault, not one for each key inside", "[hal][config]") {
  ConfigReader root = read("{\"wrong\": 5}");
  root.object("settling").number("hold_s", any);
  root.object("wrong").object("deeper").text("name");
  root.finish();
  CHECK(printed(root) ==
        "plan.json:1: /settling: this key is missing\n"
        "plan.json:1: /wrong: expected an object, found 5\n");
}

TEST_CASE("unknown keys are faults, with the nearest known word", "[hal][config]") {
  ConfigReader root = read(
      "{\n"
      "  \"speed_rmp\": 1,\n"
      "  \"colour\": 2,\n"
      "  \"inner\": {\n"
      "    \"repeat\": 3\n"
      "  },\n"
      "  \"hold_s\": 4\n"
      "}");
  root.has("speeds_rpm");
  root.number("speed_rpm", any, 0);
  root.number("hold_s", any);
  root.object("inner").integer("repeats", any, 1);
  root.finish();
  root.finish();  // twice is the same as once
  CHECK(printed(root) ==
        "plan.json:2: /speed_rmp: unknown key, did you mean \"speed_rpm\"?\n"
        "plan.json:3: /colour: unknown key\n"
        "plan.json:5: /inner/repeat: unknown key, did you mean \"repeats\"?\n");
}

TEST_CASE("the caller's own faults point at the key, or at the object", "[hal][config]") {
  ConfigReader root = read("{\n\"a\": {\n\"b\": 1}}");
  ConfigReader inner = root.object("a");
  inner.fault("b", "beyond the drive");
  inner.fault("", "contradicts itself");
  CHECK(printed(root) ==
        "plan.json:2: /a: contradicts itself\n"
        "plan.json:3: /a/b: beyond the drive\n");
}

TEST_CASE("duplicate keys are refused where the second one stands", "[hal][config]") {
  ConfigReader root = read("{\"a\": [1, {\n\"b\": {\"c\": 1},\n\"b\": {\"c\": 2}}],\n\"d\": 5}");
  CHECK(printed(root) == "plan.json:3: /a/1/b: duplicate key: the first one stands further up\n");
  CHECK(root.number("d", any) == 5);
}

TEST_CASE("what is no JSON is one fault at the line where it goes wrong", "[hal][config]") {
  const auto fault_of = [](std::string_view text) {
    ConfigReader root = read(text);
    root.number("a", any);  // no faults on top of the one that matters
    root.finish();
    REQUIRE(root.faults().size() == 1);
    return root.faults()[0];
  };
  SECTION("a comma too many") {
    const auto fault = fault_of("{\n\"a\": 1,\n}");
    CHECK(fault.line == 3);
    CHECK_THAT(fault.message, Catch::Contains("a comma too many?"));
  }
  SECTION("NaN and Infinity") {
    for (const char* word : {"NaN", "Infinity", "-Infinity"}) {
      const auto fault = fault_of(std::string("{\n\n\"a\": ") + word + "}");
      CHECK(fault.line == 3);
      CHECK_THAT(fault.message, Catch::Contains("NaN and Infinity are not allowed"));
    }
  }
  SECTION("a number that no double can hold") {
    const auto fault = fault_of("{\n\"a\": 1e999\n}");
    CHECK(fault.line == 2);
    CHECK_THAT(fault.message, Catch::Contains("1e999"));
  }
  SECTION("cut off in the middle") { CHECK(fault_of("{\n\"a\": [1,\n").line == 2); }
  SECTION("an empty file") {
    const auto fault = fault_of("");
    CHECK(fault.line == 1);
    CHECK(fault.message == "is empty");
  }
  SECTION("a blank file") { CHECK(fault_of("\n\n").line == 1); }
  SECTION("bytes that are no UTF-8") { CHECK(fault_of("{\n\"a\": \"\xff\"}").line == 2); }
  SECTION("bytes that are zero") {
    CHECK_THAT(fault_of(std::string(100, '\0')).message, Catch::Contains("syntax error"));
  }
  SECTION("an array at the top") {
    const auto fault = fault_of("\n[1]");
    CHECK(fault.line == 2);
    CHECK(fault.message == "expected an object, found an array");
  }
  SECTION("a number at the top") { CHECK(fault_of("3").message == "expected an object, found 3"); }
}

TEST_CASE("a file made to exhaust the reader is refused", "[hal][config]") {
  const auto message = [](const std::string& text) {
    const ConfigReader root = read(text);
    REQUIRE(root.faults().size() == 1);
    return root.faults()[0].message;
  };
  CHECK(message(std::string(100000, '[')) == "nested deeper than 64 levels");
  std::string deep;
  for (int i = 0; i < 5000; ++i) deep += "{\"a\":";
  CHECK(message(deep) == "nested deeper than 64 levels");
  CHECK(message("{\"" + std::string(201, 'k') + "\": 1}") == "a key is longer than 200 bytes");
  CHECK(message(std::string((4 << 20) + 1, ' ')) == "larger than 4 MiB: not a configuration file");
  std::string many = "{";
  for (int i = 0; i < 10001; ++i) many += "\"" + std::to_string(i) + "\":0,";
  CHECK(message(many) == "an object with more than 10000 keys");
  CHECK(read("{\"a\":" + std::string(63, '[') + std::string(63, ']') + "}").faults().empty());
}

TEST_CASE("text from the file is fit for a terminal when it is shown", "[hal][config]") {
  ConfigReader root = read("{\"a\": \"\\u001b[31m" + std::string(100, 'x') + "\"}");
  root.number("a", any);
  CHECK(root.faults()[0].message ==
        "expected a number, found \"\\u001b[31m" + std::string(55, 'x') + "...\"");
}

TEST_CASE("a text that a terminal would obey is a fault", "[hal][config]") {
  for (const char* text :
       {R"({"a": "t\u001b[31mX"})", R"({"a": "nul\u0000"})", R"({"a": "\u007f"})"}) {
    CAPTURE(text);
    ConfigReader root = read(text);
    root.text("a");
    REQUIRE(root.faults().size() == 1);
    CHECK(root.faults()[0].pointer == "/a");
    CHECK(root.faults()[0].message == "holds a control character");
  }
  ConfigReader sound = read(R"({"a": "N·m, 中"})");
  CHECK(sound.text("a") == "N·m, 中");
  CHECK(sound.faults().empty());
}

TEST_CASE("a file that cannot be read is a fault without a line", "[hal][config]") {
  const auto absent = ConfigReader::from_file("/no/such/plan.json");
  CHECK(printed(absent) == "/no/such/plan.json: cannot be read: No such file or directory\n");
  const auto folder = std::filesystem::temp_directory_path();
  CHECK(ConfigReader::from_file(folder).faults().at(0).message == "cannot be read: it is a folder");
}

TEST_CASE("a file is read as its text is", "[hal][config]") {
  const rvbench::test::ScratchFolder scratch;
  const auto file = scratch / "plan.json";
  std::ofstream(file) << "{\"a\": 1.5}";
  auto root = ConfigReader::from_file(file);
  CHECK(root.number("a", any) == 1.5);
  CHECK(printed(root) == "");
}
