#pragma once

#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "hal/types/outcome.hpp"

namespace rvbench::bench {

/// Where a command speaks: results on `out`, progress and complaints on `err`.
struct Console {
  std::ostream& out;
  std::ostream& err;
  bool colour = false;                       ///< on `out`: a terminal that takes escapes
  bool err_is_terminal = false;              ///< a progress bar may be drawn
  std::vector<std::string> complaints = {};  ///< why the command was refused, line by line
  int err_descriptor = -1;                   ///< of what is behind `err`; -1 if nobody can stop it
  int out_columns = 0;                       ///< of the terminal behind `out`; 0: it is none
};

/// Standard output and error of this process. No escapes, so neither colour nor bar, with NO_COLOR
/// or where TERM is missing or "dumb".
Console system_console();

/// Prints a line on standard error and keeps it among the complaints; control characters, which may
/// come from a file, as '?'.
void complain(Console& console, const std::string& text);

/// Whether `err` takes a line at once. A terminal does not after Ctrl-S, nor a pipe that is full:
/// who writes there waits for somebody.
bool takes_a_line(const Console& console);

/// Columns of the terminal behind standard error, or another descriptor; 80 if it does not say.
int terminal_columns(int descriptor = 2);

enum class Tone { good, bad, warning, faint, strong };

/// `text` in that tone if the console has colour, else as it is.
std::string paint(const Console& console, Tone tone, std::string_view text);

Tone tone_of(Outcome outcome);

/// Characters that `text` shows on a terminal (UTF-8 code points).
int shown_width(std::string_view text);

/// Fit for one row of a table: control characters become '?', and what is longer ends in "…".
std::string as_cell(std::string_view text, int columns);

/// With spaces behind it, to that width: fmt pads by bytes in some builds and by columns in others.
/// Before paint(): escapes have no width.
std::string padded(std::string_view text, int columns);

/// The first `columns` characters of `text`; never cuts a UTF-8 sequence.
std::string clipped_to(std::string_view text, int columns);

}  // namespace rvbench::bench
