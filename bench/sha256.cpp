#include "bench/sha256.hpp"

#include <sodium.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <map>
#include <sstream>
#include <system_error>

#include "bench/on_disk.hpp"
#include "bench/text_file.hpp"

namespace rvbench::bench {
namespace {

constexpr const char* sums_name = "SHA256SUMS";
constexpr const char* unread = ": is no regular file, or cannot be read";
constexpr std::size_t hex_digits = 2 * crypto_hash_sha256_BYTES;

class Sha256 {
 public:
  Sha256() { crypto_hash_sha256_init(&state_); }

  void add(const char* bytes, std::size_t count) {
    crypto_hash_sha256_update(&state_, reinterpret_cast<const unsigned char*>(bytes), count);
  }

  std::string hex() {
    std::array<unsigned char, crypto_hash_sha256_BYTES> digest{};
    crypto_hash_sha256_final(&state_, digest.data());
    std::array<char, hex_digits + 1> text{};
    sodium_bin2hex(text.data(), text.size(), digest.data(), digest.size());
    return text.data();
  }

 private:
  crypto_hash_sha256_state state_{};
};

// Also a link that leads nowhere.
bool is_there(const std::filesystem::path& file) {
  std::error_code unknown;
  const auto type = std::filesystem::symlink_status(file, unknown).type();
  return type != std::filesystem::file_type::not_found;
}

struct Contents {
  std::vector<std::string> files, others;
};

// A draft of a file of the folder, or of the list, is what a kill has left.
bool is_left_draft(const std::filesystem::path& folder, const std::string& name) {
  const std::filesystem::path of = drafted_file(name);
  return of == sums_name || (!of.empty() && is_there(folder / of));
}

// Of the folder, but for the list itself and drafts; sorted by name.
Contents contents_of(const std::filesystem::path& folder) {
  Contents contents;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name == sums_name || is_left_draft(folder, name)) continue;
    std::error_code unknown;  // of a link that leads nowhere
    (entry.is_regular_file(unknown) ? contents.files : contents.others).push_back(name);
  }
  std::ranges::sort(contents.files);
  std::ranges::sort(contents.others);
  return contents;
}

// "<64 hex digits>  <name>" → name and hash; nullopt if the line is something else.
std::optional<std::pair<std::string, std::string>> parse_sum(const std::string& line) {
  const bool shaped = line.size() > hex_digits + 2 && line[hex_digits] == ' ' &&
                      (line[hex_digits + 1] == ' ' || line[hex_digits + 1] == '*') &&
                      line.find_first_not_of("0123456789abcdef") == hex_digits;
  if (!shaped) return std::nullopt;
  const std::string name = line.substr(hex_digits + 2);
  if (name.find('/') != std::string::npos) return std::nullopt;  // never leaves the folder
  return std::pair{name, line.substr(0, hex_digits)};
}

// Of SHA256SUMS. The file is on the disk before its sum is.
std::string line_of(const std::filesystem::path& folder, const std::string& name) {
  put_on_disk(folder / name);
  const std::optional<std::string> sum = sha256_of_file(folder / name);
  if (!sum) throw_error(EIO, folder / name);
  return *sum + "  " + name + "\n";
}

}  // namespace

std::string sha256_of_text(const std::string& text) {
  Sha256 sum;
  sum.add(text.data(), text.size());
  return sum.hex();
}

std::optional<std::string> sha256_of_file(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return std::nullopt;  // a pipe would block
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  Sha256 sum;
  std::vector<char> block(1U << 16U);
  while (in) {
    in.read(block.data(), static_cast<std::streamsize>(block.size()));
    sum.add(block.data(), static_cast<std::size_t>(in.gcount()));
  }
  if (in.bad()) return std::nullopt;
  return sum.hex();
}

void write_sums(const std::filesystem::path& folder) {
  std::string text;
  for (const std::string& name : contents_of(folder).files) text += line_of(folder, name);
  write_file(folder / sums_name, text);
}

void renew_sums(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  const std::optional<std::string> old = read_file(folder / sums_name);
  if (!old) throw_error(EIO, folder / sums_name);
  std::map<std::string, std::string> text_by_name;  // sorted by it, as write_sums() sorts
  std::istringstream lines(*old);
  for (std::string line; std::getline(lines, line);) {
    const auto sum = parse_sum(line);
    text_by_name[sum ? sum->first : line] = line + "\n";
  }
  for (const std::string& name : names) text_by_name[name] = line_of(folder, name);
  std::string text;
  for (const auto& [name, line] : text_by_name) text += line;
  write_file(folder / sums_name, text);
}

bool has_sums(const std::filesystem::path& folder) {
  std::error_code unknown;
  return std::filesystem::exists(folder / sums_name, unknown);
}

void remove_sums(const std::filesystem::path& folder) {
  const std::filesystem::path sums = folder / sums_name;
  if (!std::filesystem::remove(sums)) return;
  put_folder_on_disk(sums);
}

bool matches_sum(const std::filesystem::path& folder, const std::string& name) {
  const auto sum = sha256_of_file(folder / name);
  if (!sum) return false;
  std::istringstream lines(read_file(folder / sums_name).value_or(""));
  for (std::string line; std::getline(lines, line);) {
    if (parse_sum(line) == std::pair{name, *sum}) return true;
  }
  return false;
}

std::vector<std::string> verify_sums(const std::filesystem::path& folder) {
  const std::optional<std::string> list = read_file(folder / sums_name);
  if (!list && is_there(folder / sums_name)) return {std::string(sums_name) + unread};
  if (!list) return {std::string(sums_name) + ": missing; the run did not finish"};
  std::vector<std::string> faults;
  std::map<std::string, std::string> sums;
  std::istringstream lines(*list);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const auto sum = parse_sum(line);
    if (sum) {
      sums.insert(*sum);
    } else {
      faults.push_back(std::string(sums_name) + ":" + std::to_string(number) +
                       ": not a line of sha256sum");
    }
  }
  for (const auto& [name, sum] : sums) {
    const std::optional<std::string> actual = sha256_of_file(folder / name);
    if (!actual) faults.push_back(name + (is_there(folder / name) ? unread : ": missing"));
    if (actual && *actual != sum) faults.push_back(name + ": does not match its hash");
  }
  const Contents contents = contents_of(folder);
  for (const std::string& name : contents.files) {
    if (!sums.contains(name)) faults.push_back(name + ": not listed in " + sums_name);
  }
  for (const std::string& name : contents.others) {
    if (!sums.contains(name)) faults.push_back(name + ": not a file of the run");
  }
  return faults;
}

}  // namespace rvbench::bench
