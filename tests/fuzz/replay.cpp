// Replays inputs through a fuzz target, without a fuzzer: PROGRAM FILE_OR_FOLDER...
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <vector>

#include "tests/fuzz/scratch_file.hpp"

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_under(const fs::path& path) {
  if (!fs::is_directory(path)) return {path};
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(path)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

void replay(const std::string& bytes) {
  (void)LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

}  // namespace

int main(int argc, char** argv) {
  int inputs = 0;
  for (int i = 1; i < argc; ++i) {
    for (const fs::path& file : files_under(argv[i])) {
      std::ifstream in(file, std::ios::binary);
      const std::string bytes{std::istreambuf_iterator<char>(in), {}};
      std::cerr << file.string() << '\n';  // the last one is what broke it
      replay(bytes);
      // Cut off anywhere it must be no worse.
      for (int part = 1; part < 16; ++part) {
        replay(bytes.substr(0, bytes.size() * static_cast<std::size_t>(part) / 16));
      }
      ++inputs;
    }
  }
  std::cerr << inputs << " inputs, each also cut off at 15 places\n";
  return inputs > 0 ? 0 : 1;
}
