#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rvbench::hal {

struct JsonNode;

/// One thing wrong in a configuration file.
struct ConfigFault {
  int line = 0;         ///< 1-based; 0 if the file could not be read at all
  std::string pointer;  ///< JSON pointer of the place: "/main/0/speeds_rpm/2"
  std::string message;  ///< "9000 is above 6000", "unknown key, did you mean \"speeds_rpm\"?"
};

/// "quick.json:14: /main/0/speed_rpm: 9000 is above the drive's 6000"
std::string describe(const std::filesystem::path& file, const ConfigFault& fault);

/// Inclusive bounds of a number, with the unit in the key.
struct Bounds {
  double min;
  double max;
};

/// Reads a JSON file key by key and collects every fault instead of stopping at the first.
///
/// Each getter returns the value, or a stand-in (`fallback`, or the lower bound) after noting a
/// fault; check faults() at the end. Keys never asked for are faults too: finish() adds them, with
/// the nearest known key as a suggestion. NaN and Infinity are refused, duplicate keys too.
///
///     ConfigReader root = ConfigReader::from_file("plan.json");
///     plan.name = root.text("name");
///     ConfigReader settling = root.object("settling");
///     plan.band_pct = settling.number("speed_band_pct", {0.01, 50}, 0.5);
///     root.finish();
///     if (!root.faults().empty()) ...
///
/// A reader is a view of one JSON object or array; children share the root's list of faults.
class ConfigReader {
 public:
  static ConfigReader from_file(const std::filesystem::path& file);
  static ConfigReader from_text(std::string_view text, std::filesystem::path shown_as);

  bool has(std::string_view key) const;      ///< marks the key as known
  bool is_text(std::string_view key) const;  ///< likewise; for keys that take a number or a word

  double number(std::string_view key, Bounds bounds);  ///< required
  double number(std::string_view key, Bounds bounds, double fallback);
  int integer(std::string_view key, Bounds bounds);
  int integer(std::string_view key, Bounds bounds, int fallback);
  bool boolean(std::string_view key, bool fallback);
  std::string text(std::string_view key);
  std::string text(std::string_view key, std::string fallback);
  std::string choice(std::string_view key, const std::vector<std::string_view>& allowed);
  std::string choice(std::string_view key, const std::vector<std::string_view>& allowed,
                     std::string fallback);
  std::vector<double> numbers(std::string_view key, Bounds bounds);  ///< required, not empty
  std::vector<std::string> texts(std::string_view key);              ///< required, not empty

  /// A required object; an empty stand-in after noting a fault.
  ConfigReader object(std::string_view key);
  std::optional<ConfigReader> optional_object(std::string_view key);
  /// The objects of an array, in order; empty if the key is absent and not required.
  std::vector<ConfigReader> objects(std::string_view key, bool required = true);
  /// All keys of this object with their objects: for maps such as {"pump": {...}, "fan": {...}}.
  std::vector<std::pair<std::string, ConfigReader>> members();

  /// Notes a fault at `key` of this object ("" for the object itself).
  void fault(std::string_view key, std::string message);

  /// Leaves the other keys of this object unchecked: without its kind nobody can tell.
  void disregard();

  /// Adds a fault for each key of this object, and of all children read, that nobody asked for.
  void finish();
  const std::vector<ConfigFault>& faults() const;  ///< of the whole file, in order of lines
  const std::filesystem::path& file() const;

 private:
  struct Document;
  struct Node;
  ConfigReader(std::shared_ptr<Document> document, std::shared_ptr<Node> node);
  void require(std::string_view key);
  const std::vector<JsonNode>& items(std::string_view key, const char* of);

  std::shared_ptr<Document> document_;
  std::shared_ptr<Node> node_;
};

}  // namespace rvbench::hal
