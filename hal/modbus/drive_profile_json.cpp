#include "hal/modbus/drive_profile_json.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "hal/did_you_mean.hpp"
#include "hal/drive_files.hpp"

namespace rvbench::hal {
namespace {

constexpr std::array all_states{DriveState::not_ready,      DriveState::inhibited,
                                DriveState::ready,          DriveState::switched_on,
                                DriveState::running,        DriveState::quick_stop,
                                DriveState::fault_reaction, DriveState::fault};
constexpr Bounds scales{1e-9, 1e9};

// Reads one profile. Registers are written as the manual of the family writes them; "addressing"
// says how that is, and has no default: being off by one is the commonest fault of all.
class ProfileReader {
 public:
  explicit ProfileReader(ConfigReader root) : root_(std::move(root)) {}

  DriveProfile read() {
    DriveProfile profile;
    profile.name = root_.text("name");
    profile.about = root_.text("about");
    addressing_ = root_.choice("addressing", {"pdu", "4x", "one_based"});
    for (ConfigReader& at : root_.objects("sources")) {
      sources_.push_back(at.text("name"));
      at.text("title");
    }
    profile.reads_blocks = root_.boolean("reads_blocks", true);
    profile.writes_blocks = root_.boolean("writes_blocks", true);
    profile.turnaround_s = root_.number("turnaround_s", {0, 1}, 0);
    profile.identity = patterns(root_, "identity", false);
    profile.pole_pairs = optional_number("pole_pairs");
    read_states(profile);
    read_commands(profile);
    profile.reference = reference();
    ConfigReader output = root_.object("output_frequency");
    profile.output_frequency = {number(output, "output_frequency"), unit(output)};
    profile.speed_rpm = optional_number("speed_rpm");
    const bool tells_magnitudes =
        !profile.output_frequency.is_signed || (profile.speed_rpm && !profile.speed_rpm->is_signed);
    if (profile.is_reverse && !tells_magnitudes) {
      root_.fault("is_reverse", "has no effect: output frequency and speed are signed");
    }
    profile.current_A = optional_number("current_A");
    profile.fault_code = optional_number("fault_code");
    read_watchdog(profile);
    read_writable(profile);
    profile.unverified = std::move(unverified_);
    root_.finish();
    return profile;
  }

  const std::vector<ConfigFault>& faults() const { return root_.faults(); }

 private:
  // A number of up to 16 bits, as the manuals print them: "0x2101" or "40004".
  int number_at(ConfigReader& at, std::string_view key, const std::string& text) {
    const bool hex = text.starts_with("0x");
    const char* const begin = text.data() + (hex ? 2 : 0);
    const char* const end = text.data() + text.size();
    int value = 0;
    const auto [stop, error] = std::from_chars(begin, end, value, hex ? 16 : 10);
    if (error == std::errc() && stop == end && begin != end && value >= 0) return value;
    at.fault(key, "expected a number such as \"0x2101\" or \"40004\", not " + in_quotes(text));
    return 0;
  }

  std::uint16_t word(ConfigReader& at, std::string_view key, std::string fallback = "") {
    const std::string text = fallback.empty() ? at.text(key) : at.text(key, std::move(fallback));
    const int value = number_at(at, key, text);
    if (value > 0xFFFF) at.fault(key, text + " does not fit into 16 bits");
    return static_cast<std::uint16_t>(value);
  }

  std::uint16_t wire_address(ConfigReader& at, std::string_view key, const std::string& text) {
    const int printed = number_at(at, key, text);
    int address = printed;
    if (addressing_ == "one_based") address = printed - 1;
    if (addressing_ == "4x") address = printed - (printed >= 400001 ? 400001 : 40001);
    if (address >= 0 && address <= 0xFFFF) return static_cast<std::uint16_t>(address);
    at.fault(key, "there is no register " + text + " where the addressing is " + addressing_);
    return 0;
  }

  std::uint16_t address(ConfigReader& at) {
    return wire_address(at, "register", at.text("register"));
  }

  // Where a value comes from; one that was found only once says so.
  void source(ConfigReader& at, const std::string& what) {
    const std::string name = at.text("source");
    if (!name.empty() && std::ranges::find(sources_, name) == sources_.end()) {
      at.fault("source", in_quotes(name) + " is not among \"sources\"");
    }
    if (!at.boolean("verified", true)) unverified_.push_back(what);
  }

  DriveRegister number(ConfigReader& at, const std::string& what) {
    DriveRegister number;
    number.address = address(at);
    number.words = at.integer("words", {1, 2}, 1);
    number.mask = word(at, "mask", "0xFFFF");
    number.is_signed = at.boolean("signed", false);
    number.scale = at.number("scale", scales, 1);
    source(at, what);
    if (number.words == 2 && at.has("mask")) {
      at.fault("mask", "has no effect: of two words all bits are taken");
    }
    if (number.is_signed && (number.mask & 0x8000U) == 0) {
      at.fault("signed", "has no effect: \"mask\" leaves no sign");
    }
    return number;
  }

  std::optional<DriveRegister> optional_number(const std::string& key) {
    auto at = root_.optional_object(key);
    if (!at) return std::nullopt;
    return number(*at, key);
  }

  DriveProfile::FrequencyUnit unit(ConfigReader& at) {
    using enum DriveProfile::FrequencyUnit;
    const std::string unit = at.choice("unit", {"Hz", "rpm", "of_rated"});
    return unit == "rpm" ? rpm : unit == "of_rated" ? of_rated : Hz;
  }

  // The only number that is written, and always as one whole register.
  DriveProfile::Frequency reference() {
    ConfigReader at = root_.object("reference");
    DriveProfile::Frequency reference;
    reference.address = address(at);
    reference.unit = unit(at);
    reference.is_signed = at.boolean("signed", false);
    reference.scale = at.number("scale", scales, 1);
    source(at, "reference");
    for (const char* const key : {"words", "mask"}) {
      if (at.has(key)) at.fault(key, "has no effect: the reference is written as one whole word");
    }
    return reference;
  }

  DrivePattern pattern(ConfigReader& at, const std::string& what) {
    DrivePattern pattern;
    pattern.address = address(at);
    pattern.mask = word(at, "mask", "0xFFFF");
    pattern.is_not = at.has("is_not");
    const char* const key = pattern.is_not ? "is_not" : "is";
    pattern.value = word(at, key);
    if ((pattern.value & ~pattern.mask) != 0) at.fault(key, "has bits outside of \"mask\"");
    source(at, what);
    return pattern;
  }

  std::vector<DrivePattern> patterns(ConfigReader& in, const std::string& key, bool required) {
    std::vector<DrivePattern> all;
    for (ConfigReader& at : in.objects(key, required)) all.push_back(pattern(at, key));
    return all;
  }

  DriveState state(ConfigReader& at, std::string_view key) {
    std::vector<std::string_view> words;
    for (const DriveState one : all_states) words.emplace_back(to_string(one));
    const std::string word = at.choice(key, words);
    const auto found = std::ranges::find(words, word);
    return all_states[static_cast<std::size_t>(found == words.end() ? 0 : found - words.begin())];
  }

  void read_states(DriveProfile& profile) {
    for (ConfigReader& at : root_.objects("states")) {
      const DriveState is = state(at, "state");
      profile.states.push_back({is, pattern(at, std::string("state ") + to_string(is))});
    }
    for (const DriveState needed : {DriveState::ready, DriveState::running, DriveState::fault}) {
      const bool told = std::ranges::any_of(
          profile.states, [needed](const DriveProfile::State& one) { return one.is == needed; });
      if (!told) root_.fault("states", std::string("none of them is ") + to_string(needed));
    }
    profile.never = patterns(root_, "never", false);
    if (auto at = root_.optional_object("is_remote")) profile.is_remote = pattern(*at, "is_remote");
    if (auto at = root_.optional_object("is_reverse")) {
      profile.is_reverse = pattern(*at, "is_reverse");
    }
  }

  void read_commands(DriveProfile& profile) {
    ConfigReader control = root_.object("control");
    profile.control = address(control);
    profile.forward = word(control, "forward");
    profile.reverse = word(control, "reverse");
    profile.stop = word(control, "stop");
    source(control, "control");
    for (ConfigReader& at : root_.objects("steps", false)) {
      const DriveState from = state(at, "from");
      check_step(profile, from, at);
      profile.steps.push_back({from, word(at, "word"), at.number("wait_s", {0, 10}, 0)});
      source(at, std::string("step from ") + to_string(from));
    }
    for (ConfigReader& at : root_.objects("reset")) {
      profile.reset.push_back({address(at), word(at, "word")});
      source(at, "reset");
    }
  }

  // A step that would never be taken.
  void check_step(const DriveProfile& profile, DriveState from, ConfigReader& at) {
    const auto is_known = [from](const auto& all, auto state) {
      return std::ranges::find(all, from, state) != all.end();
    };
    const char* why = nullptr;
    if (from == DriveState::running) why = "it runs already";
    if (from == DriveState::fault || from == DriveState::fault_reaction) why = "it has tripped";
    if (from != DriveState::not_ready && !is_known(profile.states, &DriveProfile::State::is)) {
      why = "none of \"states\" is that";
    }
    if (is_known(profile.steps, &DriveProfile::Step::from)) why = "an earlier step is taken";
    if (why != nullptr) at.fault("from", std::string("has no effect: ") + why);
  }

  void read_watchdog(DriveProfile& profile) {
    auto at = root_.optional_object("watchdog");
    if (!at) return;
    DriveProfile::Watchdog watchdog;
    ConfigReader timeout = at->object("timeout_s");
    watchdog.timeout_s = number(timeout, "watchdog time-out");
    if (auto action = at->optional_object("action")) {
      for (const double stopping : action->numbers("stops", {0, 65535})) {
        if (std::trunc(stopping) != stopping) action->fault("stops", "expected whole numbers");
        watchdog.stopping_actions.push_back(static_cast<int>(stopping));
      }
      watchdog.action = number(*action, "watchdog action");
    }
    profile.watchdog = std::move(watchdog);
  }

  void read_writable(DriveProfile& profile) {
    for (const std::string& text : root_.texts("writable")) {
      profile.writable.push_back(wire_address(root_, "writable", text));
    }
    const auto allowed = [&](std::uint16_t at) {
      return std::ranges::find(profile.writable, at) != profile.writable.end();
    };
    const char* const why = "its register is not among \"writable\"";
    if (!allowed(profile.control)) root_.fault("control", why);
    if (!allowed(profile.reference.address)) root_.fault("reference", why);
    for (const DriveWrite& write : profile.reset) {
      if (!allowed(write.address)) root_.fault("reset", why);
    }
  }

  ConfigReader root_;
  std::string addressing_;
  std::vector<std::string> sources_;
  std::vector<std::string> unverified_;
};

std::variant<DriveProfile, std::vector<ConfigFault>> read_from(ConfigReader root) {
  ProfileReader reader(std::move(root));
  DriveProfile profile = reader.read();
  if (!reader.faults().empty()) return reader.faults();
  return profile;
}

}  // namespace

std::vector<std::string> drive_names() {
  std::vector<std::string> names;
  for (const EmbeddedFile& file : drive_files()) names.push_back(file.name);
  return names;
}

std::variant<DriveProfile, std::vector<ConfigFault>> read_drive_profile(const std::string& drive) {
  for (const EmbeddedFile& file : drive_files()) {
    if (file.name == drive) return read_from(ConfigReader::from_text(file.text, drive));
  }
  if (!std::filesystem::exists(drive)) {
    return std::vector<ConfigFault>{
        {0, "",
         "cannot be read: No such file or built-in drive" + what_there_is(drive, drive_names())}};
  }
  return read_from(ConfigReader::from_file(drive));
}

DriveProfile drive_profile(const std::string& name) {
  const auto read = read_drive_profile(name);
  if (read.index() == 0) return std::get<0>(read);
  throw std::invalid_argument("drive_profile: " + describe(name, std::get<1>(read).front()));
}

}  // namespace rvbench::hal
