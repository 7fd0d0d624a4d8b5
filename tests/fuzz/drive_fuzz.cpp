#include <algorithm>
#include <initializer_list>

#include "hal/modbus/drive_profile_json.hpp"
#include "hal/modbus/drive_words.hpp"
#include "tests/fuzz/scratch_file.hpp"

using namespace rvbench;

namespace {

// Whatever a profile says, the words that it asks for are enough to tell its state.
void ask(const hal::DriveProfile& profile) {
  for (const std::uint16_t word : std::initializer_list<std::uint16_t>{0, 0x5555, 0x8000, 0xFFFF}) {
    hal::DriveWords words;
    for (const auto& blocks : {hal::status_blocks(profile), hal::watchdog_blocks(profile)}) {
      for (const hal::DriveBlock& block : blocks) {
        for (int i = 0; i < block.count; ++i) {
          words[static_cast<std::uint16_t>(block.address + i)] = word;
        }
      }
    }
    (void)hal::drive_status(profile, words, {});
    (void)hal::drive_watchdog(profile, words);
  }
  for (const hal::DriveWrite& write : hal::words_for_stop(profile)) {
    test::must(std::find(profile.writable.begin(), profile.writable.end(), write.address) !=
               profile.writable.end());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const test::ScratchFile file(".json");
  const auto profile = hal::read_drive_profile(file.holding(data, size));
  if (profile.index() == 0) {
    ask(std::get<0>(profile));
  } else {
    test::must(!std::get<1>(profile).empty());
  }
  return 0;
}
