#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "hal/hdf5/hdf5_handle.hpp"

namespace rvbench::hal::hdf5 {

/// Rows x columns as HDF5 has them: row after row.
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Names of what is in the group at `path`, in no order that matters.
/// @throws FileFailure if it is no group, or more than 100000 are in it
std::vector<std::string> names_in(const Handle& file, const std::string& path);

/// Makes a dataset of rank 2 and writes all of it, as float or double. @throws FileFailure
Handle write_array(const Handle& group, const std::string& name, const RowMajor& values,
                   bool as_float);

/// All of a dataset of numbers, of rank 1 (one column) or 2. `file_bytes` bounds what the file may
/// claim. @throws FileFailure
RowMajor read_array(const Handle& dataset, std::size_t file_bytes, const std::string& place);

}  // namespace rvbench::hal::hdf5
