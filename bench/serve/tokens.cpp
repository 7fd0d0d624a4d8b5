#include "bench/serve/tokens.hpp"

#include <sodium.h>

#include <array>
#include <new>
#include <stdexcept>
#include <vector>

namespace rvbench::bench {
namespace {

constexpr std::size_t secret_bytes = 16;

// libsodium must know the computer before its random numbers and Argon2 are used.
void prepare() {
  static const int prepared = sodium_init();
  if (prepared < 0) throw std::runtime_error("libsodium cannot be used on this computer");
}

}  // namespace

const char* to_string(Role role) {
  switch (role) {
    case Role::viewer: return "viewer";
    case Role::operating: return "operator";
    case Role::engineer: return "engineer";
  }
  return "?";
}

Role role_of(std::string_view word) {
  for (const Role role : {Role::viewer, Role::operating, Role::engineer}) {
    if (word == to_string(role)) return role;
  }
  throw std::invalid_argument("role_of: no role " + std::string(word));
}

std::string random_hex(std::size_t bytes) {
  prepare();
  std::vector<unsigned char> random(bytes);
  randombytes_buf(random.data(), random.size());
  std::string text(2 * bytes + 1, '\0');
  sodium_bin2hex(text.data(), text.size(), random.data(), random.size());
  text.pop_back();
  return text;
}

std::string make_token(const std::string& user) { return user + "." + random_hex(secret_bytes); }

std::string user_of_token(const std::string& token) {
  const std::size_t dot = token.rfind('.');
  return dot == std::string::npos ? "" : token.substr(0, dot);
}

std::string hash_of_token(const std::string& token) {
  prepare();
  std::array<char, crypto_pwhash_STRBYTES> hash{};
  if (crypto_pwhash_str_alg(hash.data(), token.data(), token.size(),
                            crypto_pwhash_OPSLIMIT_INTERACTIVE, crypto_pwhash_MEMLIMIT_INTERACTIVE,
                            crypto_pwhash_ALG_ARGON2ID13) != 0) {
    throw std::bad_alloc();
  }
  return hash.data();
}

bool is_token_hash(const std::string& text) {
  prepare();
  if (!text.starts_with("$argon2id$") || text.size() >= crypto_pwhash_STRBYTES) return false;
  // -1 tells a text that is no hash; 1 one of other costs, which is as good.
  return crypto_pwhash_str_needs_rehash(text.c_str(), crypto_pwhash_OPSLIMIT_INTERACTIVE,
                                        crypto_pwhash_MEMLIMIT_INTERACTIVE) != -1;
}

bool matches(const std::string& token, const std::string& hash) {
  prepare();
  return crypto_pwhash_str_verify(hash.c_str(), token.data(), token.size()) == 0;
}

bool are_same_secret(std::string_view a, std::string_view b) {
  return a.size() == b.size() && sodium_memcmp(a.data(), b.data(), a.size()) == 0;
}

}  // namespace rvbench::bench
