#pragma once

#include <ostream>
#include <string>
#include <string_view>

#include "hal/types/outcome.hpp"

namespace rvbench::bench {

/// Where a command speaks: results on `out`, progress and complaints on `err`.
struct Console {
  std::ostream& out;
  std::ostream& err;
  bool colour = false;           ///< on `out`: a terminal, and NO_COLOR is not set
  bool err_is_terminal = false;  ///< a progress bar may be drawn
};

/// Standard output and error of this process.
Console system_console();

/// Columns of the terminal behind standard error; 80 if it does not say.
int terminal_columns();

enum class Tone { good, bad, warning, faint, strong };

/// `text` in that tone if the console has colour, else as it is.
std::string paint(const Console& console, Tone tone, std::string_view text);

Tone tone_of(Outcome outcome);

/// Characters that `text` shows on a terminal (UTF-8 code points).
int shown_width(std::string_view text);

/// The first `columns` characters of `text`; never cuts a UTF-8 sequence.
std::string clipped_to(std::string_view text, int columns);

}  // namespace rvbench::bench
