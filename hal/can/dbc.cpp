#include "hal/can/dbc.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace rvbench::hal::dbc {
namespace {

// Calls visit(byte, bit) for each bit of a signal, from the highest to the lowest.
template <typename Visit>
void each_bit(const Signal& signal, Visit visit) {
  int at = signal.is_motorola ? signal.start_bit : signal.start_bit + signal.length - 1;
  for (int i = 0; i < signal.length; ++i) {
    visit(static_cast<std::size_t>(at / 8), static_cast<unsigned>(at % 8));
    const bool next_byte = signal.is_motorola && at % 8 == 0;
    at += next_byte ? 15 : -1;
  }
}

std::uint64_t raw_of(const Signal& signal, const CanFrame& frame) {
  std::uint64_t raw = 0;
  each_bit(signal, [&](std::size_t byte, unsigned bit) {
    raw = raw << 1U | (unsigned{frame.data[byte]} >> bit & 1U);
  });
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
  if (!carries(message, signal, frame)) return std::nullopt;
  const std::uint64_t raw = raw_of(signal, frame);
  const double counts =
      signal.is_signed ? static_cast<double>(signed_of(signal, raw)) : static_cast<double>(raw);
  return counts * signal.factor + signal.offset;
}

std::optional<std::string> word_of(const Message& message, const Signal& signal,
                                   const CanFrame& frame) {
  if (!carries(message, signal, frame)) return std::nullopt;
  const std::uint64_t raw = raw_of(signal, frame);
  const std::int64_t value =
      signal.is_signed ? signed_of(signal, raw) : static_cast<std::int64_t>(raw);
  const auto found = signal.words.find(value);
  if (found == signal.words.end()) return std::nullopt;
  return found->second;
}

void put(const Signal& signal, double value, CanFrame& frame) {
  const double counts = std::round((value - signal.offset) / signal.factor);
  const double span = std::ldexp(1.0, signal.length - (signal.is_signed ? 1 : 0));
  const bool fits = counts < span && counts >= (signal.is_signed ? -span : 0.0);
  if (!fits) {
    throw std::invalid_argument(fmt::format("dbc::put: {} does not fit into {} bits of {}", value,
                                            signal.length, signal.name));
  }
  std::uint64_t raw = counts < 0 ? static_cast<std::uint64_t>(static_cast<std::int64_t>(counts))
                                 : static_cast<std::uint64_t>(counts);
  raw <<= 64U - static_cast<unsigned>(signal.length);  // its highest bit comes first
  each_bit(signal, [&](std::size_t byte, unsigned bit) {
    const auto mask = static_cast<std::uint8_t>(1U << bit);
    const bool is_set = (raw >> 63U) != 0;
    frame.data[byte] =
        static_cast<std::uint8_t>(is_set ? frame.data[byte] | mask : frame.data[byte] & ~mask);
    raw <<= 1U;
  });
}

}  // namespace rvbench::hal::dbc
