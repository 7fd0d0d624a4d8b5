#include "hal/formats/mat5_rewriting.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <vector>

#include "hal/formats/mat5_elements.hpp"
#include "hal/formats/utf16.hpp"

namespace rvbench::hal::formats::mat5 {
namespace {

constexpr int deepest = 16;
constexpr std::size_t longest_field_name = 64;

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
  Rewriting(bool swapped, const std::function<void(std::string)>& leave_out, std::string* out)
      : swapped_(swapped), tell_(leave_out), out_(out) {}

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
    const std::string_view member = elements.expect(matrix, "member").data;
    if (member.empty()) {
      put_element(matrix, "");
    } else if (!write_matrix(member, path, depth + 1)) {
      put_nothing();
    }
  }

  // With room for names of full length: the reader takes no names that lie inside their tag.
  void write_fields(Elements& elements, std::size_t count, const std::string& path, int depth) {
    const Element length = elements.expect(int32, "length of field names");
    if (length.data.size() != 4) throw Fault("its field names have no length");
    const std::uint32_t bytes = Elements::word(length.data, swapped_);
    const Element names = elements.expect(int8, "field names");
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
    if (out_ != nullptr) tell_(fmt::format("{} ({})", path, kind));
  }

  // An array with all it holds. @param as  its path, of a member  @return as variable()
  bool write_matrix(std::string_view bytes, const std::string& as, int depth) {
    if (depth > deepest) throw Fault("is nested too deep");
    const std::size_t begin = mark();
    Elements elements(bytes, swapped_);
    const Element flags = elements.expect(uint32, "array flags");
    if (flags.data.size() != 8) throw Fault("its array flags make no sense");
    const std::uint32_t class_and_flags = Elements::word(flags.data, swapped_);
    if ((class_and_flags & 0xFFU) == opaque) {  // it has names in place of a size
      const Element name = elements.expect(int8, "name");
      leave_out(as.empty() ? std::string(name.data) : as, kind_of(opaque));
      return false;
    }
    const Element dimensions = elements.expect(int32, "array size");
    const Element name = elements.expect(int8, "name");
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
  const std::function<void(std::string)>& tell_;
  std::string* out_;
};

}  // namespace

bool write_variable(std::string_view bytes, bool swapped,
                    const std::function<void(std::string what)>& leave_out, std::string* out) {
  return Rewriting(swapped, leave_out, out).variable(bytes);
}

}  // namespace rvbench::hal::formats::mat5
