#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "hal/hdf5/hdf5_handle.hpp"

namespace rvbench::hal::hdf5 {

/// One extendible dataset `data` (rows x columns) of float or double, written at its end.
///
/// Rows are gathered until a chunk is full or flush() comes: calls into HDF5 cost far more than
/// the bytes. Rows that a dying writer announced but did not write read as NaN, not as 0.
/// All throw FileFailure.
template <typename Number>
class GrowingSeries {
 public:
  /// Makes the dataset in `group`; before SWMR writing starts.
  static void create(const Handle& group, std::size_t columns);

  /// Opens `path` ("/points/003/torque/data") of the file for appending.
  GrowingSeries(const Handle& file, std::string path, std::size_t columns);

  void append(const Number* rows, std::size_t count);  ///< row after row
  void flush();  ///< hands all rows to the operating system; no-op if it has them
  void close();  ///< after flush()

 private:
  void write_gathered();

  std::string path_;
  std::size_t columns_;
  Handle dataset_;
  std::size_t rows_ = 0;  ///< in the dataset
  std::vector<Number> gathered_;
  bool dirty_ = false;
};

extern template class GrowingSeries<float>;
extern template class GrowingSeries<double>;

}  // namespace rvbench::hal::hdf5
