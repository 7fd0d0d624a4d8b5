#include "sequences/plan.hpp"
#include "tests/fuzz/scratch_file.hpp"

using namespace rvbench;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  auto plan =
      sequences::parse_plan(hal::ConfigReader::from_text(test::text_of(data, size), "plan"));
  if (plan.index() == 1) {
    test::must(!std::get<1>(plan).empty());
    return 0;
  }
  const std::string written = sequences::plan_to_json(std::get<0>(plan));
  auto again = sequences::parse_plan(hal::ConfigReader::from_text(written, "plan"));
  test::must(again.index() == 0 && sequences::plan_to_json(std::get<0>(again)) == written);
  return 0;
}
