#include "bench/serve/page_file.hpp"

#include <algorithm>
#include <filesystem>
#include <map>

#include "bench/page_files.hpp"

namespace rvbench::bench {
namespace {

std::string type_of(const std::string& name) {
  static const std::map<std::string, std::string> types{{".html", "text/html; charset=utf-8"},
                                                        {".css", "text/css; charset=utf-8"},
                                                        {".js", "text/javascript; charset=utf-8"},
                                                        {".json", "application/json"},
                                                        {".svg", "image/svg+xml"}};
  const auto found = types.find(std::filesystem::path(name).extension().string());
  return found == types.end() ? "application/octet-stream" : found->second;
}

}  // namespace

// Names are compared, no file is looked for: no path leads anywhere else.
HttpAnswer page_file(const std::string& path) {
  const std::string name = path == "/" ? "index.html" : path.substr(1);
  const auto found = std::ranges::find(page_files(), name, &EmbeddedFile::name);
  if (found == page_files().end()) return refusal(404, "not_found");
  return {.type = type_of(name), .body = found->text};
}

}  // namespace rvbench::bench
