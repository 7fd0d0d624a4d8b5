#pragma once

#include <string>
#include <string_view>

namespace rvbench::bench {

/// Roles of a station, from least to most: each may what those before it may.
enum class Role { viewer, operating, engineer };

/// "viewer", "operator", "engineer".
const char* to_string(Role role);
/// @throws std::invalid_argument: no such role
Role role_of(std::string_view word);

/// Random bytes of the system's, as lower-case hex digits.
std::string random_hex(std::size_t bytes);

/// "anna.8f3a...": a secret of 128 bits that says whose it is.
std::string make_token(const std::string& user);
/// The user in it; "" if it is no token.
std::string user_of_token(const std::string& token);

/// "$argon2id$...": fit to be kept in a file. Takes 64 MiB and about a tenth of a second, on
/// purpose.
/// Source  RFC 9106, through libsodium's crypto_pwhash_str. @throws std::bad_alloc
std::string hash_of_token(const std::string& token);
bool is_token_hash(const std::string& text);
bool matches(const std::string& token, const std::string& hash);  ///< takes as long

/// Takes as long wherever the two differ.
bool are_same_secret(std::string_view a, std::string_view b);

}  // namespace rvbench::bench
