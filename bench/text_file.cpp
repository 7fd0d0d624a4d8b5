#include "bench/text_file.hpp"

#include <fstream>
#include <sstream>

#include "bench/on_disk.hpp"
#include "hal/formats/file_draft.hpp"

namespace rvbench::bench {

std::string reason_of(const std::system_error& error) {
  const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&error);
  return file == nullptr ? error.what() : file->path1().string() + ": " + error.code().message();
}

std::filesystem::path drafted_file(const std::filesystem::path& draft) {
  // Repairs of recordings, and earlier versions, have one name for all drafts of a file.
  if (draft.extension() == ".draft") return draft.parent_path() / draft.stem();
  return hal::formats::drafted_file(draft);
}

void write_file(const std::filesystem::path& file, const std::string& text) {
  hal::formats::FileDraft draft(file, true);
  Status done = draft.begin();
  if (done) done = draft.write(text);
  if (done) done = draft.finish();
  if (!done) throw_error(draft.error(), file);
}

std::optional<std::string> read_file(const std::filesystem::path& file) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(file, unknown)) return std::nullopt;  // a pipe would block
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  std::ostringstream text;
  text << in.rdbuf();
  if (in.bad() || text.bad()) return std::nullopt;
  return text.str();
}

}  // namespace rvbench::bench
