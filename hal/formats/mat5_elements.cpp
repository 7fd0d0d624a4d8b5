#include "hal/formats/mat5_elements.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>

namespace rvbench::hal::formats::mat5 {
namespace {

constexpr std::size_t most_inflated_bytes = std::size_t{1} << 30;

}  // namespace

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

Element Elements::next() {
  if (bytes_.size() - std::min(at_, bytes_.size()) < 8) throw Fault("the file is cut off");
  const std::uint32_t first = word(bytes_.substr(at_), swapped_);
  if (first >> 16U != 0) return small(first);
  const std::size_t size = word(bytes_.substr(at_ + 4), swapped_);
  const std::size_t left = bytes_.size() - at_ - 8;
  if (size > left) throw Fault(fmt::format("claims {} bytes, {} are left", size, left));
  const Element element{first, bytes_.substr(at_ + 8, size)};
  at_ += 8 + (first == compressed ? size : (size + 7) / 8 * 8);
  return element;
}

std::uint32_t Elements::word(std::string_view bytes, bool swapped) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data(), sizeof(value));
  return swapped ? __builtin_bswap32(value) : value;
}

// Up to four bytes inside the tag itself.
Element Elements::small(std::uint32_t first) {
  const std::size_t size = first >> 16U;
  if (size > 4) throw Fault("a tag makes no sense");
  const Element element{first & 0xFFFFU, bytes_.substr(at_ + 4, size)};
  at_ += 8;
  return element;
}

Element Elements::expect(std::uint32_t type, const char* what) {
  const Element element = next();
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

}  // namespace rvbench::hal::formats::mat5
