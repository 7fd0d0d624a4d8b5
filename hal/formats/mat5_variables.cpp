#include "hal/formats/mat5_variables.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <utility>
#include <vector>

#include "hal/formats/utf16.hpp"

namespace rvbench::hal::formats {
namespace {

constexpr std::size_t header_bytes = 128;
constexpr std::size_t most_inflated_bytes = std::size_t{1} << 30;
constexpr int deepest = 16;

enum Type : std::uint32_t {
  int8 = 1,
  uint16 = 4,
  int32 = 5,
  uint32 = 6,
  float64 = 9,
  last_number_type = 13,
  matrix = 14,
  compressed = 15,
  utf8 = 16
};
enum Class : std::uint32_t {
  cell = 1,
  structure = 2,
  object = 3,
  text = 4,
  sparse = 5,
  first_number = 6,
  last_number = 15,
  function_handle = 16,
  opaque = 17
};

constexpr std::size_t longest_field_name = 64;

// Found anywhere below; visit_mat5() turns it into its answer.
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

// What is not read, in the words of MATLAB's users.
std::string kind_of(std::uint32_t class_of) {
  switch (class_of) {
    case object: return "object";
    case sparse: return "sparse array";
    case function_handle: return "function handle";
    case opaque: return "string, table or object";
    default: return fmt::format("of an unknown class, {}", class_of);
  }
}

// A variable or a member, written anew as it is read.
class Rewriting {
 public:
  Rewriting(bool swapped, const Mat5Visitor& visitor) : swapped_(swapped), visitor_(visitor) {}

  // The variable as an element; empty if it is of a kind that is not read.
  std::string variable(std::string_view bytes) { return matrix_of(bytes, "", 0); }

 private:
  std::string word(std::uint32_t value) const {
    std::string bytes(sizeof value, '\0');
    if (swapped_) value = __builtin_bswap32(value);
    std::memcpy(bytes.data(), &value, sizeof value);
    return bytes;
  }

  std::string element(std::uint32_t type, std::string_view data) const {
    std::string bytes = word(type) + word(static_cast<std::uint32_t>(data.size()));
    bytes += data;
    bytes.resize((bytes.size() + 7) / 8 * 8);
    return bytes;
  }

  // An array without values stands for a member that is not read.
  std::string nothing(std::string_view name) const {
    return element(matrix, element(uint32, word(first_number) + word(0)) +
                               element(int32, word(0) + word(0)) + element(int8, name) +
                               element(float64, ""));
  }

  std::string values(Elements& elements, std::size_t count) const {
    const Element values = elements.next();
    const std::size_t bytes = value_bytes(values.type);
    if (bytes == 0 || values.type > last_number_type) {
      throw Fault("its values are of no known type");
    }
    if (values.data.size() != count * bytes) {
      throw Fault(
          fmt::format("has {} values, its size says {}", values.data.size() / bytes, count));
    }
    return element(values.type, values.data);
  }

  // In UTF-16, whose units the size counts. Nothing if they are not as many.
  std::optional<std::string> text_values(Elements& elements, std::size_t count) const {
    const Element values = elements.next();
    const std::size_t bytes = value_bytes(values.type);
    if (bytes == 0) throw Fault("its text is of no known type");
    if (values.type != utf8) {
      if (values.data.size() != count * bytes) return std::nullopt;
      const bool is_utf16 = bytes == 2;
      return element(is_utf16 ? std::uint32_t{uint16} : values.type, values.data);
    }
    const std::vector<std::uint16_t> units = utf16_of(values.data);
    if (units.size() != count) return std::nullopt;
    std::string data;
    for (std::uint16_t unit : units) {
      if (swapped_) unit = __builtin_bswap16(unit);
      data.append(reinterpret_cast<const char*>(&unit), sizeof unit);
    }
    return element(uint16, data);
  }

  std::string members(Elements& elements, const std::vector<std::string>& names, int depth) {
    std::string bytes;
    for (const std::string& name : names) {
      const std::string_view member = expect(elements, matrix, "member").data;
      if (member.empty()) {
        bytes += element(matrix, "");
        continue;
      }
      std::string written = matrix_of(member, name, depth + 1);
      bytes += written.empty() ? nothing("") : std::move(written);
    }
    return bytes;
  }

  // With room for names of full length: the reader takes no names that lie inside their tag.
  std::string fields(Elements& elements, std::size_t count, const std::string& path, int depth) {
    const Element length = expect(elements, int32, "length of field names");
    if (length.data.size() != 4) throw Fault("its field names have no length");
    const std::uint32_t bytes = Elements::word(length.data, swapped_);
    const Element names = expect(elements, int8, "field names");
    if (bytes == 0 || bytes > longest_field_name || names.data.size() % bytes != 0) {
      throw Fault("its field names make no sense");
    }
    std::string all;
    std::vector<std::string> own;
    for (std::size_t i = 0; i < names.data.size(); i += bytes) {
      const std::string_view field = names.data.substr(i, bytes);
      const std::size_t end = field.find('\0');
      if (end == std::string_view::npos) throw Fault("a field name has no end");
      own.push_back(fmt::format("{}.{}", path, field.substr(0, end)));
      all += field.substr(0, end);
      all.resize(own.size() * longest_field_name);
    }
    // The tag of four bytes in itself.
    const std::string tag = word(4U << 16U | int32) + word(longest_field_name);
    std::vector<std::string> of_all;
    for (std::size_t i = 0; i < count; ++i) of_all.insert(of_all.end(), own.begin(), own.end());
    return tag + element(int8, all) + members(elements, of_all, depth);
  }

  // Nothing if it is of a kind that is not read.
  std::optional<std::string> content(Elements& elements, std::uint32_t flags, std::size_t count,
                                     const std::string& path, int depth) {
    const std::uint32_t kind = flags & 0xFFU;
    const bool is_complex = (flags & 0x800U) != 0;
    if (kind == cell) {
      std::vector<std::string> names;
      for (std::size_t i = 0; i < count; ++i) names.push_back(fmt::format("{}{{{}}}", path, i + 1));
      return members(elements, names, depth);
    }
    if (kind == structure) return fields(elements, count, path, depth);
    if (kind == text) {
      auto written = text_values(elements, count);
      if (!written) leave_out(path, "text of another length than its size says");
      return written;
    }
    if (kind < first_number || kind > last_number) {
      leave_out(path, kind_of(kind));
      return std::nullopt;
    }
    std::string bytes = values(elements, count);
    return is_complex ? bytes + values(elements, count) : bytes;
  }

  void leave_out(const std::string& path, const std::string& kind) const {
    visitor_.leave_out(fmt::format("{} ({})", path, kind));
  }

  // An array with all it holds, as an element; empty if it is of a kind that is not read.
  std::string matrix_of(std::string_view bytes, const std::string& as, int depth) {
    if (depth > deepest) throw Fault("is nested too deep");
    Elements elements(bytes, swapped_);
    const Element flags = expect(elements, uint32, "array flags");
    if (flags.data.size() != 8) throw Fault("its array flags make no sense");
    const std::uint32_t class_and_flags = Elements::word(flags.data, swapped_);
    if ((class_and_flags & 0xFFU) == opaque) {  // it has names in place of a size
      const Element name = expect(elements, int8, "name");
      leave_out(as.empty() ? std::string(name.data) : as, kind_of(opaque));
      return "";
    }
    const Element dimensions = expect(elements, int32, "array size");
    const Element name = expect(elements, int8, "name");
    if (name.data.size() > 256) throw Fault("its name is too long");
    const std::string path = as.empty() ? std::string(name.data) : as;
    try {
      const auto written =
          content(elements, class_and_flags, count_of(dimensions.data, swapped_), path, depth);
      if (!written) return "";
      if (!elements.at_end()) throw Fault("has more bytes than its size says");
      return element(matrix, element(uint32, flags.data) + element(int32, dimensions.data) +
                                 element(int8, name.data) + *written);
    } catch (const Fault& fault) {
      if (depth > 0 || path.empty()) throw;
      throw Fault(fmt::format("{}: {}", path, fault.what()));
    }
  }

  bool swapped_;
  const Mat5Visitor& visitor_;
};

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

// The variable, written anew; empty if it is of a kind that is not read.
std::string variable_of(const Element& element, bool swapped, const Mat5Visitor& visitor) {
  Rewriting rewriting(swapped, visitor);
  if (element.type == matrix) return rewriting.variable(element.data);
  if (element.type != compressed) throw Fault("no variable where one should begin");
  const std::string bytes = inflated(element.data);
  Elements inner(bytes, swapped);
  std::string variable = rewriting.variable(expect(inner, matrix, "variable").data);
  if (!inner.at_end()) throw Fault("has more bytes than its size says");
  return variable;
}

}  // namespace

std::optional<std::string> visit_mat5(std::string_view file, const Mat5Visitor& visitor) {
  if (file.size() < header_bytes) return "shorter than the header of a MAT v5 file";
  const std::string_view order = file.substr(126, 2);
  if (order != "IM" && order != "MI") return "not a MAT v5 file";
  const bool swapped = order == "MI";  // written by a big-endian machine
  const std::string_view version_1 =
      swapped ? std::string_view("\x01\0", 2) : std::string_view("\0\x01", 2);
  if (file.substr(124, 2) != version_1) return "not a MAT v5 file (save it with -v7 or -v6)";
  const std::string header(file.substr(0, header_bytes));
  Elements variables(file.substr(header_bytes), swapped);
  while (!variables.at_end()) {
    const std::size_t at = variables.at() + header_bytes;
    try {
      const std::string variable = variable_of(variables.next(), swapped, visitor);
      if (variable.empty()) continue;
      if (auto fault = visitor.take(header + variable)) return fault;
    } catch (const Fault& fault) {
      return fmt::format("variable at byte {}: {}", at, fault.what());
    }
  }
  return std::nullopt;
}

}  // namespace rvbench::hal::formats
