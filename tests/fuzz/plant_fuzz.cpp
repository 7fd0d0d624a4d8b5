#include "sim/plant_json.hpp"
#include "tests/fuzz/scratch_file.hpp"

using namespace rvbench;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  auto plant = sim::parse_plant(hal::ConfigReader::from_text(test::text_of(data, size), "plant"));
  if (plant.index() == 1) {
    test::must(!std::get<1>(plant).empty());
    return 0;
  }
  const std::string written = sim::write_plant(std::get<0>(plant));
  auto again = sim::parse_plant(hal::ConfigReader::from_text(written, "plant"));
  test::must(again.index() == 0 && sim::write_plant(std::get<0>(again)) == written);
  return 0;
}
