#pragma once

#include <cstddef>
#include <string>

#include "hal/hdf5/hdf5_handle.hpp"

namespace rvbench::hal::hdf5 {

struct Extent {
  std::size_t rows = 0;
  std::size_t columns = 0;  ///< 1 for a dataset of rank 1
};

/// The extent of a dataset, after checking that all it claims is really in the file: a header may
/// claim terabytes, and HDF5 reads zeros where a file was cut off.
///
/// @param place  the dataset's path, for messages
/// @throws FileFailure: rank not 1 or 2, data outside the file or beyond its end
Extent checked_extent(const Handle& dataset, std::size_t file_bytes, const std::string& place);

}  // namespace rvbench::hal::hdf5
