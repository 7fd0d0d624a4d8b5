#include "hal/formats/tdms_chunks.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

namespace rvbench::hal::formats {
namespace {

using Fault = std::optional<std::string>;

constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();

// Equally spaced values in a chunk.
struct Row {
  std::string_view bytes;  // from the first value on
  std::size_t stride;
  std::uint64_t count;

  // As many as are there.
  std::uint64_t found(std::size_t value_bytes) const {
    if (bytes.size() < value_bytes) return 0;
    return std::min<std::uint64_t>(count, (bytes.size() - value_bytes) / stride + 1);
  }
};

template <typename Number>
void append_as(const Row& row, std::endian order, std::vector<double>& values) {
  const std::size_t before = values.size();
  const auto found = static_cast<std::size_t>(row.found(sizeof(Number)));
  values.resize(before + found);
  for (std::size_t i = 0; i < found; ++i) {
    const char* bytes = row.bytes.data() + i * row.stride;
    values[before + i] = static_cast<double>(number_at<Number>(bytes, order));
  }
}

void append_bits(const Row& row, unsigned bit, std::vector<double>& values) {
  const std::uint64_t found = row.found(1);
  for (std::uint64_t i = 0; i < found; ++i) {
    const auto byte = static_cast<unsigned char>(row.bytes[i * row.stride]);
    values.push_back((byte >> bit) & 1U);
  }
}

void append_times(const Row& row, std::endian order, TdmsChannel& channel) {
  channel.is_time = true;
  const std::size_t seconds_at = order == std::endian::little ? 8 : 0;
  const std::uint64_t found = row.found(16);
  for (std::uint64_t i = 0; i < found; ++i) {
    const char* bytes = row.bytes.data() + i * row.stride;
    const auto seconds = number_at<std::uint64_t>(bytes + seconds_at, order);
    const auto fraction = number_at<std::uint64_t>(bytes + 8 - seconds_at, order);
    if (!channel.start_s) channel.start_s = static_cast<std::int64_t>(seconds);
    const auto since =
        static_cast<std::int64_t>(seconds - static_cast<std::uint64_t>(*channel.start_s));
    channel.raw[tdms_raw_values].push_back(static_cast<double>(since) +
                                           static_cast<double>(fraction) * 0x1p-64);
  }
}

void append(const Row& row, TdmsType type, std::endian order, std::vector<double>& values) {
  switch (type) {
    case TdmsType::int8: return append_as<std::int8_t>(row, order, values);
    case TdmsType::int16: return append_as<std::int16_t>(row, order, values);
    case TdmsType::int32: return append_as<std::int32_t>(row, order, values);
    case TdmsType::int64: return append_as<std::int64_t>(row, order, values);
    case TdmsType::boolean:
    case TdmsType::uint8: return append_as<std::uint8_t>(row, order, values);
    case TdmsType::uint16: return append_as<std::uint16_t>(row, order, values);
    case TdmsType::uint32: return append_as<std::uint32_t>(row, order, values);
    case TdmsType::uint64: return append_as<std::uint64_t>(row, order, values);
    case TdmsType::float32_with_unit:
    case TdmsType::float32: return append_as<float>(row, order, values);
    case TdmsType::float64_with_unit:
    case TdmsType::float64: return append_as<double>(row, order, values);
    default: return;
  }
}

void append_plain(const Row& row, TdmsType type, std::endian order, TdmsChannel& channel) {
  if (type == TdmsType::timestamp) return append_times(row, order, channel);
  append(row, type, order, channel.raw[tdms_raw_values]);
}

std::uint64_t product(std::uint64_t count, std::uint64_t bytes) {
  return bytes > 0 && count > most / bytes ? most : count * bytes;
}

std::uint64_t sum(std::uint64_t a, std::uint64_t b) { return a > most - b ? most : a + b; }

std::uint64_t plain_bytes(const TdmsIndex& index) {
  return index.type == TdmsType::text ? index.text_bytes
                                      : product(index.count, bytes_of_type(index.type));
}

// Rows of each DAQmx buffer, which channels share. A device of a lower rate has a buffer with
// fewer.
std::vector<std::uint64_t> buffer_rows(const std::vector<TdmsPlace>& layout) {
  std::vector<std::uint64_t> rows(layout[0].index.row_bytes.size(), 0);
  for (const TdmsPlace& place : layout) {
    for (const TdmsScaler& scaler : place.index.scalers) {
      rows[scaler.buffer] = std::max(rows[scaler.buffer], place.index.count);
    }
  }
  return rows;
}

struct Chunk {
  std::uint64_t bytes = 0;
  bool is_daqmx = false;
};

std::variant<Chunk, std::string> chunk_of(const std::vector<TdmsPlace>& layout) {
  Chunk chunk;
  const auto is_daqmx = [](const TdmsPlace& p) { return p.index.type == TdmsType::daqmx_raw; };
  const auto daqmx = std::count_if(layout.begin(), layout.end(), is_daqmx);
  if (daqmx > 0) {
    if (static_cast<std::size_t>(daqmx) != layout.size()) return "DAQmx raw data beside others";
    chunk.is_daqmx = true;
    std::uint64_t row_bytes = 0;
    std::size_t scalers = 0;
    for (const std::uint32_t bytes : layout[0].index.row_bytes) row_bytes += bytes;
    for (const TdmsPlace& place : layout) {
      scalers += place.index.scalers.size();
      if (place.index.row_bytes != layout[0].index.row_bytes) {
        return "channels of one device that disagree about its buffers";
      }
    }
    // A bit each at the least: more would make a short file claim endless memory.
    if (scalers > 8 * row_bytes) return "more channels than its buffers have bits";
    const std::vector<std::uint64_t> rows = buffer_rows(layout);
    for (std::size_t b = 0; b < rows.size(); ++b) {
      chunk.bytes = sum(chunk.bytes, product(rows[b], layout[0].index.row_bytes[b]));
    }
    return chunk;
  }
  for (const TdmsPlace& place : layout) chunk.bytes = sum(chunk.bytes, plain_bytes(place.index));
  return chunk;
}

void take_contiguous(std::string_view chunk, std::endian order,
                     const std::vector<TdmsPlace>& layout, TdmsFile& file) {
  for (const TdmsPlace& place : layout) {
    const std::string_view own = chunk.substr(0, plain_bytes(place.index));
    chunk.remove_prefix(own.size());
    const Row row{own, std::max<std::size_t>(bytes_of_type(place.index.type), 1),
                  place.index.count};
    if (place.index.type != TdmsType::text) {
      append_plain(row, place.index.type, order, file.channels[place.channel]);
    }
  }
}

void take_interleaved(std::string_view chunk, std::endian order,
                      const std::vector<TdmsPlace>& layout, TdmsFile& file) {
  std::size_t stride = 0, offset = 0;
  for (const TdmsPlace& place : layout) stride += bytes_of_type(place.index.type);
  for (const TdmsPlace& place : layout) {
    const Row row{chunk.substr(std::min(offset, chunk.size())), stride, place.index.count};
    append_plain(row, place.index.type, order, file.channels[place.channel]);
    offset += bytes_of_type(place.index.type);
  }
}

void take_daqmx(std::string_view chunk, std::endian order, const std::vector<TdmsPlace>& layout,
                TdmsFile& file) {
  std::vector<std::string_view> buffers;
  const std::vector<std::uint32_t>& row_bytes = layout[0].index.row_bytes;
  const std::vector<std::uint64_t> rows = buffer_rows(layout);
  for (std::size_t b = 0; b < rows.size(); ++b) {
    buffers.push_back(chunk.substr(0, product(rows[b], row_bytes[b])));
    chunk.remove_prefix(buffers.back().size());
  }
  for (const TdmsPlace& place : layout) {
    for (const TdmsScaler& scaler : place.index.scalers) {
      const std::string_view buffer = buffers[scaler.buffer];
      const Row row{buffer.substr(std::min<std::size_t>(scaler.byte_offset, buffer.size())),
                    row_bytes[scaler.buffer], place.index.count};
      std::vector<double>& values = file.channels[place.channel].raw[scaler.scale_id];
      if (scaler.bit) {
        append_bits(row, *scaler.bit, values);
      } else {
        append(row, scaler.type, order, values);
      }
    }
  }
}

// Those of DAQmx have their bytes in buffers.
bool is_empty(const TdmsPlace& place, bool is_daqmx) {
  return is_daqmx ? place.index.count == 0 : plain_bytes(place.index) == 0;
}

// What each channel has of a last chunk of so many bytes. Nothing where that is no whole number of
// values.
std::optional<std::vector<TdmsPlace>> shares_of(std::vector<TdmsPlace> layout, std::uint64_t bytes,
                                                std::uint64_t chunk_bytes) {
  for (TdmsPlace& place : layout) {
    for (std::uint64_t* part : {&place.index.count, &place.index.text_bytes}) {
      const __uint128_t share = static_cast<__uint128_t>(*part) * bytes;
      if (share % chunk_bytes != 0) return std::nullopt;
      *part = static_cast<std::uint64_t>(share / chunk_bytes);
    }
  }
  return layout;
}

Fault find_fault(const TdmsStorage& storage, const std::vector<TdmsPlace>& layout) {
  if (!storage.is_interleaved) return std::nullopt;
  for (const TdmsPlace& place : layout) {
    if (place.index.type == TdmsType::text) return "texts between interleaved values";
    if (place.index.count != layout[0].index.count) return "interleaved channels of unequal length";
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> take_tdms_chunks(std::string_view bytes, const TdmsStorage& storage,
                                            const std::vector<TdmsPlace>& layout, TdmsFile& file) {
  const auto planned = chunk_of(layout);
  if (const auto* fault = std::get_if<std::string>(&planned)) return *fault;
  const Chunk& chunk = std::get<Chunk>(planned);
  if (bytes.empty() || chunk.bytes == 0) return std::nullopt;
  if (!chunk.is_daqmx) {
    if (auto fault = find_fault(storage, layout)) return fault;
  }
  const auto is_nothing = [&](const TdmsPlace& place) { return is_empty(place, chunk.is_daqmx); };
  if (std::ranges::any_of(layout, is_nothing)) {
    // Each chunk of a byte would ask all of them.
    std::vector<TdmsPlace> filled;
    std::ranges::remove_copy_if(layout, std::back_inserter(filled), is_nothing);
    return take_tdms_chunks(bytes, storage, filled, file);
  }
  std::optional<std::vector<TdmsPlace>> shares;  // of a last chunk that is shorter
  while (!bytes.empty()) {
    const std::string_view now = bytes.substr(0, chunk.bytes);
    bytes.remove_prefix(now.size());
    if (now.size() < chunk.bytes && !storage.is_cut_off) {
      shares = shares_of(layout, now.size(), chunk.bytes);
      file.is_cut_off = file.is_cut_off || !shares;
    }
    const std::vector<TdmsPlace>& now_in = shares ? *shares : layout;
    for (const TdmsPlace& place : now_in) {
      std::uint64_t& declared = file.channels[place.channel].declared;
      declared = sum(declared, place.index.count);
    }
    if (chunk.is_daqmx) {
      take_daqmx(now, storage.order, now_in, file);
    } else if (storage.is_interleaved) {
      take_interleaved(now, storage.order, now_in, file);
    } else {
      take_contiguous(now, storage.order, now_in, file);
    }
  }
  return std::nullopt;
}

}  // namespace rvbench::hal::formats
