#include "hal/hdf5/hdf5_handle.hpp"

#include <hdf5.h>

#include <string_view>

namespace rvbench::hal::hdf5 {
namespace {

herr_t keep_first(unsigned depth, const H5E_error2_t* error, void* text) {
  if (depth == 0 && error->desc != nullptr) *static_cast<std::string*>(text) = error->desc;
  return 0;
}

// The innermost reason of the last failure; of an operating system's error only its own words.
std::string last_reason() {
  std::string text = "HDF5 gives no reason";
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &text);
  constexpr std::string_view marker = "error message = '";
  const std::size_t begin = text.find(marker);
  if (begin == std::string::npos) return text;
  const std::size_t from = begin + marker.size();
  return text.substr(from, text.find('\'', from) - from);
}

}  // namespace

void prepare_thread() {
  // Files that could not be written to the end cannot be closed either; HDF5's own clean-up at
  // exit would then try in vain and complain on stderr. Every file here has an owner instead.
  [[maybe_unused]] static const herr_t no_clean_up = H5dont_atexit();
  // Each time: matio puts a handler of its own there, which takes the reasons away.
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Handle own(Handle::Id id, Handle::Close close, const std::string& place) {
  check(id, place);
  return Handle(id, close);
}

void check(std::int64_t status, const std::string& place) {
  if (status < 0) throw FileFailure(IoErrc::bad_data, place + ": " + last_reason());
}

Handle file_access() {
  Handle access = own(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "file access");
  check(H5Pset_libver_bounds(access.id(), H5F_LIBVER_LATEST, H5F_LIBVER_LATEST), "file access");
  return access;
}

}  // namespace rvbench::hal::hdf5
