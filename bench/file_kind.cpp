#include "bench/file_kind.hpp"

#include <array>
#include <system_error>
#include <utility>

#include "hal/did_you_mean.hpp"

namespace rvbench::bench {
namespace {

constexpr std::array<std::pair<const char*, const char*>, 5> key_of_kind = {
    {{"plan", "main"},
     {"rig", "rig"},
     {"kinematics", "machine"},
     {"plant", "plant"},
     {"campaign", "campaign"}}};

}  // namespace

std::string file_kind(const hal::ConfigReader& root) {
  for (const auto& [kind, key] : key_of_kind) {
    if (root.has(key)) return kind;
  }
  return "";
}

std::optional<hal::ConfigFault> other_kind_fault(const hal::ConfigReader& root,
                                                 const std::string& wanted) {
  const std::string kind = file_kind(root);
  if (kind.empty() || kind == wanted) return std::nullopt;
  return hal::ConfigFault{0, "", "seems to be a " + kind + " file, not a " + wanted + " file"};
}

bool is_absent(const std::filesystem::path& file) {
  std::error_code unknown;
  return std::filesystem::status(file, unknown).type() == std::filesystem::file_type::not_found;
}

std::vector<std::string> names_of(const std::vector<EmbeddedFile>& files) {
  std::vector<std::string> names;
  for (const EmbeddedFile& file : files) names.push_back(file.name);
  return names;
}

std::string listed(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

std::string what_there_is(const std::string& wrong, const std::vector<std::string>& names) {
  return " (there are: " + listed(names) + ")" + hal::did_you_mean(wrong, names);
}

}  // namespace rvbench::bench
