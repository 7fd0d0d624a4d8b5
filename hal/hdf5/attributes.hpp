#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hal/hdf5/hdf5_handle.hpp"

namespace rvbench::hal::hdf5 {

/// Attributes of an open group, dataset or file. Text is UTF-8, padded to a fixed length: any
/// tool reads that. Readers also take variable-length text, and any kind of number.
/// All throw FileFailure.
void write_number(const Handle& object, const char* name, double value);
void write_integer(const Handle& object, const char* name, int value);
void write_numbers(const Handle& object, const char* name, const std::vector<double>& values);
void write_text(const Handle& object, const char* name, const std::string& value);
void write_texts(const Handle& object, const char* name, const std::vector<std::string>& values);

/// Empty if there is no such attribute.
/// @throws FileFailure if there is one, but of another kind or of absurd size
std::vector<double> read_numbers(const Handle& object, const char* name);
std::vector<std::string> read_texts(const Handle& object, const char* name);

/// The first value, if there is any.
std::optional<double> read_number(const Handle& object, const char* name);
std::optional<std::string> read_text(const Handle& object, const char* name);

}  // namespace rvbench::hal::hdf5
