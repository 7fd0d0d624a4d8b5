#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rvbench::hal::formats {

/// One data set of a universal file: what stands between two lines "    -1".
struct UffDataset {
  int number = 0;            ///< 58, 151, 2411 ...
  bool is_binary = false;    ///< "58b"
  std::size_t line = 0;      ///< of its number; the file's first line is 1
  std::string_view heading;  ///< the line of its number
  std::string_view body;     ///< all lines after it, and what is binary
  bool is_closed = false;    ///< the second "    -1" is there
};

/// Whether bytes that begin so are a universal file.
bool is_uff(std::string_view head);

/// The data sets in their order; text between them is passed over. Of a binary one the number of
/// bytes that it declares is passed over too, for these may look like a line "    -1".
///
/// Source  SDRC, Universal File Formats; University of Cincinnati, SDRL, "Universal File Formats"
std::vector<UffDataset> uff_datasets(std::string_view bytes);

/// What a file holds, for whoever looked for something else: "geometry (15, 2411), units (164)".
std::string contents_of(const std::vector<UffDataset>& datasets);

/// Takes the next line off `text`, without its "\n" or "\r\n".
std::string_view take_line(std::string_view& text);

}  // namespace rvbench::hal::formats
