#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "hal/formats/byte_reader.hpp"
#include "hal/formats/foreign_file.hpp"
#include "hal/formats/format.hpp"

// Source  IBM and Microsoft, Multimedia Programming Interface and Data Specifications 1.0 (1991);
//         Microsoft, WAVEFORMATEXTENSIBLE; EBU Tech 3306 (RF64)
namespace rvbench::hal::formats {
namespace {

constexpr std::uint16_t pcm = 1, ieee_float = 3, extensible = 0xFFFE;
constexpr std::uint32_t not_stated = 0xFFFFFFFF;  // a writer that could not go back, or RF64
constexpr std::uint16_t most_channels = 256;

struct Layout {
  std::uint16_t encoding = 0;
  std::uint16_t channels = 0;
  std::uint32_t rate_Hz = 0;
  std::uint16_t bits = 0;

  std::size_t frame_bytes() const { return std::size_t{channels} * bits / 8; }
};

struct Chunks {
  std::optional<Layout> layout;
  std::vector<std::string_view> data;  // as much as there is; mostly one
  std::uint64_t declared = 0;          // bytes of data
  std::uint64_t declared_by_ds64 = 0;

  std::size_t frames() const {
    std::size_t count = 0;
    for (const std::string_view part : data) count += part.size() / layout->frame_bytes();
    return count;
  }
};

bool is_wav(std::string_view head) {
  const bool is_riff = head.starts_with("RIFF") || head.starts_with("RF64");
  return is_riff && head.size() >= 12 && head.substr(8, 4) == "WAVE";
}

Layout layout_of(std::string_view bytes) {
  ByteReader reader(bytes, std::endian::little);
  Layout layout;
  layout.encoding = reader.number<std::uint16_t>();
  layout.channels = reader.number<std::uint16_t>();
  layout.rate_Hz = reader.number<std::uint32_t>();
  reader.bytes(6);  // bytes per second and per frame follow from the others
  layout.bits = reader.number<std::uint16_t>();
  if (layout.encoding == extensible) {
    reader.bytes(8);  // size of what follows, valid bits, loudspeakers
    layout.encoding = reader.number<std::uint16_t>();
  }
  return reader.ok() ? layout : Layout{};
}

Chunks chunks_of(std::string_view bytes) {
  ByteReader reader(bytes.substr(12), std::endian::little);
  Chunks chunks;
  while (reader.left().size() >= 8) {
    const std::string_view name = reader.bytes(4);
    const auto size = reader.number<std::uint32_t>();
    const std::string_view body = reader.left().substr(0, size);
    if (name == "fmt ") chunks.layout = layout_of(body);
    if (name == "ds64" && body.size() >= 16) {
      chunks.declared_by_ds64 = number_at<std::uint64_t>(body.data() + 8, std::endian::little);
    }
    if (name == "data") {
      const bool elsewhere = size == not_stated && chunks.declared_by_ds64 > 0;
      const std::uint64_t declared = elsewhere ? chunks.declared_by_ds64 : size;
      const bool by_end = !elsewhere && (size == not_stated || (size == 0 && chunks.data.empty()));
      chunks.declared = by_end ? size : chunks.declared + declared;
      chunks.data.push_back(by_end ? reader.left() : reader.left().substr(0, declared));
      if (by_end) break;
      reader.bytes(std::min<std::uint64_t>(declared + declared % 2, reader.left().size()));
      continue;
    }
    reader.bytes(std::min<std::uint64_t>(size + std::uint64_t{size % 2}, reader.left().size()));
  }
  return chunks;
}

std::optional<std::string> find_fault(const Chunks& chunks) {
  if (!chunks.layout) return "no chunk \"fmt \" before the samples";
  if (chunks.data.empty()) return "no chunk \"data\"";
  const Layout& layout = *chunks.layout;
  const auto is_one_of = [&](auto... bits) { return ((layout.bits == bits) || ...); };
  const bool known = (layout.encoding == pcm && is_one_of(8, 16, 24, 32)) ||
                     (layout.encoding == ieee_float && is_one_of(32, 64));
  if (!known) {
    return fmt::format("encoding {} of {} bits, not PCM (1) of 8 to 32 or float (3) of 32 or 64",
                       layout.encoding, layout.bits);
  }
  if (layout.channels == 0 || layout.channels > most_channels) {
    return fmt::format("{} channels", layout.channels);
  }
  if (layout.rate_Hz == 0) return "a sample rate of 0";
  return std::nullopt;
}

double sample_at(const char* bytes, const Layout& layout) {
  constexpr auto order = std::endian::little;
  if (layout.encoding == ieee_float) {
    return layout.bits == 64 ? number_at<double>(bytes, order)
                             : static_cast<double>(number_at<float>(bytes, order));
  }
  switch (layout.bits) {
    case 8: return (number_at<std::uint8_t>(bytes, order) - 128) / 128.0;
    case 16: return number_at<std::int16_t>(bytes, order) / 32768.0;
    case 24: {
      const std::string shifted = std::string(1, '\0') + std::string(bytes, 3);
      return number_at<std::int32_t>(shifted.data(), order) / 2147483648.0;
    }
    default: return number_at<std::int32_t>(bytes, order) / 2147483648.0;
  }
}

Channel channel_of(const Chunks& chunks, std::size_t index) {
  const Layout& layout = *chunks.layout;
  Channel channel;
  channel.info.name = fmt::format("channel_{}", index + 1);
  channel.rate_Hz = layout.rate_Hz;
  channel.samples.resize(static_cast<Eigen::Index>(chunks.frames()));
  Eigen::Index at = 0;
  for (const std::string_view part : chunks.data) {
    const char* first = part.data() + index * layout.bits / 8;
    const std::size_t frames = part.size() / layout.frame_bytes();
    for (std::size_t i = 0; i < frames; ++i) {
      channel.samples[at++] = sample_at(first + i * layout.frame_bytes(), layout);
    }
  }
  return channel;
}

void describe(const Chunks& chunks, Recording& recording) {
  recording.notes.push_back("full scale is 1: a WAV file states no unit");
  recording.status = "ok";
  const std::size_t frame = chunks.layout->frame_bytes();
  const std::size_t found = chunks.frames();
  if (chunks.data.size() > 1) {
    recording.notes.push_back(
        fmt::format("{} chunks of samples, read one behind the other", chunks.data.size()));
  }
  if (chunks.declared == not_stated) {
    recording.notes.push_back("its length is not stated: read to the file's end");
  } else if (chunks.declared / frame != found) {
    recording.status = fmt::format("INVALID: {} samples per channel declared, {} found",
                                   chunks.declared / frame, found);
  }
}

Result<std::vector<Recording>> read_wav(const std::filesystem::path& file, const TableHints&) {
  const std::string bytes = bytes_of(file);
  if (!is_wav(bytes)) return bad_file(file, "does not begin as a WAV file does");
  const Chunks chunks = chunks_of(bytes);
  if (const auto fault = find_fault(chunks)) return bad_file(file, *fault);
  Recording recording;
  recording.source = file.string();
  for (std::size_t i = 0; i < chunks.layout->channels; ++i) {
    recording.channels.push_back(channel_of(chunks, i));
  }
  describe(chunks, recording);
  return alone(std::move(recording));
}

}  // namespace

Format wav_format() { return {"WAV", is_wav, {".wav"}, read_wav}; }

}  // namespace rvbench::hal::formats
