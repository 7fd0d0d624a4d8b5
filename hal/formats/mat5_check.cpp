#include "hal/formats/mat5_check.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace rvbench::hal::formats {
namespace {

constexpr std::size_t header_bytes = 128;
constexpr std::size_t most_inflated_bytes = std::size_t{1} << 30;
constexpr int deepest = 16;

enum Type : std::uint32_t {
  int8 = 1,
  int32 = 5,
  uint32 = 6,
  last_number_type = 13,
  matrix = 14,
  compressed = 15
};
enum Class : std::uint32_t {
  cell = 1,
  structure = 2,
  text = 4,
  first_number = 6,
  last_number = 15
};

// Found anywhere below; find_mat5_fault() turns it into its answer.
struct Fault : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Bytes of one value of a numeric type; 0 if the type is none.
std::size_t value_bytes(std::uint32_t type) {
  switch (type) {
    case 1:
    case 2:
    case 16: return 1;
    case 3:
    case 4:
    case 17: return 2;
    case 5:
    case 6:
    case 7:
    case 18: return 4;
    case 9:
    case 12:
    case 13: return 8;
    default: return 0;
  }
}

struct Element {
  std::uint32_t type = 0;
  std::string_view data;
  bool is_small = false;  // kept inside its tag
};

// The elements in a stretch of bytes, one after the other.
class Elements {
 public:
  Elements(std::string_view bytes, bool swapped) : bytes_(bytes), swapped_(swapped) {}

  bool at_end() const { return at_ >= bytes_.size(); }
  std::size_t at() const { return at_; }

  Element next() {
    if (bytes_.size() - std::min(at_, bytes_.size()) < 8) throw Fault("the file is cut off");
    const std::uint32_t first = word(bytes_.substr(at_), swapped_);
    if (first >> 16U != 0) return small(first);
    const std::size_t size = word(bytes_.substr(at_ + 4), swapped_);
    const std::size_t left = bytes_.size() - at_ - 8;
    if (size > left) throw Fault(fmt::format("claims {} bytes, {} are left", size, left));
    const Element element{first, bytes_.substr(at_ + 8, size), false};
    at_ += 8 + (first == compressed ? size : (size + 7) / 8 * 8);
    return element;
  }

  static std::uint32_t word(std::string_view bytes, bool swapped) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data(), sizeof(value));
    return swapped ? __builtin_bswap32(value) : value;
  }

 private:
  // Up to four bytes inside the tag itself.
  Element small(std::uint32_t first) {
    const std::size_t size = first >> 16U;
    if (size > 4) throw Fault("a tag makes no sense");
    const Element element{first & 0xFFFFU, bytes_.substr(at_ + 4, size), true};
    at_ += 8;
    return element;
  }

  std::string_view bytes_;
  bool swapped_;
  std::size_t at_ = 0;
};

Element expect(Elements& elements, std::uint32_t type, const char* what) {
  const Element element = elements.next();
  if (element.type != type) throw Fault(fmt::format("no {} where it should be", what));
  return element;
}

std::size_t count_of(std::string_view dimensions, bool swapped) {
  if (dimensions.size() < 8 || dimensions.size() % 4 != 0 || dimensions.size() > 128) {
    throw Fault("has no size");
  }
  double count = 1;
  for (std::size_t i = 0; i < dimensions.size(); i += 4) {
    const std::uint32_t extent = Elements::word(dimensions.substr(i), swapped);
    if (extent > INT32_MAX) throw Fault("has a negative size");
    count *= extent;
  }
  if (count > 1e12) throw Fault("claims more values than any file holds");
  return static_cast<std::size_t>(count);
}

void check_values(Elements& elements, std::size_t count, bool is_text) {
  const Element values = elements.next();
  const std::size_t bytes = value_bytes(values.type);
  if (bytes == 0 || (values.type > last_number_type && !is_text))
    throw Fault("its values are of no known type");
  if (values.data.size() != count * bytes) {
    throw Fault(fmt::format("has {} values, its size says {}", values.data.size() / bytes, count));
  }
}

void check_matrix(std::string_view bytes, bool swapped, int depth);

void check_members(Elements& elements, std::size_t count, bool swapped, int depth) {
  for (std::size_t i = 0; i < count; ++i) {
    check_matrix(expect(elements, matrix, "member").data, swapped, depth + 1);
  }
}

void check_structure(Elements& elements, std::size_t count, bool swapped, int depth) {
  const Element length = expect(elements, int32, "length of field names");
  // The format allows either form of tag here, but matio knows one only.
  if (length.data.size() != 4 || !length.is_small) throw Fault("its field names have no length");
  const std::uint32_t bytes = Elements::word(length.data, swapped);
  const Element names = expect(elements, int8, "field names");
  if (bytes == 0 || bytes > 64 || names.data.size() % bytes != 0 || names.is_small) {
    throw Fault("its field names make no sense");
  }
  for (std::size_t i = 0; i < names.data.size(); i += bytes) {
    if (names.data.substr(i, bytes).find('\0') == std::string_view::npos) {
      throw Fault("a field name has no end");
    }
  }
  check_members(elements, count * (names.data.size() / bytes), swapped, depth);
}

void check_content(Elements& elements, std::uint32_t flags, std::size_t count, bool swapped,
                   int depth) {
  const std::uint32_t kind = flags & 0xFFU;
  const bool is_complex = (flags & 0x800U) != 0;
  if (kind == cell) return check_members(elements, count, swapped, depth);
  if (kind == structure) return check_structure(elements, count, swapped, depth);
  if (kind != text && (kind < first_number || kind > last_number)) {
    throw Fault("is neither a plain array nor a structure");
  }
  check_values(elements, count, kind == text);
  if (is_complex) check_values(elements, count, kind == text);
}

// An array with all it holds. Without any bytes it is an empty member.
void check_matrix(std::string_view bytes, bool swapped, int depth) {
  if (bytes.empty() && depth > 0) return;
  if (depth > deepest) throw Fault("is nested too deep");
  Elements elements(bytes, swapped);
  const Element flags = expect(elements, uint32, "array flags");
  if (flags.data.size() != 8) throw Fault("its array flags make no sense");
  const Element dimensions = expect(elements, int32, "array size");
  const Element name = expect(elements, int8, "name");
  if (name.data.size() > 256) throw Fault("its name is too long");
  try {
    check_content(elements, Elements::word(flags.data, swapped), count_of(dimensions.data, swapped),
                  swapped, depth);
    if (!elements.at_end()) throw Fault("has more bytes than its size says");
  } catch (const Fault& fault) {
    if (name.data.empty()) throw;
    throw Fault(fmt::format("{}: {}", name.data, fault.what()));
  }
}

// Whole or not at all: zlib checks a sum at the end.
std::string inflated(std::string_view bytes) {
  z_stream stream{};
  std::string out;
  if (inflateInit(&stream) != Z_OK) throw Fault("zlib cannot start");
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  int status = Z_OK;
  while (status == Z_OK && out.size() < most_inflated_bytes) {
    const std::size_t before = out.size();
    out.resize(before + std::max<std::size_t>(before, 65536));
    stream.next_out = reinterpret_cast<Bytef*>(out.data() + before);
    stream.avail_out = static_cast<uInt>(out.size() - before);
    status = inflate(&stream, Z_NO_FLUSH);
    out.resize(out.size() - stream.avail_out);
  }
  const bool whole = status == Z_STREAM_END && stream.avail_in == 0;
  inflateEnd(&stream);
  if (!whole) throw Fault("a compressed variable is damaged or too large");
  return out;
}

void check_variable(const Element& element, bool swapped) {
  if (element.type == matrix) return check_matrix(element.data, swapped, 0);
  if (element.type != compressed) throw Fault("no variable where one should begin");
  const std::string bytes = inflated(element.data);
  Elements inner(bytes, swapped);
  check_matrix(expect(inner, matrix, "variable").data, swapped, 0);
  if (!inner.at_end()) throw Fault("has more bytes than its size says");
}

}  // namespace

std::optional<std::string> find_mat5_fault(std::string_view file) {
  if (file.size() < header_bytes) return "shorter than the header of a MAT v5 file";
  const std::string_view order = file.substr(126, 2);
  if (order != "IM" && order != "MI") return "not a MAT v5 file";
  const bool swapped = order == "MI";  // written by a big-endian machine
  const std::string_view version_1 =
      swapped ? std::string_view("\x01\0", 2) : std::string_view("\0\x01", 2);
  if (file.substr(124, 2) != version_1) return "not a MAT v5 file (save it with -v7 or -v6)";
  Elements variables(file.substr(header_bytes), swapped);
  while (!variables.at_end()) {
    const std::size_t at = variables.at() + header_bytes;
    try {
      check_variable(variables.next(), swapped);
    } catch (const Fault& fault) {
      return fmt::format("variable at byte {}: {}", at, fault.what());
    }
  }
  return std::nullopt;
}

}  // namespace rvbench::hal::formats
