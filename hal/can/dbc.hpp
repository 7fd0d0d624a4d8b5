#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "hal/can_transport.hpp"
#include "hal/config_reader.hpp"

/// What frames on a CAN bus mean, as a DBC file tells it: the part of the format that classic CAN
/// with integers needs. BO_, SG_ with both byte orders and simple multiplexing, VAL_, and
/// SIG_VALTYPE_, of which signals are told that cannot be read. All other sections are passed over,
/// and the message VECTOR__INDEPENDENT_SIG_MSG, where editors keep signals that belong to no
/// message.
namespace rvbench::hal::dbc {

/// A number in a frame: raw * factor + offset.
struct Signal {
  std::string name;
  int start_bit = 0;  ///< as the file has it: of the lowest bit, or of the highest one (Motorola)
  int length = 0;     ///< bits, 1 to 64
  bool is_motorola = false;
  bool is_signed = false;
  bool is_float = false;  ///< not read here
  double factor = 1;
  double offset = 0;
  std::string unit = {};
  bool selects = false;                       ///< its raw value says which others are there
  std::optional<std::uint64_t> only_at = {};  ///< there only while the selecting one has this value
  std::map<std::int64_t, std::string> words = {};  ///< of VAL_, by raw value
};

struct Message {
  std::uint32_t id = 0;
  bool is_extended = false;  ///< 29 bits
  std::string name;
  int length = 0;  ///< bytes, 0 to 8
  std::vector<Signal> signals;

  /// @return null if there is none of that name
  const Signal* find(std::string_view signal) const;
};

struct Database {
  std::vector<Message> messages;

  const Message* find(std::string_view message) const;
};

/// @return the database, or everything that is wrong with the text (pointers are empty)
std::variant<Database, std::vector<ConfigFault>> parse(std::string_view text);

/// What a signal says in a frame; empty if the frame is not the message's, too short, or does not
/// carry the signal now, or the signal is a floating-point number.
std::optional<double> value_of(const Message& message, const Signal& signal, const CanFrame& frame);

/// "shunt on": the word for a signal's value, or the value itself where VAL_ has none for it.
std::string word_for(const Signal& signal, double value);

}  // namespace rvbench::hal::dbc
