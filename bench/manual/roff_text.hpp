#pragma once

#include <string>
#include <string_view>

namespace rvbench::bench {

/// Text as it is, for a page of groff_man(7): what roff would take for a request, an escape or a
/// typographic sign is written so that it is shown, and can be copied, as that character.
/// @param text  UTF-8, one line or many
std::string roff_text(std::string_view text);

/// The same as a paragraph: in lines of at most 76 characters, broken at spaces, which man(1) fills
/// again.
std::string roff_paragraph(std::string_view text);

}  // namespace rvbench::bench
