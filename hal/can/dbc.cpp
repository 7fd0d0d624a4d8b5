#include "hal/can/dbc.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rvbench::hal::dbc {
namespace {

// From the highest bit to the lowest.
std::uint64_t raw_of(const Signal& signal, const CanFrame& frame) {
  std::uint64_t raw = 0;
  int at = signal.is_motorola ? signal.start_bit : signal.start_bit + signal.length - 1;
  for (int i = 0; i < signal.length; ++i) {
    const unsigned byte = frame.data[static_cast<std::size_t>(at / 8)];
    raw = raw << 1U | (byte >> static_cast<unsigned>(at % 8) & 1U);
    const bool next_byte = signal.is_motorola && at % 8 == 0;
    at += next_byte ? 15 : -1;
  }
  return raw;
}

std::int64_t signed_of(const Signal& signal, std::uint64_t raw) {
  const unsigned unused = 64U - static_cast<unsigned>(signal.length);
  return static_cast<std::int64_t>(raw << unused) >> unused;
}

bool carries(const Message& message, const Signal& signal, const CanFrame& frame) {
  if (frame.id != message.id || frame.length < message.length) return false;
  if (!signal.only_at) return true;
  const auto selecting = std::ranges::find_if(message.signals, &Signal::selects);
  return selecting != message.signals.end() && raw_of(*selecting, frame) == *signal.only_at;
}

}  // namespace

const Signal* Message::find(std::string_view signal) const {
  const auto found = std::ranges::find(signals, signal, &Signal::name);
  return found == signals.end() ? nullptr : &*found;
}

const Message* Database::find(std::string_view message) const {
  const auto found = std::ranges::find(messages, message, &Message::name);
  return found == messages.end() ? nullptr : &*found;
}

std::optional<double> value_of(const Message& message, const Signal& signal,
                               const CanFrame& frame) {
  if (signal.is_float || !carries(message, signal, frame)) return std::nullopt;
  const std::uint64_t raw = raw_of(signal, frame);
  const double counts =
      signal.is_signed ? static_cast<double>(signed_of(signal, raw)) : static_cast<double>(raw);
  return counts * signal.factor + signal.offset;
}

std::string word_for(const Signal& signal, double value) {
  const auto raw = std::llround((value - signal.offset) / signal.factor);
  const auto found = signal.words.find(raw);
  return found == signal.words.end() ? fmt::format("{:g}", value) : found->second;
}

}  // namespace rvbench::hal::dbc
