#include "hal/hdf5/plain_array.hpp"

#include <hdf5.h>

#include "hal/hdf5/stored_data.hpp"

namespace rvbench::hal::hdf5 {
namespace {

constexpr hsize_t most_names = 100000;

herr_t add_name(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

}  // namespace

std::vector<std::string> names_in(const Handle& file, const std::string& path) {
  const Handle group = own(H5Gopen2(file.id(), path.c_str(), H5P_DEFAULT), H5Gclose, path);
  H5G_info_t info;
  check(H5Gget_info(group.id(), &info), path);
  if (info.nlinks > most_names) throw FileFailure(IoErrc::bad_data, path + ": too many groups");
  std::vector<std::string> names;
  check(H5Literate(group.id(), H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, add_name, &names), path);
  return names;
}

Handle write_array(const Handle& group, const std::string& name, const RowMajor& values,
                   bool as_float) {
  const hsize_t size[2] = {static_cast<hsize_t>(values.rows()),
                           static_cast<hsize_t>(values.cols())};
  const Handle space = own(H5Screate_simple(2, size, nullptr), H5Sclose, name);
  Handle dataset =
      own(H5Dcreate2(group.id(), name.c_str(), as_float ? H5T_IEEE_F32LE : H5T_IEEE_F64LE,
                     space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
          H5Dclose, name);
  check(H5Dwrite(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
        name);
  return dataset;
}

RowMajor read_array(const Handle& dataset, std::size_t file_bytes, const std::string& place) {
  const Handle type = own(H5Dget_type(dataset.id()), H5Tclose, place);
  const H5T_class_t kind = H5Tget_class(type.id());
  if (kind != H5T_FLOAT && kind != H5T_INTEGER) {
    throw FileFailure(IoErrc::bad_data, place + ": not numbers");
  }
  const Extent extent = checked_extent(dataset, file_bytes, place);
  RowMajor values(extent.rows, extent.columns);
  if (values.size() == 0) return values;
  check(H5Dread(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
        place);
  return values;
}

}  // namespace rvbench::hal::hdf5
