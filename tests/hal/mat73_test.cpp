#include <hdf5.h>

#include "hal/hdf5/hdf5_handle.hpp"
#include "tests/hal/export_fixture.hpp"

namespace rvbench::hal {
namespace {

using Catch::Contains;
using hdf5::Handle;
using test::ScratchFolder;

// A MAT file of v7.3 as MATLAB would lay it out, apart from the code that writes them here.
class Mat73 {
 public:
  explicit Mat73(std::filesystem::path path) : path_(std::move(path)) {
    hdf5::prepare_thread();
    const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
    H5Pset_userblock(creation.id(), 512);
    file_ = Handle(H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, creation.id(), H5P_DEFAULT), H5Fclose);
  }

  /// @param columns  of MATLAB; the file has them as rows
  Mat73& add(const std::string& name, const char* kind, hsize_t rows, hsize_t columns,
             const std::vector<double>& values, hid_t type = H5T_IEEE_F64LE) {
    const hsize_t size[2] = {columns, rows};
    const Handle space(H5Screate_simple(2, size, nullptr), H5Sclose);
    const Handle set(H5Dcreate2(file_.id(), name.c_str(), type, space.id(), H5P_DEFAULT,
                                H5P_DEFAULT, H5P_DEFAULT),
                     H5Dclose);
    H5Dwrite(set.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    label(set, kind);
    return *this;
  }
  Mat73& add_structure(const std::string& name) {
    label(Handle(H5Gcreate2(file_.id(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                 H5Gclose),
          "struct");
    return *this;
  }

  std::filesystem::path done() {
    file_.close();
    std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
    file << "MATLAB 7.3 MAT-file, Platform: GLNXA64";
    return path_;
  }

 private:
  static void label(const Handle& object, const std::string& kind) {
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose), scalar(H5Screate(H5S_SCALAR), H5Sclose);
    H5Tset_size(type.id(), kind.size());
    const Handle attribute(
        H5Acreate2(object.id(), "MATLAB_class", type.id(), scalar.id(), H5P_DEFAULT, H5P_DEFAULT),
        H5Aclose);
    H5Awrite(attribute.id(), type.id(), kind.data());
  }

  std::filesystem::path path_;
  Handle file_;
};

}  // namespace

TEST_CASE("MAT v7.3: arrays lie transposed, the longer side is time", "[hal][formats]") {
  const ScratchFolder scratch;
  const auto file = Mat73(scratch / "a.mat")
                        .add("wide", "double", 2, 3, {1, 10, 2, 20, 3, 30})
                        .add("counts", "int16", 3, 1, {-1, 0, 1}, H5T_STD_I16LE)
                        .add("fs", "double", 1, 1, {25600})
                        .add("XRPM", "single", 1, 1, {1772}, H5T_IEEE_F32LE)
                        .done();
  const Recording recording = test::read_back(file).at(0);
  REQUIRE(recording.channels.size() == 3);
  CHECK(recording.find("wide_1")->samples == Eigen::Vector3d(1, 2, 3));
  CHECK(recording.find("wide_2")->samples == Eigen::Vector3d(10, 20, 30));
  CHECK(recording.find("counts")->samples == Eigen::Vector3d(-1, 0, 1));
  CHECK(recording.find("counts")->rate_Hz == 25600);
  CHECK(recording.speed_rpm == 1772);
  CHECK(recording.status == "ok");
}

TEST_CASE("MAT v7.3: fields of a structure say the rate, too, others are passed over",
          "[hal][formats]") {
  const ScratchFolder scratch;
  const auto file = Mat73(scratch / "a.mat")
                        .add_structure("Head")
                        .add("Head/SampFreq", "double", 1, 1, {12000})
                        .add_structure("#refs#")
                        .add("#refs#/a", "double", 4, 1, {1, 2, 3, 4})
                        .add("flag", "logical", 3, 1, {1, 0, 1}, H5T_STD_U8LE)
                        .add("x", "double", 3, 1, {1, 2, 3})
                        .done();
  const Recording recording = test::read_back(file).at(0);
  REQUIRE(recording.channels.size() == 1);
  CHECK(recording.channels[0].info.name == "x");
  CHECK(recording.channels[0].rate_Hz == 12000);
  CHECK_THAT(recording.notes.at(0), Contains("rate_Hz from Head.SampFreq"));
}

TEST_CASE("MAT v7.3: what cannot be read is refused with words", "[hal][formats]") {
  const ScratchFolder scratch;
  const auto complaint = [](const std::filesystem::path& file) {
    const auto read = read_recordings(file);
    REQUIRE_FALSE(read);
    return read.error().where;
  };
  CHECK_THAT(complaint(Mat73(scratch / "none.mat").done()), Contains("holds no samples"));
  CHECK_THAT(complaint(Mat73(scratch / "square.mat")
                           .add("y", "double", 300, 300, std::vector<double>(90000))
                           .done()),
             Contains("y: 300 x 300 is no set of signals"));
  std::ofstream(scratch / "text.mat") << "MATLAB 7.3 MAT-file, and nothing else";
  CHECK_THAT(complaint(scratch / "text.mat"), Contains("text.mat: open: "));
  const std::string whole = test::bytes_in(
      Mat73(scratch / "whole.mat").add("x", "double", 2000, 1, std::vector<double>(2000)).done());
  for (int part = 1; part < 8; ++part) {
    CAPTURE(part);
    std::ofstream(scratch / "cut.mat", std::ios::binary)
        << whole.substr(0, whole.size() * static_cast<std::size_t>(part) / 8);
    CHECK_THAT(complaint(scratch / "cut.mat"), Contains("cut.mat: "));
  }
}

}  // namespace rvbench::hal
