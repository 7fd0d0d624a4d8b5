#include "hal/hdf5/sample_group.hpp"

#include <fmt/format.h>

#include <cmath>

#include "hal/hdf5/attributes.hpp"

namespace rvbench::hal::hdf5 {
namespace {

void check_length(std::size_t length, std::size_t columns, const char* attribute) {
  if (length == 0 || length == columns) return;
  throw FileFailure(IoErrc::bad_data, fmt::format("attribute {}: {} values for {} channels",
                                                  attribute, length, columns));
}

}  // namespace

void write_sample_group(const Handle& group, const SampleGroup& samples) {
  std::vector<std::string> names;
  std::vector<std::string> units;
  std::vector<std::string> directions;
  std::vector<double> sensitivity;
  for (const ChannelInfo& channel : samples.channels) {
    names.push_back(channel.name);
    units.push_back(channel.unit);
    directions.push_back(channel.direction);
    sensitivity.push_back(channel.sensitivity);
  }
  write_number(group, "rate_Hz", samples.rate_Hz);
  write_texts(group, "channels", names);
  write_texts(group, "units", units);
  write_texts(group, "directions", directions);
  write_numbers(group, "sensitivity", sensitivity);
  write_number(group, "full_scale", samples.full_scale);
}

SampleGroup read_sample_group(const Handle& group, std::size_t columns, const std::string& name) {
  SampleGroup samples;
  samples.rate_Hz = read_number(group, "rate_Hz").value_or(0);
  if (!std::isfinite(samples.rate_Hz) || samples.rate_Hz < 0) {
    throw FileFailure(IoErrc::bad_data,
                      fmt::format("attribute rate_Hz: {} is not above 0", samples.rate_Hz));
  }
  samples.full_scale = read_number(group, "full_scale").value_or(not_known);
  const std::vector<std::string> names = read_texts(group, "channels");
  const std::vector<std::string> units = read_texts(group, "units");
  const std::vector<std::string> directions = read_texts(group, "directions");
  const std::vector<double> sensitivity = read_numbers(group, "sensitivity");
  check_length(names.size(), columns, "channels");
  check_length(units.size(), columns, "units");
  check_length(directions.size(), columns, "directions");
  check_length(sensitivity.size(), columns, "sensitivity");
  for (std::size_t i = 0; i < columns; ++i) {
    ChannelInfo channel;
    channel.name = names.empty() ? fmt::format("{}_{}", name, i + 1) : names[i];
    if (!units.empty()) channel.unit = units[i];
    if (!directions.empty()) channel.direction = directions[i];
    if (!sensitivity.empty()) channel.sensitivity = sensitivity[i];
    samples.channels.push_back(std::move(channel));
  }
  return samples;
}

}  // namespace rvbench::hal::hdf5
