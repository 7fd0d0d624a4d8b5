#include <cmath>

#include "hal/can/dbc.hpp"
#include "tests/fuzz/scratch_file.hpp"

using namespace rvbench;

// Whatever a database says, its signals can be read out of any frame.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto parsed = hal::dbc::parse(test::text_of(data, size));
  if (parsed.index() == 1) {
    test::must(!std::get<1>(parsed).empty());
    return 0;
  }
  for (const hal::dbc::Message& message : std::get<0>(parsed).messages) {
    for (const std::uint8_t byte : {std::uint8_t{0}, std::uint8_t{0x5A}, std::uint8_t{0xFF}}) {
      hal::CanFrame frame{.id = message.id, .length = 8};
      frame.data.fill(byte);
      for (const hal::dbc::Signal& signal : message.signals) {
        (void)hal::dbc::value_of(message, signal, frame);
      }
    }
  }
  return 0;
}
