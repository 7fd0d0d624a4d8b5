#include "sequences/bus_watch.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace rvbench::sequences {
namespace {

// A counter that has fallen belongs to an interface that was made anew meanwhile.
std::string moved(const hal::BusCounters& before, const hal::BusCounters& after) {
  std::vector<std::string> words;
  for (const auto& [name, count] : after.counts) {
    const auto found = before.counts.find(name);
    const std::uint64_t earlier = found == before.counts.end() ? 0 : found->second;
    if (count > earlier) words.push_back(fmt::format("{} +{}", name, count - earlier));
    if (count < earlier) words.push_back(fmt::format("{} began anew", name));
  }
  return words.empty() ? "" : fmt::format("{}: {}", after.interface, fmt::join(words, ", "));
}

std::string verdict(const Result<hal::BusCounters>& before, const Result<hal::BusCounters>& after) {
  if (!before) return describe(before.error());
  if (!after) return describe(after.error());
  return moved(before.value(), after.value());
}

}  // namespace

void BusWatch::begin() {
  before_.clear();
  for (const auto& bus : rig_.buses) before_.push_back(bus->read());
}

std::string BusWatch::end() const {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < before_.size(); ++i) {
    if (std::string word = verdict(before_[i], rig_.buses[i]->read()); !word.empty()) {
      words.push_back(std::move(word));
    }
  }
  return fmt::format("{}", fmt::join(words, "; "));
}

}  // namespace rvbench::sequences
