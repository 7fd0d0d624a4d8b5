#include "hal/hdf5/tables.hpp"

#include <hdf5.h>

#include "hal/hdf5/stored_data.hpp"

namespace rvbench::hal::hdf5 {
namespace {

constexpr hsize_t chunk_rows = 64;

void add(const Handle& row, const char* name, std::size_t offset, hid_t type) {
  check(H5Tinsert(row.id(), name, offset, type), name);
}

void add_text(const Handle& row, const char* name, std::size_t offset, std::size_t bytes) {
  const Handle type = own(H5Tcopy(H5T_C_S1), H5Tclose, name);
  check(H5Tset_size(type.id(), bytes), name);
  check(H5Tset_cset(type.id(), H5T_CSET_UTF8), name);
  add(row, name, offset, type.id());
}

Handle row_type(const IndexRow&) {
  Handle row = own(H5Tcreate(H5T_COMPOUND, sizeof(IndexRow)), H5Tclose, index_path);
  add(row, "point", offsetof(IndexRow, point), H5T_NATIVE_INT);
  add(row, "t0_s", offsetof(IndexRow, t0_s), H5T_NATIVE_DOUBLE);
  add_text(row, "status", offsetof(IndexRow, status), sizeof(IndexRow::status));
  add(row, "speed_rpm", offsetof(IndexRow, speed_rpm), H5T_NATIVE_DOUBLE);
  add(row, "torque_Nm", offsetof(IndexRow, torque_Nm), H5T_NATIVE_DOUBLE);
  add(row, "acceleration_t0_s", offsetof(IndexRow, acceleration_t0_s), H5T_NATIVE_DOUBLE);
  add(row, "torque_t0_s", offsetof(IndexRow, torque_t0_s), H5T_NATIVE_DOUBLE);
  add(row, "acceleration_time_uncertainty_s", offsetof(IndexRow, acceleration_time_uncertainty_s),
      H5T_NATIVE_DOUBLE);
  add(row, "torque_time_uncertainty_s", offsetof(IndexRow, torque_time_uncertainty_s),
      H5T_NATIVE_DOUBLE);
  return row;
}

Handle row_type(const EventRow&) {
  Handle row = own(H5Tcreate(H5T_COMPOUND, sizeof(EventRow)), H5Tclose, events_path);
  add(row, "time_s", offsetof(EventRow, time_s), H5T_NATIVE_DOUBLE);
  add_text(row, "text", offsetof(EventRow, text), sizeof(EventRow::text));
  return row;
}

template <typename Row>
void create(const Handle& file, const char* path) {
  const hsize_t none = 0;
  const hsize_t most = H5S_UNLIMITED;
  const Handle space = own(H5Screate_simple(1, &none, &most), H5Sclose, path);
  const Handle properties = own(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, path);
  check(H5Pset_chunk(properties.id(), 1, &chunk_rows), path);
  const Handle packed = row_type(Row{});
  check(H5Tpack(packed.id()), path);
  own(H5Dcreate2(file.id(), path, packed.id(), space.id(), H5P_DEFAULT, properties.id(),
                 H5P_DEFAULT),
      H5Dclose, path);
}

template <typename Row>
void append(const Handle& file, const char* path, const Row& row) {
  Handle dataset = own(H5Dopen2(file.id(), path, H5P_DEFAULT), H5Dclose, path);
  const Handle before = own(H5Dget_space(dataset.id()), H5Sclose, path);
  hsize_t rows = 0;
  check(H5Sget_simple_extent_dims(before.id(), &rows, nullptr), path);
  const hsize_t more = rows + 1;
  const hsize_t one = 1;
  check(H5Dset_extent(dataset.id(), &more), path);
  const Handle target = own(H5Dget_space(dataset.id()), H5Sclose, path);
  const Handle source = own(H5Screate_simple(1, &one, nullptr), H5Sclose, path);
  check(H5Sselect_hyperslab(target.id(), H5S_SELECT_SET, &rows, nullptr, &one, nullptr), path);
  check(H5Dwrite(dataset.id(), row_type(row).id(), source.id(), target.id(), H5P_DEFAULT, &row),
        path);
  check(H5Dflush(dataset.id()), path);
  if (!dataset.close()) check(-1, path);
}

template <typename Row>
std::vector<Row> read(const Handle& file, const char* path, std::size_t file_bytes) {
  std::vector<Row> rows;
  const htri_t exists = H5Lexists(file.id(), path, H5P_DEFAULT);
  check(exists, path);
  if (exists == 0) return rows;
  const Handle dataset = own(H5Dopen2(file.id(), path, H5P_DEFAULT), H5Dclose, path);
  const Handle type = own(H5Dget_type(dataset.id()), H5Tclose, path);
  const Extent extent = checked_extent(dataset, file_bytes, path);
  if (H5Tget_class(type.id()) != H5T_COMPOUND || extent.columns != 1) {
    throw FileFailure(IoErrc::bad_data, std::string(path) + ": not a table");
  }
  rows.resize(extent.rows);
  if (rows.empty()) return rows;
  check(H5Dread(dataset.id(), row_type(Row{}).id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data()),
        path);
  return rows;
}

}  // namespace

void create_tables(const Handle& file) {
  create<IndexRow>(file, index_path);
  create<EventRow>(file, events_path);
}

void append_row(const Handle& file, const IndexRow& row) { append(file, index_path, row); }

void append_row(const Handle& file, const EventRow& row) { append(file, events_path, row); }

std::vector<IndexRow> read_index(const Handle& file, std::size_t file_bytes) {
  return read<IndexRow>(file, index_path, file_bytes);
}

std::vector<EventRow> read_events(const Handle& file, std::size_t file_bytes) {
  return read<EventRow>(file, events_path, file_bytes);
}

}  // namespace rvbench::hal::hdf5
