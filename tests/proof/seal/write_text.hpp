#pragma once

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace seal {

/// @throws std::runtime_error if not all of it comes to be there
inline void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file);
  out << text << std::flush;
  if (!out) throw std::runtime_error("cannot write " + file.string());
}

}  // namespace seal
