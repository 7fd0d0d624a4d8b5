#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "hal/can/dbc.hpp"
#include "hal/can/dbc_tokens.hpp"
#include "hal/did_you_mean.hpp"

namespace rvbench::hal::dbc {
namespace {

constexpr std::uint32_t extended_flag = 0x80000000;

class Parser {
 public:
  explicit Parser(std::string_view text) : tokens_(tokens_of(text)) {}

  std::variant<Database, std::vector<ConfigFault>> parse() {
    while (at_ < tokens_.size()) {
      const std::size_t section = at_;
      try {
        parse_section();
      } catch (const Refused& refused) {
        faults_.push_back({refused.line, "", refused.what()});
        at_ = std::max(at_, section + 1);
        skip_section();
      }
    }
    end_message();
    if (database_.messages.empty() && faults_.empty()) {
      faults_.push_back({1, "", "no message (BO_) in it"});
    }
    if (!faults_.empty()) return faults_;
    return std::move(database_);
  }

 private:
  void parse_section() {
    const Token& word = tokens_[at_];
    if (!word.is_string && word.text == "BO_" && word.starts_line) {
      parse_message();
    } else if (is_signal(word)) {
      parse_signal();
    } else if (!word.is_string && word.text == "SIG_VALTYPE_" && word.starts_line) {
      parse_value_type();
    } else if (!word.is_string && word.text == "VAL_" && word.starts_line) {
      parse_words();
    } else {
      ++at_;
      skip_section();
    }
  }

  // Signals are indented; the word is used in comments' sections, too.
  static bool is_signal(const Token& token) {
    return token.is_first && !token.is_string && token.text == "SG_";
  }

  // To what begins a line, or a signal: sections that are not ours may go over several lines.
  void skip_section() {
    while (at_ < tokens_.size() && !tokens_[at_].starts_line && !is_signal(tokens_[at_])) ++at_;
  }

  const Token& next(const char* what) {
    const int line = tokens_.empty() ? 1 : tokens_[std::min(at_, tokens_.size() - 1)].line;
    if (at_ >= tokens_.size()) throw Refused(line, fmt::format("ends before {}", what));
    return tokens_[at_++];
  }

  void expect(std::string_view text) {
    const Token& token = next(std::string(text).c_str());
    if (token.is_string || token.text != text) {
      throw Refused(token.line, fmt::format("expected {}, found {}", text, in_quotes(token.text)));
    }
  }

  bool is_next(std::string_view text) const {
    return at_ < tokens_.size() && !tokens_[at_].is_string && tokens_[at_].text == text;
  }

  template <typename T>
  T number(const char* what) {
    const Token& token = next(what);
    std::string_view digits = token.text;
    if (digits.starts_with('+')) digits.remove_prefix(1);
    T value{};
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    const bool whole = error == std::errc() && stop == digits.data() + digits.size();
    if (token.is_string || !whole) {
      throw Refused(token.line, fmt::format("expected {}, found {}", what, in_quotes(token.text)));
    }
    if constexpr (std::is_floating_point_v<T>) {
      if (!std::isfinite(value)) throw Refused(token.line, fmt::format("{} is not finite", what));
    }
    return value;
  }

  std::string name(const char* what) {
    const Token& token = next(what);
    if (token.is_string || token.text.empty() || is_separator(token.text.front())) {
      throw Refused(token.line, fmt::format("expected {}, found {}", what, in_quotes(token.text)));
    }
    return std::string(token.text);
  }

  // BO_ 385 TorqueData: 8 Transducer
  void parse_message() {
    end_message();
    const int line = tokens_[at_++].line;
    message_ = nullptr;
    is_passed_over_ = false;
    Message message;
    const auto id = number<std::uint32_t>("a message's identifier");
    message.name = name("a message's name");
    if (message.name == "VECTOR__INDEPENDENT_SIG_MSG") {
      is_passed_over_ = true;
      skip_section();
      return;
    }
    message.is_extended = (id & extended_flag) != 0;
    message.id = id & ~extended_flag;
    if (message.id > (message.is_extended ? 0x1FFFFFFFU : 0x7FFU)) {
      throw Refused(line, fmt::format("identifier {} has too many bits", id));
    }
    expect(":");
    message.length = number<int>("a message's length");
    if (message.length < 0 || message.length > 8) {
      throw Refused(line, fmt::format("{} has {} bytes, classic CAN has 0 to 8", message.name,
                                      message.length));
    }
    (void)name("a message's sender");
    if (database_.find(message.name) != nullptr) {
      throw Refused(line, fmt::format("message {} is there twice", message.name));
    }
    database_.messages.push_back(std::move(message));
    message_ = &database_.messages.back();
  }

  // The signal that selects others may stand behind them.
  void end_message() {
    for (const auto& [line, signal] : selected_) {
      if (has_selecting_) break;
      faults_.push_back({line, "", signal + ": no signal of its message selects it (M)"});
    }
    selected_.clear();
    has_selecting_ = false;
  }

  // SG_ Torque m3 : 0|32@1- (1e-06,0) [-2147|2147] "N·m" Bench
  void parse_signal() {
    const int line = tokens_[at_++].line;
    if (is_passed_over_) return skip_section();
    if (message_ == nullptr) throw Refused(line, "a signal (SG_) that belongs to no message");
    Signal signal;
    signal.name = name("a signal's name");
    if (!is_next(":")) read_multiplexing(signal);
    expect(":");
    signal.start_bit = number<int>("a signal's first bit");
    expect("|");
    signal.length = number<int>("a signal's length");
    expect("@");
    const int byte_order = number<int>("a byte order");
    if (byte_order != 0 && byte_order != 1) {
      throw Refused(line, fmt::format("{}: the byte order is {}, must be 0 (Motorola) or 1 (Intel)",
                                      signal.name, byte_order));
    }
    signal.is_motorola = byte_order == 0;
    const Token& sign = next("a sign");
    signal.is_signed = sign.text == "-";
    if (sign.is_string || (sign.text != "-" && sign.text != "+")) {
      throw Refused(line, fmt::format("expected + or -, found {}", in_quotes(sign.text)));
    }
    expect("(");
    signal.factor = number<double>("a factor");
    expect(",");
    signal.offset = number<double>("an offset");
    expect(")");
    expect("[");
    (void)number<double>("a minimum");
    expect("|");
    (void)number<double>("a maximum");
    expect("]");
    const Token& unit = next("a unit");
    if (!unit.is_string) throw Refused(line, "expected a unit in quotes");
    signal.unit = unit.text;
    check(signal, line);
    message_->signals.push_back(std::move(signal));
    skip_section();  // who receives it
  }

  void read_multiplexing(Signal& signal) {
    const Token& mark = next("a mark of multiplexing");
    if (!mark.is_string && mark.text == "M") {
      signal.selects = has_selecting_ = true;
      return;
    }
    std::uint64_t value = 0;
    const char* const end = mark.text.data() + mark.text.size();
    const auto [stop, error] = std::from_chars(mark.text.data() + 1, end, value);
    if (mark.is_string || mark.text.size() < 2 || mark.text.front() != 'm' ||
        error != std::errc() || stop != end) {
      throw Refused(mark.line, fmt::format("{}: multiplexing as {} is not read here", signal.name,
                                           in_quotes(mark.text)));
    }
    signal.only_at = value;
    selected_.emplace_back(mark.line, signal.name);
  }

  void check(const Signal& signal, int line) const {
    const auto refuse = [&](const std::string& what) {
      throw Refused(line, fmt::format("{}: {}", signal.name, what));
    };
    const int bits = 8 * message_->length;
    if (signal.length < 1 || signal.length > 64) refuse("a signal has 1 to 64 bits");
    if (signal.start_bit < 0 || signal.start_bit >= bits) refuse("starts outside of its message");
    // Motorola counts down within a byte and goes on at the top of the next one.
    const int first = signal.is_motorola ? 8 * (signal.start_bit / 8) + 7 - signal.start_bit % 8
                                         : signal.start_bit;
    if (first + signal.length > bits) refuse("ends outside of its message");
    if (signal.factor == 0) refuse("has the factor 0");
    if (message_->find(signal.name) != nullptr) refuse("is there twice");
    if (signal.selects && std::ranges::any_of(message_->signals, &Signal::selects)) {
      refuse("a second signal that selects others");
    }
  }

  // SIG_VALTYPE_ 385 Torque : 1; the signal may be one that nobody reads: see torque_decoder().
  void parse_value_type() {
    ++at_;
    const auto id = number<std::uint32_t>("a message's identifier");
    const std::string signal = name("a signal's name");
    if (is_next(":")) ++at_;
    const bool is_float = number<int>("a type, 0 to 3") != 0;
    expect(";");
    if (Signal* of = find(id, signal); of != nullptr) of->is_float = is_float;
  }

  // VAL_ 385 State 0 "sound" 1 "zeroing" ; or of an environment variable, without the number.
  void parse_words() {
    ++at_;
    const bool is_of_signal = at_ < tokens_.size() && tokens_[at_].text.front() <= '9';
    if (!is_of_signal) return skip_section();
    const auto id = number<std::uint32_t>("a message's identifier");
    Signal* const of = find(id, name("a signal's name"));
    while (!is_next(";")) {
      const auto value = number<std::int64_t>("a value");
      const Token& word = next("a word");
      if (!word.is_string) throw Refused(word.line, "expected a word in quotes");
      if (of != nullptr) of->words[value] = word.text;
    }
    ++at_;
  }

  // A signal by its name; null if it is of a message that is not read.
  Signal* find(std::uint32_t id, const std::string& signal) {
    for (Message& message : database_.messages) {
      if ((message.id | (message.is_extended ? extended_flag : 0)) != id) continue;
      const auto found = std::ranges::find(message.signals, signal, &Signal::name);
      if (found != message.signals.end()) return &*found;
    }
    return nullptr;
  }

  std::vector<Token> tokens_;
  std::size_t at_ = 0;
  Database database_;
  Message* message_ = nullptr;                         // whose signals follow
  std::vector<std::pair<int, std::string>> selected_;  // of its signals, with their lines
  bool has_selecting_ = false;                         // one of them, also if it was refused
  bool is_passed_over_ = false;                        // nor are signals that follow
  std::vector<ConfigFault> faults_;
};

}  // namespace

std::variant<Database, std::vector<ConfigFault>> parse(std::string_view text) {
  try {
    return Parser(text).parse();
  } catch (const Refused& refused) {
    return std::vector<ConfigFault>{{refused.line, "", refused.what()}};
  }
}

}  // namespace rvbench::hal::dbc
