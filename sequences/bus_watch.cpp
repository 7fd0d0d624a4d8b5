#include "sequences/bus_watch.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <mutex>
#include <utility>

namespace rvbench::sequences {
namespace {

constexpr double longest_farewell_s = 1;  // no bus takes longer to answer

// A counter that has fallen belongs to an interface that was made anew meanwhile, one that is gone
// to another than is there now: nobody counted what went wrong in between.
std::string moved(const hal::BusCounters& before, const hal::BusCounters& after) {
  std::vector<std::string> words;
  for (const auto& [name, count] : after.counts) {
    const auto found = before.counts.find(name);
    const std::uint64_t earlier = found == before.counts.end() ? 0 : found->second;
    if (count > earlier) words.push_back(fmt::format("{} +{}", name, count - earlier));
    if (count < earlier) words.push_back(fmt::format("{} began anew", name));
  }
  for (const auto& [name, count] : before.counts) {
    if (!after.counts.contains(name)) words.push_back(fmt::format("{} is gone", name));
  }
  return words.empty() ? "" : fmt::format("{}: {}", after.interface, fmt::join(words, ", "));
}

std::string in_words(const Result<hal::BusCounters>& before,
                     const Result<hal::BusCounters>& after) {
  if (!before) return describe(before.error());
  if (!after) return describe(after.error());
  return moved(before.value(), after.value());
}

}  // namespace

struct BusWatch::Looks {
  std::mutex mutex;
  int record = 0;  // a look that was meant for another one comes too late
  std::optional<Look> before, after;
};

BusWatch::BusWatch(hal::Rig& rig) : rig_(rig), looks_(std::make_shared<Looks>()) {
  if (!rig.clock->is_virtual() && !rig.buses.empty()) reader_ = std::make_unique<Scribe>(1);
}

BusWatch::~BusWatch() { (void)finish(); }

bool BusWatch::finish() noexcept {
  if (reader_ && !has_hung_) has_hung_ = reader_->finish_within(longest_farewell_s) > 0;
  return !has_hung_;
}

void BusWatch::begin() {
  {
    const std::lock_guard lock(looks_->mutex);
    ++looks_->record;
    looks_->before.reset();
    looks_->after.reset();
  }
  look(&Looks::before);
}

void BusWatch::open_record() {
  const std::lock_guard lock(looks_->mutex);
  if (!looks_->before) ++looks_->record;
}

void BusWatch::end() { look(&Looks::after); }

void BusWatch::look(std::optional<Look> Looks::*into) {
  const auto read = [&buses = rig_.buses, looks = looks_, into, record = record_now()] {
    Look seen;
    for (const auto& bus : buses) seen.push_back(bus->read());
    const std::lock_guard lock(looks->mutex);
    if (looks->record == record) (*looks).*into = std::move(seen);
  };
  if (!reader_) return read();
  (void)reader_->post(0, read);
}

int BusWatch::record_now() const {
  const std::lock_guard lock(looks_->mutex);
  return looks_->record;
}

bool BusWatch::is_ready() const { return !reader_ || !reader_->is_busy(); }

std::string BusWatch::verdict() const {
  const std::lock_guard lock(looks_->mutex);
  if (!looks_->before || !looks_->after) return "the counters of the buses are not told in time";
  std::vector<std::string> words;
  for (std::size_t i = 0; i < looks_->after->size(); ++i) {
    std::string word = in_words((*looks_->before)[i], (*looks_->after)[i]);
    if (!word.empty()) words.push_back(std::move(word));
  }
  return fmt::format("{}", fmt::join(words, "; "));
}

}  // namespace rvbench::sequences
