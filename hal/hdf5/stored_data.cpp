#include "hal/hdf5/stored_data.hpp"

#include <hdf5.h>

#include <algorithm>

namespace rvbench::hal::hdf5 {
namespace {

// The best that deflate can do (zlib manual): a filtered dataset that claims more is a lie.
constexpr std::size_t most_compressed = 1032;

[[noreturn]] void refuse(const std::string& place, const std::string& why) {
  throw FileFailure(IoErrc::bad_data, place + ": " + why);
}

void check_inside(haddr_t address, hsize_t bytes, std::size_t file_bytes,
                  const std::string& place) {
  if (address == HADDR_UNDEF) refuse(place, "claims samples that were never written");
  if (address > file_bytes || bytes > file_bytes - address) refuse(place, "the file is cut off");
}

void check_claim(const Handle& dataset, const Handle& properties, const Extent& extent,
                 std::size_t file_bytes, const std::string& place) {
  const Handle type = own(H5Dget_type(dataset.id()), H5Tclose, place);
  const int filters = H5Pget_nfilters(properties.id());
  check(filters, place);
  const std::size_t stored = H5Dget_storage_size(dataset.id());
  const double most = static_cast<double>(std::min(stored, file_bytes)) *
                      (filters > 0 ? static_cast<double>(most_compressed) : 1.0);
  const double claimed = static_cast<double>(extent.rows) * static_cast<double>(extent.columns) *
                         static_cast<double>(H5Tget_size(type.id()));
  if (claimed > most) refuse(place, "claims more samples than the file holds");
}

void check_chunks(const Handle& dataset, const Handle& properties, const Extent& extent, int rank,
                  std::size_t file_bytes, const std::string& place) {
  hsize_t chunk[2] = {1, 1};
  check(H5Pget_chunk(properties.id(), rank, chunk), place);
  for (hsize_t row = 0; row < extent.rows; row += chunk[0]) {
    for (hsize_t column = 0; column < extent.columns; column += chunk[1]) {
      const hsize_t at[2] = {row, column};
      unsigned mask = 0;
      haddr_t address = HADDR_UNDEF;
      hsize_t bytes = 0;
      check(H5Dget_chunk_info_by_coord(dataset.id(), at, &mask, &address, &bytes), place);
      check_inside(address, bytes, file_bytes, place);
    }
  }
}

}  // namespace

Extent checked_extent(const Handle& dataset, std::size_t file_bytes, const std::string& place) {
  const Handle space = own(H5Dget_space(dataset.id()), H5Sclose, place);
  const int rank = H5Sget_simple_extent_ndims(space.id());
  check(rank, place);
  if (rank != 1 && rank != 2) refuse(place, "not samples x channels");
  hsize_t size[2] = {0, 1};
  check(H5Sget_simple_extent_dims(space.id(), size, nullptr), place);
  const Extent extent{size[0], size[1]};
  if (extent.rows == 0 || extent.columns == 0) return extent;

  const Handle properties = own(H5Dget_create_plist(dataset.id()), H5Pclose, place);
  check_claim(dataset, properties, extent, file_bytes, place);
  switch (H5Pget_layout(properties.id())) {
    case H5D_CHUNKED: check_chunks(dataset, properties, extent, rank, file_bytes, place); break;
    case H5D_CONTIGUOUS:
      if (H5Pget_external_count(properties.id()) != 0) refuse(place, "kept in another file");
      check_inside(H5Dget_offset(dataset.id()), H5Dget_storage_size(dataset.id()), file_bytes,
                   place);
      break;
    case H5D_COMPACT: break;
    default: refuse(place, "kept in another file");
  }
  return extent;
}

}  // namespace rvbench::hal::hdf5
