#include <cmath>
#include <cstdint>
#include <limits>

#include "hal/formats/byte_writer.hpp"
#include "hal/formats/writer.hpp"

// Source  IBM and Microsoft, Multimedia Programming Interface and Data Specifications 1.0 (1991);
//         Microsoft, New Multimedia Data Types and Data Techniques (1994): a chunk "fact" beside
//         what is not PCM
namespace rvbench::hal::formats {
namespace {

constexpr std::uint16_t float_samples = 3;
constexpr std::size_t header_bytes = 4 + 8 + 18 + 8 + 4 + 8;  // behind the file's length

template <typename Number>
std::string packed(Number number) {
  std::string bytes;
  put(bytes, number);
  return bytes;
}

std::string header_of(std::uint32_t rate_Hz, std::uint16_t channels, std::uint32_t samples,
                      std::uint32_t data_bytes) {
  const auto frame_bytes = static_cast<std::uint16_t>(channels * sizeof(float));
  std::string bytes = "RIFF" + packed(static_cast<std::uint32_t>(header_bytes + data_bytes));
  bytes += "WAVEfmt " + packed(std::uint32_t{18}) + packed(float_samples) + packed(channels);
  bytes += packed(rate_Hz) + packed(rate_Hz * frame_bytes) + packed(frame_bytes);
  bytes += packed(std::uint16_t{8 * sizeof(float)}) + packed(std::uint16_t{0});
  bytes += "fact" + packed(std::uint32_t{4}) + packed(samples);
  return bytes + "data" + packed(data_bytes);
}

Status write_wav(const std::vector<Recording>& recordings, FileDraft& draft) {
  constexpr double most = std::numeric_limits<std::uint32_t>::max();
  const std::vector<Channel>& channels = recordings.front().channels;
  const Eigen::Index samples = channels.front().samples.size();
  const double rate_Hz = channels.front().rate_Hz;
  const double bytes = static_cast<double>(samples) * double(channels.size()) * sizeof(float);
  if (rate_Hz > most || bytes + header_bytes > most) {
    return IoError{IoErrc::refused, draft.file().string() +
                                        ": more than the 4 GB that a WAV file can have: write HDF5 "
                                        "or TDMS instead"};
  }
  std::string data =
      header_of(static_cast<std::uint32_t>(rate_Hz), static_cast<std::uint16_t>(channels.size()),
                static_cast<std::uint32_t>(samples), static_cast<std::uint32_t>(bytes));
  for (Eigen::Index i = 0; i < samples; ++i) {
    for (const Channel& channel : channels) put(data, static_cast<float>(channel.samples[i]));
  }
  return draft.write(data);
}

}  // namespace

// Samples are in the channels' units: floating point has no full scale.
Writer wav_writer() {
  return {"wav",
          "WAV",
          {".wav"},
          {.channels = 256,
           .names = false,
           .units = false,
           .directions = false,
           .sensitivities = false,
           .channel_start = false,
           .start_time = false,
           .facts = false,
           .doubles = false,
           .any_rate = false},
          write_wav};
}

}  // namespace rvbench::hal::formats
