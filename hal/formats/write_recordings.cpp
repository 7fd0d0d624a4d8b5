#include "hal/formats/write_recordings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "hal/formats/distinct_names.hpp"
#include "hal/formats/losses.hpp"
#include "hal/formats/printable.hpp"
#include "hal/types/require.hpp"

namespace rvbench::hal {
namespace {

using formats::Holds;
using formats::Writer;

struct Part {
  std::filesystem::path file;
  std::vector<Recording> recordings;
  std::vector<std::string> warnings;
};

// Recordings that each have one clock, and no more channels than may be.
std::vector<Recording> by_clock(const Recording& whole, std::size_t most_channels) {
  Recording head = whole;
  head.channels.clear();
  std::vector<Recording> parts;
  for (const Channel& channel : whole.channels) {
    auto own = std::ranges::find_if(parts, [&](const Recording& part) {
      return formats::is_one_clock(part.channels.front(), channel) &&
             part.channels.size() < most_channels;
    });
    if (own == parts.end()) own = parts.insert(parts.end(), head);
    own->channels.push_back(channel);
  }
  return parts;
}

std::filesystem::path named_after(const std::filesystem::path& file, const std::string& suffix) {
  std::filesystem::path named = file;
  named.replace_filename(file.stem().string() + suffix + file.extension().string());
  return named;
}

// The number of a point in its file: that of "recording.h5#012", else its place.
std::string point_of(const Recording& recording, std::size_t place) {
  const std::size_t stroke = recording.source.rfind('#');
  const std::string own = stroke == std::string::npos ? "" : recording.source.substr(stroke + 1);
  const bool is_number = !own.empty() && own.find_first_not_of("0123456789") == std::string::npos;
  return is_number ? own : fmt::format("{:03}", place);
}

// What tells the points apart in their files' names: their numbers, else, where two would be one,
// their places.
std::vector<std::string> points_of(const std::vector<Recording>& recordings) {
  std::vector<std::string> points, places;
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    points.push_back(point_of(recordings[i], i));
    places.push_back(fmt::format("{:03}", i));
  }
  const std::set<std::string> distinct(points.begin(), points.end());
  return distinct.size() == points.size() ? points : places;
}

std::vector<Part> parts_of(const std::vector<Recording>& recordings,
                           const std::filesystem::path& file, const Holds& holds) {
  if (holds.recordings && holds.clocks) return {{file, recordings, {}}};
  const std::vector<std::string> points = points_of(recordings);
  std::vector<Part> parts;
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    const std::string point = recordings.size() > 1 ? "_" + points[i] : "";
    const std::vector<Recording> split =
        holds.clocks ? std::vector{recordings[i]} : by_clock(recordings[i], holds.channels);
    for (std::size_t k = 0; k < split.size(); ++k) {
      const std::string suffix = point + (split.size() > 1 ? fmt::format("_{}", k + 1) : "");
      parts.push_back({suffix.empty() ? file : named_after(file, suffix), {split[k]}, {}});
    }
  }
  return parts;
}

void require_samples(const std::vector<Recording>& recordings) {
  constexpr Require require{"write_recordings"};
  require(!recordings.empty(), "no recording");
  for (const Recording& recording : recordings) {
    require(!recording.channels.empty(), "a recording without channels");
    for (const Channel& channel : recording.channels) {
      require(channel.samples.size() > 0, "a channel without samples");
    }
  }
}

// In formats that are text a line break in a name would end a line.
void tidy_names(Part& part) {
  for (Recording& recording : part.recordings) {
    if (formats::make_printable(recording)) part.warnings.emplace_back(formats::was_not_printable);
    const std::vector<std::string> told = formats::make_names_distinct(recording);
    part.warnings.insert(part.warnings.end(), told.begin(), told.end());
  }
}

// A rate of whole Hz that an interval was rounded from.
void snap_rates(Part& part) {
  constexpr double rounding = 1e-6;  // of an interval of six digits and more
  for (Recording& recording : part.recordings) {
    for (Channel& channel : recording.channels) {
      const double stated_Hz = channel.rate_Hz, whole_Hz = std::round(stated_Hz);
      const double off = std::abs(stated_Hz / whole_Hz - 1);
      if (!(off > 0 && off <= rounding)) continue;
      channel.rate_Hz = whole_Hz;
      const std::string told =
          fmt::format("a rate of {:.10g} Hz is written as {:.10g} Hz, which it is but for rounding",
                      stated_Hz, whole_Hz);
      const bool is_told = std::ranges::find(part.warnings, told) != part.warnings.end();
      if (!is_told && off > 1e-12) part.warnings.push_back(told);
    }
  }
}

Status write_part(const Part& part, const Writer& writer, bool overwrite) {
  formats::FileDraft draft(part.file, overwrite);
  if (Status begun = draft.begin(); !begun) return begun;
  if (Status written = writer.write(part.recordings, draft); !written) return written;
  return draft.finish();
}

}  // namespace

Result<std::vector<WrittenFile>> write_recordings(const std::vector<Recording>& recordings,
                                                  const std::filesystem::path& file,
                                                  const Writer& writer, bool overwrite) {
  require_samples(recordings);
  std::vector<Part> parts = parts_of(recordings, file, writer.holds);
  for (Part& part : parts) {
    if (Status place = formats::check_place(part.file, overwrite); !place) return place.error();
    if (writer.holds.names) tidy_names(part);
    if (!writer.holds.any_rate) snap_rates(part);
  }
  for (const Part& part : parts) {
    for (const Recording& recording : part.recordings) {
      if (const auto fault = formats::unwritable(recording, writer)) {
        return IoError{IoErrc::bad_data, recording.source + ": " + *fault};
      }
    }
  }
  std::vector<WrittenFile> written;
  for (const Part& part : parts) {
    if (Status done = write_part(part, writer, overwrite); !done) return done.error();
    std::size_t channels = 0;
    for (const Recording& recording : part.recordings) channels += recording.channels.size();
    written.push_back({part.file, channels, formats::losses(part.recordings, writer)});
    std::vector<std::string>& warnings = written.back().warnings;
    warnings.insert(warnings.end(), part.warnings.begin(), part.warnings.end());
  }
  return written;
}

}  // namespace rvbench::hal
