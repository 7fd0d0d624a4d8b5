#pragma once

#include <sys/types.h>

#include <string>

#include "hal/types/result.hpp"

struct iio_channel;

namespace rvbench::hal {

/// An input of a front end of Linux industrial I/O as it streams: raw counts and what they mean.
struct IioInput {
  iio_channel* channel = nullptr;
  double m_s2_per_count = 1;
  double offset_counts = 0;

  /// @param sample  in the device's own format, of up to 64 bits
  double m_s2_of(const void* sample) const;

  /// How far the converter goes in both directions, which is less where its offset is not half of
  /// its span; in the one direction of a converter that has no other.
  double full_scale_m_s2() const;
};

/// What a channel's counts mean, by its `scale` and its `offset`; one that it does not have is 1,
/// or 0.
///
/// Errors  name channel and attribute. refused: it has the attribute and does not tell it, or the
///         sensitivity does not fit the channel; bad_reply: it tells no number
/// @param sensitivity  of the sensor, V per m/s²; NaN for a channel that tells m/s² by itself
Result<IioInput> read_iio_input(iio_channel* channel, double sensitivity);

/// What libiio's negative error codes mean.
std::string iio_reason(ssize_t error);

}  // namespace rvbench::hal
