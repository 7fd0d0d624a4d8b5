#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "hal/hdf5/hdf5_handle.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::hal::hdf5 {

/// What the attributes of /points/<nnn>/<group> say: the channels of one sample clock.
struct SampleGroup {
  std::vector<ChannelInfo> channels;
  double rate_Hz = 0;  ///< 0 if the file does not say
  double full_scale = not_known;
};

void write_sample_group(const Handle& group, const SampleGroup& samples);

/// @param columns  of the group's dataset; a channel without a name gets `<name>_<column>`
/// @throws FileFailure: a list of another length than `columns`, a rate that is not above 0
SampleGroup read_sample_group(const Handle& group, std::size_t columns, const std::string& name);

}  // namespace rvbench::hal::hdf5
