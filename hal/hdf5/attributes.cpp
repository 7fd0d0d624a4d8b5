#include "hal/hdf5/attributes.hpp"

#include <hdf5.h>

#include <algorithm>
#include <cstring>

#include "hal/hdf5/global_heap.hpp"

namespace rvbench::hal::hdf5 {
namespace {

constexpr hssize_t most_values = 65536;
constexpr std::size_t longest_text = 65536;

std::string place_of(const char* name) { return std::string("attribute ") + name; }

Handle text_type(std::size_t bytes, const std::string& place) {
  Handle type = own(H5Tcopy(H5T_C_S1), H5Tclose, place);
  check(H5Tset_size(type.id(), bytes), place);
  check(H5Tset_cset(type.id(), H5T_CSET_UTF8), place);
  check(H5Tset_strpad(type.id(), H5T_STR_NULLPAD), place);
  return type;
}

void write(const Handle& object, const char* name, Handle::Id type, const Handle& space,
           const void* values) {
  const std::string place = place_of(name);
  const Handle attribute = own(
      H5Acreate2(object.id(), name, type, space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, place);
  check(H5Awrite(attribute.id(), type, values), place);
}

Handle scalar() { return own(H5Screate(H5S_SCALAR), H5Sclose, "scalar"); }

Handle array_of(std::size_t count) {
  const hsize_t size = count;
  return own(H5Screate_simple(1, &size, nullptr), H5Sclose, "array");
}

struct Opened {
  Handle attribute;
  Handle type;
  std::size_t count = 0;  // 0 if there is no such attribute
};

Opened open(const Handle& object, const char* name) {
  Opened opened;
  const std::string place = place_of(name);
  const htri_t exists = H5Aexists(object.id(), name);
  check(exists, place);
  if (exists == 0) return opened;
  opened.attribute = own(H5Aopen(object.id(), name, H5P_DEFAULT), H5Aclose, place);
  opened.type = own(H5Aget_type(opened.attribute.id()), H5Tclose, place);
  const Handle space = own(H5Aget_space(opened.attribute.id()), H5Sclose, place);
  const hssize_t count = H5Sget_simple_extent_npoints(space.id());
  check(count, place);
  if (count > most_values) throw FileFailure(IoErrc::bad_data, place + ": too many values");
  opened.count = static_cast<std::size_t>(count);
  return opened;
}

std::vector<std::string> read_variable(const Opened& from, const std::string& place) {
  std::vector<char*> pointers(from.count, nullptr);
  check(H5Aread(from.attribute.id(), from.type.id(), pointers.data()), place);
  std::vector<std::string> texts;
  for (char* pointer : pointers) {
    texts.emplace_back(pointer == nullptr ? "" : pointer);
    H5free_memory(pointer);
  }
  return texts;
}

std::vector<std::string> read_fixed(const Opened& from, const std::string& place) {
  const std::size_t bytes = H5Tget_size(from.type.id());
  if (bytes == 0 || bytes > longest_text) {
    throw FileFailure(IoErrc::bad_data, place + ": text too long");
  }
  std::vector<char> buffer(from.count * bytes);
  check(H5Aread(from.attribute.id(), from.type.id(), buffer.data()), place);
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < from.count; ++i) {
    const char* begin = buffer.data() + i * bytes;
    texts.emplace_back(begin, std::find(begin, begin + bytes, '\0'));
  }
  return texts;
}

}  // namespace

void write_number(const Handle& object, const char* name, double value) {
  write(object, name, H5T_NATIVE_DOUBLE, scalar(), &value);
}

void write_integer(const Handle& object, const char* name, int value) {
  write(object, name, H5T_NATIVE_INT, scalar(), &value);
}

void write_numbers(const Handle& object, const char* name, const std::vector<double>& values) {
  write(object, name, H5T_NATIVE_DOUBLE, array_of(values.size()), values.data());
}

void write_text(const Handle& object, const char* name, const std::string& value) {
  const Handle type = text_type(std::max<std::size_t>(value.size(), 1), place_of(name));
  std::string padded = value;
  padded.resize(std::max<std::size_t>(value.size(), 1));
  write(object, name, type.id(), scalar(), padded.data());
}

void write_texts(const Handle& object, const char* name, const std::vector<std::string>& values) {
  std::size_t bytes = 1;
  for (const std::string& value : values) bytes = std::max(bytes, value.size());
  std::vector<char> padded(bytes * values.size(), '\0');
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::memcpy(padded.data() + i * bytes, values[i].data(), values[i].size());
  }
  write(object, name, text_type(bytes, place_of(name)).id(), array_of(values.size()),
        padded.data());
}

std::vector<double> read_numbers(const Handle& object, const char* name) {
  const Opened from = open(object, name);
  std::vector<double> values(from.count);
  if (values.empty()) return values;
  const H5T_class_t kind = H5Tget_class(from.type.id());
  if (kind != H5T_FLOAT && kind != H5T_INTEGER) {
    throw FileFailure(IoErrc::bad_data, place_of(name) + ": not a number");
  }
  check(H5Aread(from.attribute.id(), H5T_NATIVE_DOUBLE, values.data()), place_of(name));
  return values;
}

std::vector<std::string> read_texts(const Handle& object, const char* name) {
  const Opened from = open(object, name);
  if (from.count == 0) return {};
  const std::string place = place_of(name);
  if (H5Tget_class(from.type.id()) != H5T_STRING) {
    throw FileFailure(IoErrc::bad_data, place + ": not text");
  }
  const htri_t variable = H5Tis_variable_str(from.type.id());
  check(variable, place);
  if (variable == 0) return read_fixed(from, place);
  check_global_heaps(object, place);
  return read_variable(from, place);
}

std::optional<double> read_number(const Handle& object, const char* name) {
  const std::vector<double> values = read_numbers(object, name);
  return values.empty() ? std::nullopt : std::optional(values.front());
}

std::optional<std::string> read_text(const Handle& object, const char* name) {
  std::vector<std::string> values = read_texts(object, name);
  return values.empty() ? std::nullopt : std::optional(std::move(values.front()));
}

}  // namespace rvbench::hal::hdf5
