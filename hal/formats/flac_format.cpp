#include <FLAC/stream_decoder.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>

#include "hal/formats/facts.hpp"
#include "hal/formats/foreign_file.hpp"
#include "hal/formats/format.hpp"

namespace rvbench::hal::formats {
namespace {

// A damaged file of some kilobytes may claim silence without end: an encoder's blocks of 4096
// samples of silence in eight channels are 800 values per byte. What is no silence takes a bit for
// each value at the least, so long records are bounded by their own size.
std::size_t most_values_in(std::size_t bytes) {
  constexpr std::size_t of_any = std::size_t{1} << 22U, per_byte = 1024;
  constexpr std::size_t most_of_silence = std::size_t{1} << 28U, bits_per_byte = 8;
  return std::max(std::min(most_of_silence, of_any + per_byte * bytes), bits_per_byte * bytes);
}

// Samples that are not there: libFLAC stands silence in for some of them.
struct LostBlock {
  std::size_t first = 0, samples = 0;
  bool is_filled = false;
};

// The file's comments, those of channel n (name_<n>) apart.
struct Comments {
  Facts of_all;
  std::map<std::size_t, Facts> of_channel;  // the first is 1

  void take(std::string_view comment) {
    const std::size_t stroke = comment.find('=');
    if (stroke == std::string_view::npos) return;
    std::string_view name = comment.substr(0, stroke);
    const std::string_view value = comment.substr(stroke + 1);
    std::size_t channel = 0;
    const std::size_t before = name.rfind('_');
    if (before != std::string_view::npos) {
      const char* end = name.data() + name.size();
      const auto read = std::from_chars(name.data() + before + 1, end, channel);
      const bool is_number = read.ec == std::errc() && read.ptr == end && channel > 0;
      if (!is_number) channel = 0;
      if (is_number) name = name.substr(0, before);
    }
    Facts& facts = channel > 0 ? of_channel[channel] : of_all;
    double number = 0;
    const auto read = std::from_chars(value.data(), value.data() + value.size(), number);
    facts.texts[std::string(name)] = value;
    if (read.ec == std::errc() && read.ptr == value.data() + value.size()) {
      facts.numbers[std::string(name)] = number;
    }
  }
};

struct Decoded {
  std::string bytes;  // of the file
  std::size_t at = 0;
  unsigned rate_Hz = 0;
  unsigned bits = 0;
  std::uint64_t declared = 0;  // samples per channel; 0 if not stated
  std::vector<std::vector<FLAC__int32>> channels;
  Comments comments;
  int damaged = 0;  // frames
  std::vector<LostBlock> lost;
  std::optional<std::uint64_t> begin;     // the first sample's number
  std::optional<std::uint64_t> last_end;  // of the last frame, in the file
  std::size_t last_block = 0;
  bool last_is_lost = false;
  std::uint64_t left_out = 0;  // samples that nothing stands in for
  std::string fault;

  FLAC__StreamDecoderWriteStatus stop(const std::string& why) {
    fault = why;
    return FLAC__STREAM_DECODER_WRITE_STATUS_ABORT;
  }

  FLAC__StreamDecoderWriteStatus take(const FLAC__StreamDecoder* decoder, const FLAC__Frame& frame,
                                      const FLAC__int32* const* samples) {
    if (channels.empty()) {
      channels.resize(frame.header.channels);
      rate_Hz = frame.header.sample_rate;
      bits = frame.header.bits_per_sample;
    }
    if (frame.header.channels != channels.size() || frame.header.bits_per_sample != bits ||
        frame.header.sample_rate != rate_Hz) {
      return stop("channels, bits or rate change on the way");
    }
    const std::size_t most_values = most_values_in(bytes.size());
    if ((channels[0].size() + frame.header.blocksize) * channels.size() > most_values) {
      return stop(fmt::format("more than {} samples", most_values));
    }
    note_lost(decoder, frame, samples);
    for (std::size_t i = 0; i < channels.size(); ++i) {
      channels[i].insert(channels[i].end(), samples[i], samples[i] + frame.header.blocksize);
    }
    return FLAC__STREAM_DECODER_WRITE_STATUS_CONTINUE;
  }

  // Frames count their samples. What libFLAC stands in for lost ones ends where the next frame
  // does, and that one's own samples may be silenced with it (1.4.2).
  void note_lost(const FLAC__StreamDecoder* decoder, const FLAC__Frame& frame,
                 const FLAC__int32* const* samples) {
    const std::size_t found = channels[0].size(), block = frame.header.blocksize;
    const bool is_by_sample = frame.header.number_type == FLAC__FRAME_NUMBER_TYPE_SAMPLE_NUMBER;
    if (!begin) begin = frame.header.number.sample_number;
    const std::uint64_t number = frame.header.number.sample_number;
    const std::uint64_t expected = *begin + found + left_out;
    if (is_by_sample && number > expected) {
      lost.push_back({found, static_cast<std::size_t>(number - expected), false});
      left_out += number - expected;
    }
    FLAC__uint64 end = 0;
    if (!FLAC__stream_decoder_get_decode_position(decoder, &end)) return;
    const bool goes_on = last_end == end;
    if (goes_on && !last_is_lost) lost.push_back({found - last_block, last_block, true});
    last_is_lost = goes_on && is_silent(samples, block);
    if (last_is_lost) lost.push_back({found, block, true});
    last_end = end;
    last_block = block;
  }

  bool is_silent(const FLAC__int32* const* samples, std::size_t block) const {
    for (std::size_t i = 0; i < channels.size(); ++i) {
      if (!std::all_of(samples[i], samples[i] + block, [](FLAC__int32 s) { return s == 0; })) {
        return false;
      }
    }
    return true;
  }

  void take(const FLAC__StreamMetadata& block) {
    if (block.type == FLAC__METADATA_TYPE_STREAMINFO)
      declared = block.data.stream_info.total_samples;
    if (block.type != FLAC__METADATA_TYPE_VORBIS_COMMENT) return;
    const auto& own = block.data.vorbis_comment;
    for (std::uint32_t i = 0; i < own.num_comments; ++i) {
      comments.take({reinterpret_cast<const char*>(own.comments[i].entry), own.comments[i].length});
    }
  }

  static Decoded& of(void* self) { return *static_cast<Decoded*>(self); }
  static FLAC__StreamDecoderReadStatus read(const FLAC__StreamDecoder*, FLAC__byte* buffer,
                                            std::size_t* size, void* self) {
    Decoded& file = of(self);
    *size = std::min(*size, file.bytes.size() - file.at);
    if (*size == 0) return FLAC__STREAM_DECODER_READ_STATUS_END_OF_STREAM;
    std::memcpy(buffer, file.bytes.data() + file.at, *size);
    file.at += *size;
    return FLAC__STREAM_DECODER_READ_STATUS_CONTINUE;
  }
  static FLAC__StreamDecoderTellStatus tell(const FLAC__StreamDecoder*, FLAC__uint64* at,
                                            void* self) {
    *at = of(self).at;
    return FLAC__STREAM_DECODER_TELL_STATUS_OK;
  }
  static FLAC__StreamDecoderWriteStatus write(const FLAC__StreamDecoder* decoder,
                                              const FLAC__Frame* frame,
                                              const FLAC__int32* const samples[], void* self) {
    return of(self).take(decoder, *frame, samples);
  }
  static void metadata(const FLAC__StreamDecoder*, const FLAC__StreamMetadata* block, void* self) {
    of(self).take(*block);
  }
  static void error(const FLAC__StreamDecoder*, FLAC__StreamDecoderErrorStatus, void* self) {
    ++of(self).damaged;
  }
};

struct DeleteDecoder {
  void operator()(FLAC__StreamDecoder* decoder) const { FLAC__stream_decoder_delete(decoder); }
};

// Whether the samples' checksum is right, or not stated.
bool decode(Decoded& file) {
  const std::unique_ptr<FLAC__StreamDecoder, DeleteDecoder> decoder(FLAC__stream_decoder_new());
  FLAC__stream_decoder_set_md5_checking(decoder.get(), true);
  FLAC__stream_decoder_set_metadata_respond(decoder.get(), FLAC__METADATA_TYPE_VORBIS_COMMENT);
  const auto begun = FLAC__stream_decoder_init_stream(
      decoder.get(), Decoded::read, nullptr, Decoded::tell, nullptr, nullptr, Decoded::write,
      Decoded::metadata, Decoded::error, &file);
  if (begun != FLAC__STREAM_DECODER_INIT_STATUS_OK) {
    file.fault = FLAC__StreamDecoderInitStatusString[begun];
    return false;
  }
  FLAC__stream_decoder_process_until_end_of_stream(decoder.get());
  return FLAC__stream_decoder_finish(decoder.get());
}

std::string status_of(const Decoded& file, bool checksum_is_right) {
  const std::size_t found = file.channels.front().size();
  if (file.declared > 0 && file.declared != found) {
    return fmt::format("INVALID: {} samples per channel declared, {} found", file.declared, found);
  }
  if (!file.lost.empty()) {
    std::size_t samples = 0;
    for (const LostBlock& block : file.lost) samples += block.samples;
    return fmt::format("INVALID: {} samples are missing behind sample {}", samples,
                       file.lost.front().first);
  }
  if (file.damaged > 0) return fmt::format("INVALID: {} frames are damaged", file.damaged);
  if (!checksum_is_right) return "INVALID: the samples' checksum is another";
  return "ok";
}

// What one step stands for, as a file of rvbench says.
std::optional<double> step_in(const Facts& facts) {
  const auto found = facts.numbers.find("step");
  const bool is_there = found != facts.numbers.end() && std::isnormal(found->second) &&
                        found->second > 0 && std::isfinite(found->second * 0x1p32);
  return is_there ? std::optional<double>(found->second) : std::nullopt;
}

Channel channel_of(const Decoded& file, std::size_t index, std::vector<std::string>& notes) {
  const auto stated = file.comments.of_channel.find(index + 1);
  const Facts facts = stated != file.comments.of_channel.end() ? stated->second : Facts{};
  const std::vector<FLAC__int32>& steps = file.channels[index];
  Channel channel;
  channel.info.name = fmt::format("channel_{}", index + 1);
  channel.rate_Hz = file.rate_Hz;
  channel.samples = Eigen::Map<const Eigen::Matrix<FLAC__int32, Eigen::Dynamic, 1>>(
                        steps.data(), static_cast<Eigen::Index>(steps.size()))
                        .cast<double>();
  for (const LostBlock& block : file.lost) {
    if (!block.is_filled) continue;
    channel.samples
        .segment(static_cast<Eigen::Index>(block.first), static_cast<Eigen::Index>(block.samples))
        .setConstant(not_known);
  }
  const auto text = [&facts](const char* name) {
    const auto found = facts.texts.find(name);
    return found != facts.texts.end() ? found->second : std::string();
  };
  apply(facts, channel);
  if (!text("name").empty()) channel.info.name = text("name");
  if (const std::optional<double> step = step_in(facts)) {
    channel.samples *= *step;
    channel.info.unit = text("unit");
  } else {
    channel.samples *= std::ldexp(1.0, 1 - static_cast<int>(file.bits));
    notes.push_back(channel.info.name + ": full scale is 1: the file states no unit");
  }
  return channel;
}

bool is_flac(std::string_view head) { return head.starts_with("fLaC"); }

Result<std::vector<Recording>> read_flac(const std::filesystem::path& file, const TableHints&) {
  Decoded decoded;
  decoded.bytes = bytes_of(file);
  if (!is_flac(decoded.bytes)) return bad_file(file, "does not begin as a FLAC file does");
  const bool checksum_is_right = decode(decoded);
  if (!decoded.fault.empty()) return bad_file(file, decoded.fault);
  if (decoded.channels.empty()) return bad_file(file, "holds no frame of samples");
  if (decoded.rate_Hz == 0) return bad_file(file, "a sample rate of 0");
  Recording recording;
  recording.source = file.string();
  recording.status = status_of(decoded, checksum_is_right);
  apply(decoded.comments.of_all, recording);
  for (std::size_t i = 0; i < decoded.channels.size(); ++i) {
    recording.channels.push_back(channel_of(decoded, i, recording.notes));
  }
  return alone(std::move(recording));
}

}  // namespace

Format flac_format() { return {"FLAC", is_flac, {".flac"}, read_flac}; }

}  // namespace rvbench::hal::formats
