#include <hdf5.h>

#include <cstdint>

#include "hal/formats/mat_header.hpp"
#include "hal/formats/mat_structure.hpp"
#include "hal/formats/utf16.hpp"
#include "hal/formats/writer.hpp"
#include "hal/hdf5/attributes.hpp"
#include "hal/hdf5/plain_array.hpp"

// A MAT file of v7.3 is an HDF5 file behind 512 bytes that begin as those of v5 do. Its layout is
// not published by its maker: MATLAB_class and what goes with it are as MATLAB's own files have
// them, and as libmatio and others read them.
namespace rvbench::hal::formats {
namespace {

using namespace hdf5;

constexpr hsize_t user_block_bytes = 512;
constexpr std::uint16_t mat73_version = 0x0200;
constexpr int text_of_uint16 = 2;  // MATLAB_int_decode

Handle ascii_type(std::size_t bytes) {
  Handle type = own(H5Tcopy(H5T_C_S1), H5Tclose, "text");
  check(H5Tset_size(type.id(), bytes), "text");
  return type;
}

void put_attribute(const Handle& object, const char* name, const Handle& type, const Handle& space,
                   const void* value) {
  const Handle attribute =
      own(H5Acreate2(object.id(), name, type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
          name);
  check(H5Awrite(attribute.id(), type.id(), value), name);
}

void put_class(const Handle& object, const std::string& kind) {
  const Handle scalar = own(H5Screate(H5S_SCALAR), H5Sclose, "scalar");
  put_attribute(object, "MATLAB_class", ascii_type(kind.size()), scalar, kind.data());
}

// The names of the fields in their order, letter by letter.
void put_fields(const Handle& structure, const std::vector<std::string>& names) {
  std::vector<hvl_t> letters;
  for (const std::string& name : names) {
    letters.push_back({name.size(), const_cast<char*>(name.data())});
  }
  const hsize_t count = names.size();
  const Handle space = own(H5Screate_simple(1, &count, nullptr), H5Sclose, "fields");
  const Handle type = own(H5Tvlen_create(ascii_type(1).id()), H5Tclose, "fields");
  put_attribute(structure, "MATLAB_fields", type, space, letters.data());
}

// Columns are MATLAB's rows: its arrays lie in memory column after column.
void put_numbers(const Handle& structure, const std::string& name, const Eigen::MatrixXd& values) {
  put_class(write_array(structure, name, values.transpose(), false), "double");
}

void put_text(const Handle& structure, const std::string& name, const std::string& text) {
  const std::vector<std::uint16_t> units = utf16_of(text);
  const hsize_t size[2] = {units.size(), 1};
  const Handle space = own(H5Screate_simple(2, size, nullptr), H5Sclose, name);
  const Handle dataset = own(H5Dcreate2(structure.id(), name.c_str(), H5T_STD_U16LE, space.id(),
                                        H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                             H5Dclose, name);
  check(H5Dwrite(dataset.id(), H5T_NATIVE_UINT16, H5S_ALL, H5S_ALL, H5P_DEFAULT, units.data()),
        name);
  put_class(dataset, "char");
  write_integer(dataset, "MATLAB_int_decode", text_of_uint16);
}

void put_structure(const Handle& file, const MatStructure& structure) {
  const Handle group =
      own(H5Gcreate2(file.id(), structure.name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
          H5Gclose, structure.name);
  put_class(group, "struct");
  std::vector<std::string> fields;
  for (const auto& [name, values] : structure.numbers) {
    put_numbers(group, name, values);
    fields.push_back(name);
  }
  for (const auto& [name, text] : structure.texts) {
    put_text(group, name, text);
    fields.push_back(name);
  }
  put_fields(group, fields);
}

void fill(const Recording& recording, const std::filesystem::path& path) {
  const Handle creation = own(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "create");
  check(H5Pset_userblock(creation.id(), user_block_bytes), "create");
  Handle file =
      own(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.id(), H5P_DEFAULT), H5Fclose, "create");
  for (const MatStructure& structure : mat_structures(recording)) put_structure(file, structure);
  check(H5Fflush(file.id(), H5F_SCOPE_GLOBAL), "write");
  if (!file.close()) check(-1, "close");
}

Status write_mat73(const std::vector<Recording>& recordings, FileDraft& draft) {
  return guarded(draft.file(), [&]() -> Status {
    fill(recordings.front(), draft.path());
    return draft.write_first(mat_header("MATLAB 7.3 MAT-file, HDF5 schema 1.00 .", mat73_version));
  });
}

}  // namespace

Writer mat73_writer() { return {"mat73", "MAT v7.3", {}, {.clocks = true}, write_mat73}; }

}  // namespace rvbench::hal::formats
