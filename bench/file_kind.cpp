#include "bench/file_kind.hpp"

#include <array>
#include <system_error>
#include <utility>

namespace rvbench::bench {
namespace {

constexpr std::array<std::pair<const char*, const char*>, 10> key_of_kind = {
    {{"broker", "host"},
     {"station", "station"},  // which names plan and rig
     {"plan", "main"},
     {"rig", "rig"},
     {"rig", "preset"},  // of a simulated one, which need not say so
     {"kinematics", "machine"},
     {"plant", "plant"},
     {"campaign", "campaign"},
     {"tpa", "tpa"},
     {"limits", "limits_version"}}};

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

}  // namespace rvbench::bench
