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

// Checks a variable and, if asked, writes it anew as it is read.
class Rewriting {
 public:
  /// @param out  where it is written; null: it is checked only, and nothing is told
  Rewriting(bool swapped, const Mat5Visitor& visitor, std::string* out)
      : swapped_(swapped), visitor_(visitor), out_(out) {}

  // Whether it is of a kind that is read.
  bool variable(std::string_view bytes) { return write_matrix(bytes, "", 0); }

 private:
  void put(std::string_view bytes) {
    if (out_ != nullptr) out_->append(bytes);
  }

  std::string word(std::uint32_t value) const {
    std::string bytes(sizeof value, '\0');
    if (swapped_) value = __builtin_bswap32(value);
    std::memcpy(bytes.data(), &value, sizeof value);
    return bytes;
  }

  void put_element(std::uint32_t type, std::string_view data) {
    put(word(type) + word(static_cast<std::uint32_t>(data.size())));
    put(data);
    put(std::string((8 - data.size() % 8) % 8, '\0'));
  }

  // Where something begins that may have to be taken back.
  std::size_t mark() const { return out_ != nullptr ? out_->size() : 0; }
  void take_back(std::size_t mark) {
    if (out_ != nullptr) out_->resize(mark);
  }

  // The number of bytes behind a tag of eight bytes is known at their end.
  void end_element(std::size_t mark) {
    if (out_ == nullptr) return;
    const std::string size = word(static_cast<std::uint32_t>(out_->size() - mark - 8));
    out_->replace(mark + 4, size.size(), size);
  }

  // An array without values stands for a member that is not read.
  void put_nothing() {
    const std::size_t begin = mark();
    put(word(matrix) + word(0));
    put_element(uint32, word(first_number) + word(0));
    put_element(int32, word(0) + word(0));
    put_element(int8, "");
    put_element(float64, "");
    end_element(begin);
  }

  void write_values(Elements& elements, std::size_t count) {
    const Element values = elements.next();
    const std::size_t bytes = value_bytes(values.type);
    if (bytes == 0 || values.type > last_number_type) {
      throw Fault("its values are of no known type");
    }
    if (values.data.size() != count * bytes) {
      throw Fault(
          fmt::format("has {} values, its size says {}", values.data.size() / bytes, count));
    }
    put_element(values.type, values.data);
  }

  // In UTF-16, whose units the size counts. @return whether they are as many
  bool write_text(Elements& elements, std::size_t count) {
    const Element values = elements.next();
    const std::size_t bytes = value_bytes(values.type);
    if (bytes == 0) throw Fault("its text is of no known type");
    if (values.type != utf8) {
      if (values.data.size() != count * bytes) return false;
      put_element(bytes == 2 ? std::uint32_t{uint16} : values.type, values.data);
      return true;
    }
    const std::vector<std::uint16_t> units = utf16_of(values.data);
    if (units.size() != count) return false;
    std::string data;
    for (std::uint16_t unit : units) {
      if (swapped_) unit = __builtin_bswap16(unit);
      data.append(reinterpret_cast<const char*>(&unit), sizeof unit);
    }
    put_element(uint16, data);
    return true;
  }

  void write_member(Elements& elements, const std::string& path, int depth) {
    const std::string_view member = expect(elements, matrix, "member").data;
    if (member.empty()) {
      put_element(matrix, "");
    } else if (!write_matrix(member, path, depth + 1)) {
      put_nothing();
    }
  }

  // With room for names of full length: the reader takes no names that lie inside their tag.
  void write_fields(Elements& elements, std::size_t count, const std::string& path, int depth) {
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
      own.emplace_back(field.substr(0, end));
      all += own.back();
      all.resize(own.size() * longest_field_name);
    }
    put(word(4U << 16U | int32) + word(longest_field_name));  // four bytes inside their tag
    put_element(int8, all);
    if (own.empty()) return;  // however many it claims to have of nothing
    for (std::size_t i = 0; i < count; ++i) {
      for (const std::string& field : own) write_member(elements, path + "." + field, depth);
    }
  }

  // Whether it is of a kind that is read.
  bool write_content(Elements& elements, std::uint32_t flags, std::size_t count,
                     const std::string& path, int depth) {
    const std::uint32_t kind = flags & 0xFFU;
    if (kind == cell) {
      for (std::size_t i = 0; i < count; ++i) {
        write_member(elements, fmt::format("{}{{{}}}", path, i + 1), depth);
      }
      return true;
    }
    if (kind == structure) {
      write_fields(elements, count, path, depth);
      return true;
    }
    if (kind == text) {
      const bool fits = write_text(elements, count);
      if (!fits) leave_out(path, "text of another length than its size says");
      return fits;
    }
    if (kind < first_number || kind > last_number) {
      leave_out(path, kind_of(kind));
      return false;
    }
    const bool is_complex = (flags & 0x800U) != 0;
    write_values(elements, count);
    if (is_complex) write_values(elements, count);
    return true;
  }

  void leave_out(const std::string& path, const std::string& kind) const {
    if (out_ != nullptr) visitor_.leave_out(fmt::format("{} ({})", path, kind));
  }

  // An array with all it holds. @param as  its path, of a member  @return as variable()
  bool write_matrix(std::string_view bytes, const std::string& as, int depth) {
    if (depth > deepest) throw Fault("is nested too deep");
    const std::size_t begin = mark();
    Elements elements(bytes, swapped_);
    const Element flags = expect(elements, uint32, "array flags");
    if (flags.data.size() != 8) throw Fault("its array flags make no sense");
    const std::uint32_t class_and_flags = Elements::word(flags.data, swapped_);
    if ((class_and_flags & 0xFFU) == opaque) {  // it has names in place of a size
      const Element name = expect(elements, int8, "name");
      leave_out(as.empty() ? std::string(name.data) : as, kind_of(opaque));
      return false;
    }
    const Element dimensions = expect(elements, int32, "array size");
    const Element name = expect(elements, int8, "name");
    if (name.data.size() > 256) throw Fault("its name is too long");
    const std::string path = as.empty() ? std::string(name.data) : as;
    put(word(matrix) + word(0));
    put_element(uint32, flags.data);
    put_element(int32, dimensions.data);
    put_element(int8, name.data);
    try {
      const std::size_t count = count_of(dimensions.data, swapped_);
      if (!write_content(elements, class_and_flags, count, path, depth)) {
        take_back(begin);
        return false;
      }
      if (!elements.at_end()) throw Fault("has more bytes than its size says");
    } catch (const Fault& fault) {
      if (depth > 0 || path.empty()) throw;
      throw Fault(fmt::format("{}: {}", path, fault.what()));
    }
    end_element(begin);
    return true;
  }

  bool swapped_;
  const Mat5Visitor& visitor_;
  std::string* out_;
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

// Whether the variable is of a kind that is read. @param out  as of Rewriting
bool take_variable(const Element& element, bool swapped, const Mat5Visitor& visitor,
                   std::string* out) {
  Rewriting rewriting(swapped, visitor, out);
  if (element.type == matrix) return rewriting.variable(element.data);
  if (element.type != compressed) throw Fault("no variable where one should begin");
  const std::string bytes = inflated(element.data);
  Elements inner(bytes, swapped);
  const bool is_read = rewriting.variable(expect(inner, matrix, "variable").data);
  if (!inner.at_end()) throw Fault("has more bytes than its size says");
  return is_read;
}

// The first fault in the structure.
std::optional<std::string> find_fault(std::string_view file, bool swapped) {
  Elements variables(file.substr(header_bytes), swapped);
  const Mat5Visitor nobody;
  while (!variables.at_end()) {
    const std::size_t at = variables.at() + header_bytes;
    try {
      take_variable(variables.next(), swapped, nobody, nullptr);
    } catch (const Fault& fault) {
      return fmt::format("variable at byte {}: {}", at, fault.what());
    }
  }
  return std::nullopt;
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
  // Before anything is taken: of a damaged file nothing is.
  if (auto fault = find_fault(file, swapped)) return fault;
  Elements variables(file.substr(header_bytes), swapped);
  while (!variables.at_end()) {
    std::string of_one(file.substr(0, header_bytes));
    if (!take_variable(variables.next(), swapped, visitor, &of_one)) continue;
    if (auto fault = visitor.take(of_one)) return fault;
  }
  return std::nullopt;
}

}  // namespace rvbench::hal::formats
