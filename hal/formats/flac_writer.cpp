#include <FLAC/metadata.h>
#include <FLAC/stream_encoder.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>

#include "hal/formats/facts.hpp"
#include "hal/formats/writer.hpp"

// Source  RFC 9639, Free Lossless Audio Codec; Xiph.Org, "Ogg Vorbis I format specification:
//         comment field and header specification"
namespace rvbench::hal::formats {
namespace {

constexpr unsigned bits = 24;
constexpr double most_steps = (1 << (bits - 1)) - 1;
constexpr unsigned compression = 5;  // that of the program flac
constexpr Eigen::Index samples_at_once = 4096;

struct DeleteWritten {
  void operator()(FLAC__StreamEncoder* encoder) const { FLAC__stream_encoder_delete(encoder); }
  void operator()(FLAC__StreamMetadata* block) const { FLAC__metadata_object_delete(block); }
};

// What one step stands for, in the channel's unit: by it no sample is clipped.
double step_of(const Channel& channel) {
  const double peak = channel.samples.cwiseAbs().maxCoeff();
  return peak > 0 && std::isnormal(peak / most_steps) ? peak / most_steps : 1;
}

class CommentsBlock {
 public:
  CommentsBlock() : block_(FLAC__metadata_object_new(FLAC__METADATA_TYPE_VORBIS_COMMENT)) {}

  void add(const std::string& name, const std::string& value) {
    if (value.empty()) return;
    FLAC__StreamMetadata_VorbisComment_Entry entry;
    if (FLAC__metadata_object_vorbiscomment_entry_from_name_value_pair(&entry, name.c_str(),
                                                                       value.c_str())) {
      FLAC__metadata_object_vorbiscomment_append_comment(block_.get(), entry, false);
    }
  }
  void add(const Facts& facts, const std::string& suffix) {
    for (const auto& [name, value] : facts.numbers) add(name + suffix, fmt::format("{}", value));
    for (const auto& [name, text] : facts.texts) add(name + suffix, text);
  }
  FLAC__StreamMetadata* block() const { return block_.get(); }

 private:
  std::unique_ptr<FLAC__StreamMetadata, DeleteWritten> block_;
};

CommentsBlock comments_of(const Recording& recording) {
  CommentsBlock comments;
  comments.add(facts_of(recording), "");
  for (std::size_t i = 0; i < recording.channels.size(); ++i) {
    const Channel& channel = recording.channels[i];
    const std::string suffix = fmt::format("_{}", i + 1);
    comments.add("name" + suffix, channel.info.name);
    comments.add("unit" + suffix, channel.info.unit);
    comments.add("step" + suffix, fmt::format("{}", step_of(channel)));
    comments.add(facts_of(channel), suffix);
  }
  return comments;
}

// A file in memory: the encoder goes back to its head when the number of samples is known.
struct Memory {
  std::string bytes;
  std::size_t at = 0;

  static FLAC__StreamEncoderWriteStatus write(const FLAC__StreamEncoder*, const FLAC__byte* data,
                                              std::size_t size, std::uint32_t, std::uint32_t,
                                              void* self) {
    auto& memory = *static_cast<Memory*>(self);
    memory.bytes.resize(std::max(memory.bytes.size(), memory.at + size));
    std::memcpy(memory.bytes.data() + memory.at, data, size);
    memory.at += size;
    return FLAC__STREAM_ENCODER_WRITE_STATUS_OK;
  }
  static FLAC__StreamEncoderSeekStatus seek(const FLAC__StreamEncoder*, FLAC__uint64 to,
                                            void* self) {
    static_cast<Memory*>(self)->at = static_cast<std::size_t>(to);
    return FLAC__STREAM_ENCODER_SEEK_STATUS_OK;
  }
  static FLAC__StreamEncoderTellStatus tell(const FLAC__StreamEncoder*, FLAC__uint64* at,
                                            void* self) {
    *at = static_cast<Memory*>(self)->at;
    return FLAC__STREAM_ENCODER_TELL_STATUS_OK;
  }
};

bool encode(FLAC__StreamEncoder* encoder, const std::vector<Channel>& channels) {
  const Eigen::Index samples = channels.front().samples.size();
  std::vector<double> steps;
  for (const Channel& channel : channels) steps.push_back(step_of(channel));
  std::vector<FLAC__int32> block;
  for (Eigen::Index from = 0; from < samples; from += samples_at_once) {
    const Eigen::Index to = std::min(samples, from + samples_at_once);
    block.clear();
    for (Eigen::Index i = from; i < to; ++i) {
      for (std::size_t c = 0; c < channels.size(); ++c) {
        block.push_back(static_cast<FLAC__int32>(std::lround(channels[c].samples[i] / steps[c])));
      }
    }
    if (!FLAC__stream_encoder_process_interleaved(encoder, block.data(),
                                                  static_cast<unsigned>(to - from))) {
      return false;
    }
  }
  return FLAC__stream_encoder_finish(encoder);
}

Status write_flac(const std::vector<Recording>& recordings, FileDraft& draft) {
  const Recording& recording = recordings.front();
  const Channel& first = recording.channels.front();
  const auto refused = [&draft](const std::string& why) {
    return IoError{IoErrc::refused, draft.file().string() + ": " + why};
  };
  if (first.rate_Hz > FLAC__MAX_SAMPLE_RATE) {
    return refused(fmt::format("{:g} Hz is more than the {} Hz that FLAC takes", first.rate_Hz,
                               FLAC__MAX_SAMPLE_RATE));
  }
  const CommentsBlock comments = comments_of(recording);
  FLAC__StreamMetadata* blocks[] = {comments.block()};
  const std::unique_ptr<FLAC__StreamEncoder, DeleteWritten> encoder(FLAC__stream_encoder_new());
  FLAC__stream_encoder_set_channels(encoder.get(),
                                    static_cast<unsigned>(recording.channels.size()));
  FLAC__stream_encoder_set_bits_per_sample(encoder.get(), bits);
  FLAC__stream_encoder_set_sample_rate(encoder.get(), static_cast<unsigned>(first.rate_Hz));
  FLAC__stream_encoder_set_compression_level(encoder.get(), compression);
  FLAC__stream_encoder_set_streamable_subset(encoder.get(), false);  // any rate
  FLAC__stream_encoder_set_total_samples_estimate(encoder.get(),
                                                  static_cast<FLAC__uint64>(first.samples.size()));
  FLAC__stream_encoder_set_metadata(encoder.get(), blocks, 1);
  Memory memory;
  const bool is_begun =
      FLAC__stream_encoder_init_stream(encoder.get(), Memory::write, Memory::seek, Memory::tell,
                                       nullptr, &memory) == FLAC__STREAM_ENCODER_INIT_STATUS_OK;
  if (!is_begun || !encode(encoder.get(), recording.channels)) {
    return refused(std::string("libFLAC: ") +
                   FLAC__stream_encoder_get_resolved_state_string(encoder.get()));
  }
  return draft.write(memory.bytes);
}

}  // namespace

// Whole steps of 24 bits: what one stands for is among the comments, step_1=1.2e-05 of the first
// channel.
Writer flac_writer() {
  return {"flac",
          "FLAC",
          {".flac"},
          {.channels = FLAC__MAX_CHANNELS,
           .lost_samples = false,
           .doubles = false,
           .floats = false,
           .any_rate = false},
          write_flac};
}

}  // namespace rvbench::hal::formats
