#include <string_view>

#include "hal/can/slcan_frames.hpp"
#include "tests/fuzz/scratch_file.hpp"

using namespace rvbench;
using namespace hal::slcan_frames;

namespace {

void must_make_sense(const Line& line) {
  if (line.kind == LineKind::frame) {
    test::must(line.frame.id <= 0x7FF && line.frame.length <= 8);
    // What was read can be written, and is then read as the same.
    const std::string command = command_from(line.frame);
    const Line again = line_from(std::string_view(command).substr(0, command.size() - 1));
    test::must(again.kind == LineKind::frame && again.frame.id == line.frame.id &&
               again.frame.length == line.frame.length && again.frame.data == line.frame.data);
  }
  if (line.kind == LineKind::flags) test::must(line.flags <= 0xFF);
  if (line.kind == LineKind::garbled) test::must(line.flags == 0);
}

}  // namespace

// An adapter says anything, in two pieces. Each line comes out once, wherever it was cut.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string bytes = test::text_of(data + 1, size - 1);
  const std::size_t cut = bytes.empty() ? 0 : data[0] % bytes.size();
  LineReader whole, pieces;
  whole.add(bytes);
  pieces.add(bytes.substr(0, cut));
  bool is_second = false;
  while (const auto expected = whole.next()) {
    must_make_sense(*expected);
    auto line = pieces.next();
    if (!line && !is_second) {
      is_second = true;
      pieces.add(bytes.substr(cut));
      line = pieces.next();
    }
    test::must(line && line->kind == expected->kind && line->flags == expected->flags &&
               line->frame.data == expected->frame.data);
  }
  if (!is_second) {
    test::must(!pieces.next());
    pieces.add(bytes.substr(cut));
  }
  test::must(!pieces.next());
  return 0;
}
