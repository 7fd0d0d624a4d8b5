#pragma once

#include <cstddef>
#include <string_view>

namespace rvbench {

/// Bytes of the UTF-8 character that begins at text[at]; 0 if none does: a stray or missing
/// continuation, an overlong form, a surrogate, beyond U+10FFFF, or the end of the text.
///
/// Source  RFC 3629, section 4
std::size_t utf8_character_bytes(std::string_view text, std::size_t at);

}  // namespace rvbench
