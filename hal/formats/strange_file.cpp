#include "hal/formats/strange_file.hpp"

#include <string_view>

#include "hal/formats/foreign_file.hpp"

namespace rvbench::hal::formats {
namespace {

using namespace std::string_view_literals;

struct Kind {
  std::string_view begin;
  const char* looks_like;
};

// Source  of each format; gathered by file(1)
constexpr Kind kinds[] = {
    {"PK\x03\x04"sv, "a ZIP archive or a workbook of Excel: unpack it, or save the table as CSV"},
    {"\xD0\xCF\x11\xE0"sv, "an old file of Excel or Word: save the table as CSV"},
    {"\x1F\x8B"sv, "packed by gzip: unpack it"},
    {"BZh"sv, "packed by bzip2: unpack it"},
    {"\xFD"
     "7zXZ"sv,
     "packed by xz: unpack it"},
    {"\x28\xB5\x2F\xFD"sv, "packed by zstd: unpack it"},
    {"7z\xBC\xAF"sv, "a 7z archive: unpack it"},
    {"Rar!"sv, "a RAR archive: unpack it"},
    {"\x93NUMPY"sv, "an array of NumPy: write it as CSV, or with h5py or scipy.io.savemat"},
    {"TDSh"sv, "the index of a TDMS file, which has no values: take the .tdms beside it"},
    {"MDF     "sv, "a file of MDF: export it as MAT or CSV"},
    {"UnFinMF "sv, "an unfinished file of MDF: export it as MAT or CSV"},
    {"CDF\x01"sv, "a file of netCDF 3: write it as CSV, or as HDF5"},
    {"PAR1"sv, "a file of Parquet: write it as CSV"},
    {"SQLite format 3"sv, "a database of SQLite: export the table as CSV"},
    {"OggS"sv, "sound packed with losses: record it as WAV or FLAC"},
    {"ID3"sv, "sound packed with losses: record it as WAV or FLAC"},
    {"%PDF"sv, "a PDF document"},
    {"\x89PNG"sv, "a picture"},
    {"\xFF\xD8\xFF"sv, "a picture"},
    {"\x7F"
     "ELF"sv,
     "a program"},
    {"<?xml"sv, "XML: export the table as CSV"},
    {"<html"sv, "a page of the web"},
    {"<!DOCTYPE"sv, "a page of the web"},
};

}  // namespace

std::optional<std::string> what_it_looks_like(const std::filesystem::path& file) {
  if (find_obstacle(file)) return std::nullopt;
  const std::string head = head_of(file);
  for (const Kind& kind : kinds) {
    if (head.starts_with(kind.begin)) return kind.looks_like;
  }
  return std::nullopt;
}

std::string not_read(const std::string& looks_like) {
  return "no file that rvbench reads (it looks like " + looks_like + ")";
}

}  // namespace rvbench::hal::formats
