#include "hal/hdf5/growing_series.hpp"

#include <hdf5.h>

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

namespace rvbench::hal::hdf5 {
namespace {

constexpr std::size_t chunk_rows = 4096;

template <typename Number>
hid_t memory_type() {
  return std::is_same_v<Number, float> ? H5T_NATIVE_FLOAT : H5T_NATIVE_DOUBLE;
}

template <typename Number>
hid_t file_type() {
  return std::is_same_v<Number, float> ? H5T_IEEE_F32LE : H5T_IEEE_F64LE;
}

}  // namespace

template <typename Number>
void GrowingSeries<Number>::create(const Handle& group, std::size_t columns) {
  const std::string place = "make data";
  const hsize_t none[2] = {0, columns};
  const hsize_t most[2] = {H5S_UNLIMITED, columns};
  const hsize_t chunk[2] = {chunk_rows, columns};
  const Number nan = std::numeric_limits<Number>::quiet_NaN();
  const Handle space = own(H5Screate_simple(2, none, most), H5Sclose, place);
  const Handle properties = own(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, place);
  check(H5Pset_chunk(properties.id(), 2, chunk), place);
  check(H5Pset_fill_value(properties.id(), memory_type<Number>(), &nan), place);
  own(H5Dcreate2(group.id(), "data", file_type<Number>(), space.id(), H5P_DEFAULT, properties.id(),
                 H5P_DEFAULT),
      H5Dclose, place);
}

template <typename Number>
GrowingSeries<Number>::GrowingSeries(const Handle& file, std::string path, std::size_t columns)
    : path_(std::move(path)), columns_(columns) {
  // Two chunks are all that appending needs; HDF5's default would keep a megabyte per dataset.
  const Handle access = own(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose, path_);
  const std::size_t cache_bytes = 2 * chunk_rows * columns * sizeof(Number);
  check(H5Pset_chunk_cache(access.id(), 11, cache_bytes, 1.0), path_);
  dataset_ = own(H5Dopen2(file.id(), path_.c_str(), access.id()), H5Dclose, path_);
  gathered_.reserve(chunk_rows * columns);
}

template <typename Number>
void GrowingSeries<Number>::append(const Number* rows, std::size_t count) {
  while (count > 0) {
    // Fills up to the dataset's next chunk border, so that each chunk is written in one go.
    const std::size_t room = chunk_rows - (rows_ + gathered_.size() / columns_) % chunk_rows;
    const std::size_t now = std::min(room, count);
    gathered_.insert(gathered_.end(), rows, rows + now * columns_);
    if (now == room) write_gathered();
    rows += now * columns_;
    count -= now;
  }
}

template <typename Number>
void GrowingSeries<Number>::flush() {
  write_gathered();
  if (!dirty_) return;
  check(H5Dflush(dataset_.id()), path_ + ": flush");
  dirty_ = false;
}

template <typename Number>
void GrowingSeries<Number>::close() {
  if (!dataset_.close()) check(-1, path_ + ": close");
}

template <typename Number>
void GrowingSeries<Number>::write_gathered() {
  if (gathered_.empty()) return;
  const hsize_t added[2] = {gathered_.size() / columns_, columns_};
  const hsize_t start[2] = {rows_, 0};
  const hsize_t size[2] = {rows_ + added[0], columns_};
  const std::string place = path_ + ": write";
  check(H5Dset_extent(dataset_.id(), size), place);
  const Handle target = own(H5Dget_space(dataset_.id()), H5Sclose, place);
  const Handle source = own(H5Screate_simple(2, added, nullptr), H5Sclose, place);
  check(H5Sselect_hyperslab(target.id(), H5S_SELECT_SET, start, nullptr, added, nullptr), place);
  check(H5Dwrite(dataset_.id(), memory_type<Number>(), source.id(), target.id(), H5P_DEFAULT,
                 gathered_.data()),
        place);
  rows_ += added[0];
  gathered_.clear();
  dirty_ = true;
}

template class GrowingSeries<float>;
template class GrowingSeries<double>;

}  // namespace rvbench::hal::hdf5
