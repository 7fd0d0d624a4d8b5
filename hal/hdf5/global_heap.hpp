#pragma once

#include "hal/hdf5/hdf5_handle.hpp"

namespace rvbench::hal::hdf5 {

/// Looks through the heaps in which the file of this object (no attribute) keeps texts of variable
/// length. They have no checksum, and libhdf5 1.10 copies what a damaged size asks for, past the
/// end of its memory. rvbench's own files have none; those of h5py do.
///
/// Threads  each looks once at a file that it has opened
/// Limits   the references to a heap's objects lie in object headers; of those only the newer ones
///          have a checksum
/// @throws FileFailure with `place` if one is damaged, or the file cannot be read
void check_global_heaps(const Handle& object, const std::string& place);

}  // namespace rvbench::hal::hdf5
