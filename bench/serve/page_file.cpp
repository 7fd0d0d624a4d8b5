#include "bench/serve/page_file.hpp"

#include <algorithm>
#include <filesystem>
#include <map>

#include "bench/page_files.hpp"
#include "bench/page_plot_files.hpp"

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
  for (const auto* files : {&page_files(), &page_plot_files()}) {
    const auto found = std::ranges::find(*files, name, &EmbeddedFile::name);
    if (found != files->end()) return {.type = type_of(name), .body = found->text};
  }
  return refusal(404, "not_found");
}

}  // namespace rvbench::bench
