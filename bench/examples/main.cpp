#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "bench/example_sources.hpp"
#include "bench/examples/page.hpp"
#include "bench/examples/picture.hpp"
#include "bench/text_file.hpp"

using namespace rvbench;

namespace {

const std::string& source_of(const std::string& name) {
  const auto source = std::ranges::find(bench::example_sources(), name,
                                        [](const EmbeddedFile& file) { return file.name; });
  if (source == bench::example_sources().end()) throw std::logic_error(name + ": no such source");
  return source->text;
}

void write_pages(const std::filesystem::path& folder) {
  const auto examples = analysis::examples::all_examples();
  for (const auto& example : examples) {
    const std::string picture = bench::picture_of(example);
    bench::write_file(folder / (example.name + ".md"),
                      bench::page_of(example, source_of(example.name)));
    bench::write_file(folder / (example.name + ".svg"), picture);
    fmt::print("{}: {} figures, {} bytes of plot\n", example.name, example.figures.size(),
               picture.size());
  }
  bench::write_file(folder / "README.md", bench::index_of(examples));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "rvbench_examples FOLDER: writes a page and a plot for each method\n");
    return 2;
  }
  try {
    write_pages(argv[1]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "rvbench_examples: {}\n", error.what());
    return 1;
  }
  return 0;
}
