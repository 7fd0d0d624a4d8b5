#include "hal/formats/tdms_metadata.hpp"

#include <fmt/format.h>

#include <utility>

namespace rvbench::hal::formats {
namespace {

using Fault = std::optional<std::string>;

constexpr std::uint32_t no_data = 0xFFFFFFFF;
constexpr std::uint32_t as_before = 0;
constexpr std::uint32_t daqmx_analogue = 0x1269;
constexpr std::uint32_t daqmx_digital = 0x126A;
constexpr std::uint32_t daqmx_digital_other = 0x1369;  // written by some versions

std::string_view take_text(ByteReader& reader) {
  const auto length = reader.number<std::uint32_t>();
  return reader.bytes(length);
}

// Seconds since 1904, and 2^-64 of one; the more significant comes first in big-endian files.
double take_timestamp(ByteReader& reader, std::endian order) {
  std::uint64_t parts[2] = {reader.number<std::uint64_t>(), reader.number<std::uint64_t>()};
  if (order == std::endian::big) std::swap(parts[0], parts[1]);
  return static_cast<double>(static_cast<std::int64_t>(parts[1])) +
         static_cast<double>(parts[0]) * 0x1p-64;
}

Fault take_property(ByteReader& reader, std::endian order, TdmsProperties& properties) {
  const std::string name(take_text(reader));
  const auto type = static_cast<TdmsType>(reader.number<std::uint32_t>());
  auto& value = properties[name];
  switch (type) {
    case TdmsType::int8: value = double(reader.number<std::int8_t>()); break;
    case TdmsType::int16: value = double(reader.number<std::int16_t>()); break;
    case TdmsType::int32: value = double(reader.number<std::int32_t>()); break;
    case TdmsType::int64: value = static_cast<double>(reader.number<std::int64_t>()); break;
    case TdmsType::boolean:
    case TdmsType::uint8: value = double(reader.number<std::uint8_t>()); break;
    case TdmsType::uint16: value = double(reader.number<std::uint16_t>()); break;
    case TdmsType::uint32: value = double(reader.number<std::uint32_t>()); break;
    case TdmsType::uint64: value = static_cast<double>(reader.number<std::uint64_t>()); break;
    case TdmsType::float32:
    case TdmsType::float32_with_unit: value = double(reader.number<float>()); break;
    case TdmsType::float64:
    case TdmsType::float64_with_unit: value = reader.number<double>(); break;
    case TdmsType::timestamp: value = take_timestamp(reader, order); break;
    case TdmsType::text: value = std::string(take_text(reader)); break;
    case TdmsType::nothing: break;
    default: return fmt::format("property \"{}\" of unknown type {:#x}", name, std::uint32_t(type));
  }
  return std::nullopt;
}

TdmsType type_of_scaler(std::uint32_t code) {
  switch (code) {
    case 0: return TdmsType::uint8;
    case 1: return TdmsType::int8;
    case 2: return TdmsType::uint16;
    case 3: return TdmsType::int16;
    case 4: return TdmsType::uint32;
    case 5: return TdmsType::int32;
    default: return TdmsType::nothing;
  }
}

TdmsScaler take_scaler(ByteReader& reader, bool is_digital) {
  TdmsScaler scaler;
  scaler.type = type_of_scaler(reader.number<std::uint32_t>());
  scaler.buffer = reader.number<std::uint32_t>();
  scaler.byte_offset = reader.number<std::uint32_t>();
  if (is_digital) {
    scaler.bit = scaler.byte_offset % 8;
    scaler.byte_offset /= 8;
    reader.number<std::uint8_t>();  // bitmap of the format
  } else {
    reader.number<std::uint32_t>();
  }
  scaler.scale_id = reader.number<std::uint32_t>();
  return scaler;
}

void take_daqmx(ByteReader& reader, bool is_digital, TdmsIndex& index) {
  const auto scalers = reader.number<std::uint32_t>();
  for (std::uint32_t i = 0; i < scalers && reader.ok(); ++i) {
    index.scalers.push_back(take_scaler(reader, is_digital));
  }
  const auto buffers = reader.number<std::uint32_t>();
  for (std::uint32_t i = 0; i < buffers && reader.ok(); ++i) {
    index.row_bytes.push_back(reader.number<std::uint32_t>());
  }
}

Fault find_fault(const TdmsObject& object) {
  const TdmsIndex& index = object.index;
  for (const TdmsScaler& scaler : index.scalers) {
    const std::size_t end = scaler.byte_offset + bytes_of_type(scaler.type);
    if (scaler.type == TdmsType::nothing) return "DAQmx values of an unknown type";
    if (scaler.buffer >= index.row_bytes.size() || end > index.row_bytes[scaler.buffer]) {
      return "DAQmx values outside of their buffer";
    }
  }
  const bool known = index.type == TdmsType::daqmx_raw || index.type == TdmsType::text ||
                     bytes_of_type(index.type) > 0;
  if (!known) return fmt::format("values of unknown type {:#x}", std::uint32_t(index.type));
  return std::nullopt;
}

Fault take_index(ByteReader& reader, TdmsObject& object) {
  const auto form = reader.number<std::uint32_t>();
  if (form == no_data || !reader.ok()) return std::nullopt;
  object.has_data = true;
  object.is_as_before = form == as_before;
  if (object.is_as_before) return std::nullopt;
  TdmsIndex& index = object.index;
  index.type = static_cast<TdmsType>(reader.number<std::uint32_t>());
  const auto dimensions = reader.number<std::uint32_t>();
  index.count = reader.number<std::uint64_t>();
  const bool is_digital = form == daqmx_digital || form == daqmx_digital_other;
  if (form == daqmx_analogue || is_digital) {
    take_daqmx(reader, is_digital, index);
    index.type = TdmsType::daqmx_raw;
  } else if (index.type == TdmsType::text) {
    index.text_bytes = reader.number<std::uint64_t>();
  }
  if (reader.ok() && dimensions != 1) return fmt::format("values of {} dimensions", dimensions);
  return reader.ok() ? find_fault(object) : std::nullopt;
}

}  // namespace

std::size_t bytes_of_type(TdmsType type) {
  switch (type) {
    case TdmsType::int8:
    case TdmsType::uint8:
    case TdmsType::boolean: return 1;
    case TdmsType::int16:
    case TdmsType::uint16: return 2;
    case TdmsType::int32:
    case TdmsType::uint32:
    case TdmsType::float32:
    case TdmsType::float32_with_unit: return 4;
    case TdmsType::int64:
    case TdmsType::uint64:
    case TdmsType::float64:
    case TdmsType::float64_with_unit: return 8;
    case TdmsType::timestamp: return 16;
    default: return 0;
  }
}

std::variant<std::vector<TdmsObject>, std::string> read_tdms_metadata(ByteReader& reader,
                                                                      std::endian order) {
  std::vector<TdmsObject> objects;
  const auto count = reader.number<std::uint32_t>();
  for (std::uint32_t i = 0; i < count && reader.ok(); ++i) {
    TdmsObject object;
    object.path = take_text(reader);
    Fault fault = take_index(reader, object);
    const auto properties = reader.number<std::uint32_t>();
    for (std::uint32_t p = 0; p < properties && reader.ok() && !fault; ++p) {
      fault = take_property(reader, order, object.properties);
    }
    if (fault) return object.path + ": " + *fault;
    objects.push_back(std::move(object));
  }
  if (!reader.ok()) return "its metadata is longer than the segment says";
  return objects;
}

}  // namespace rvbench::hal::formats
