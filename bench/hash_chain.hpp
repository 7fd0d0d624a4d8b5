#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

/// Lines of JSON, each of which carries the hash of the line before and its own: one that is
/// changed, taken out, put in or moved breaks the chain there. Lines taken from the end do not.
///
///     {...,"previous":"<64 hex digits>","hash":"<64 hex digits>"}
///
/// hash is the SHA-256 of the line up to, and without, `,"hash":`.
namespace rvbench::bench {

/// What the first line follows: 64 zeros.
extern const std::string chain_begin;

/// The line, without its end.
std::string chained_line(nlohmann::ordered_json object, const std::string& previous);

/// The hash that it states; "" if it states none at its end.
std::string hash_of_line(const std::string& line);

/// What is wrong with a line after the one of that hash; "" if it follows.
std::string chain_fault(const std::string& line, const std::string& previous);

}  // namespace rvbench::bench
