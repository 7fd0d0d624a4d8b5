#include "hal/config_reader.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "hal/did_you_mean.hpp"
#include "hal/formats/printable.hpp"
#include "hal/json_lines.hpp"

namespace rvbench::hal {

using Kind = JsonNode::Kind;

struct ConfigReader::Document {
  std::filesystem::path file;
  JsonTree tree;
  std::vector<ConfigFault> faults;

  void note(ConfigFault fault) {
    const auto after =
        std::upper_bound(faults.begin(), faults.end(), fault.line,
                         [](int line, const ConfigFault& other) { return line < other.line; });
    faults.insert(after, std::move(fault));
  }
};

struct ConfigReader::Node {
  const JsonNode* json = nullptr;  // null: a stand-in for what is missing or of the wrong kind
  std::string pointer;
  std::set<std::string, std::less<>> known;  // keys asked for
  std::map<const JsonNode*, std::shared_ptr<Node>> children;
  bool finished = false;

  const JsonNode* ask(std::string_view key) {
    known.emplace(key);
    return json == nullptr ? nullptr : json->find(key);
  }
  std::vector<std::string> keys() const { return json ? json->keys : std::vector<std::string>(); }
  std::string place(std::string_view key) const { return json_pointer(pointer, key); }
  std::string place(std::string_view key, std::size_t i) const {
    return json_pointer(place(key), std::to_string(i));
  }
  std::shared_ptr<Node> child(const JsonNode& at, std::string where) {
    auto& node = children[&at];  // one for all readers of a place: they know the same keys
    if (!node) node = std::make_shared<Node>(Node{&at, std::move(where), {}, {}, false});
    return node;
  }
};

namespace {

std::string show(double value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

std::string show(const JsonNode& json) {
  switch (json.kind) {
    case Kind::null: return "null";
    case Kind::boolean: return json.number != 0 ? "true" : "false";
    case Kind::number: return show(json.number);
    case Kind::text: return in_quotes(json.text);
    case Kind::array: return "an array";
    case Kind::object: return "an object";
  }
  return {};
}

// What is wrong with a number, or nothing.
std::string number_fault(const JsonNode& json, Bounds bounds) {
  if (json.kind != Kind::number) return "expected a number, found " + show(json);
  if (json.number < bounds.min) return show(json.number) + " is below " + show(bounds.min);
  if (json.number > bounds.max) return show(json.number) + " is above " + show(bounds.max);
  return {};
}

std::string integer_fault(const JsonNode& json, Bounds bounds) {
  if (json.kind == Kind::number && json.number != std::floor(json.number)) {
    return "expected a whole number, found " + show(json);
  }
  return number_fault(json, {std::max(bounds.min, double(std::numeric_limits<int>::min())),
                             std::min(bounds.max, double(std::numeric_limits<int>::max()))});
}

}  // namespace

std::string describe(const std::filesystem::path& file, const ConfigFault& fault) {
  std::string text =
      file.string() + (fault.line > 0 ? ':' + std::to_string(fault.line) : "") + ": ";
  if (!fault.pointer.empty()) text += fault.pointer + ": ";
  return text + fault.message;
}

ConfigReader::ConfigReader(std::shared_ptr<Document> document, std::shared_ptr<Node> node)
    : document_(std::move(document)), node_(std::move(node)) {}

ConfigReader ConfigReader::from_file(const std::filesystem::path& file) {
  std::error_code ignored;
  const bool is_folder = std::filesystem::is_directory(file, ignored);
  std::string problem = is_folder ? "it is a folder" : "it is no regular file";  // pipes block
  if (!std::filesystem::exists(file, ignored) || std::filesystem::is_regular_file(file, ignored)) {
    if (std::ifstream in(file, std::ios::binary); in) {
      std::string text(max_config_bytes + 1, '\0');  // one too many: the parser will say so
      in.read(text.data(), std::streamsize(text.size()));
      return from_text(std::string_view(text).substr(0, std::size_t(in.gcount())), file);
    }
    problem = std::strerror(errno);
  }
  const auto document = std::make_shared<Document>(Document{file, {}, {}});
  document->note({0, "", "cannot be read: " + problem});
  return {document, std::make_shared<Node>()};
}

ConfigReader ConfigReader::from_text(std::string_view text, std::filesystem::path shown_as) {
  const auto document =
      std::make_shared<Document>(Document{std::move(shown_as), parse_json_lines(text), {}});
  for (const ConfigFault& fault : document->tree.faults) document->note(fault);
  auto node = std::make_shared<Node>();
  const JsonNode& root = document->tree.root;
  if (document->tree.complete && root.kind == Kind::object) {
    node->json = &root;
  } else if (document->tree.complete) {
    document->note({root.line, "", "expected an object, found " + show(root)});
  }
  return {document, node};
}

bool ConfigReader::has(std::string_view key) const { return node_->ask(key) != nullptr; }

bool ConfigReader::is_text(std::string_view key) const {
  return has(key) && node_->json->find(key)->kind == Kind::text;
}

void ConfigReader::require(std::string_view key) {
  if (!has(key)) fault(key, "this key is missing");
}

double ConfigReader::number(std::string_view key, Bounds bounds) {
  require(key);
  return number(key, bounds, bounds.min);
}
double ConfigReader::number(std::string_view key, Bounds bounds, double fallback) {
  const JsonNode* json = node_->ask(key);
  if (json == nullptr) return fallback;
  const std::string wrong = number_fault(*json, bounds);
  if (wrong.empty()) return json->number;
  fault(key, wrong);
  return fallback;
}

int ConfigReader::integer(std::string_view key, Bounds bounds) {
  require(key);
  return integer(key, bounds, int(bounds.min));
}
int ConfigReader::integer(std::string_view key, Bounds bounds, int fallback) {
  const JsonNode* json = node_->ask(key);
  if (json == nullptr) return fallback;
  const std::string wrong = integer_fault(*json, bounds);
  if (wrong.empty()) return int(json->number);
  fault(key, wrong);
  return fallback;
}

bool ConfigReader::boolean(std::string_view key, bool fallback) {
  const JsonNode* json = node_->ask(key);
  if (json == nullptr) return fallback;
  if (json->kind == Kind::boolean) return json->number != 0;
  fault(key, "expected true or false, found " + show(*json));
  return fallback;
}

std::string ConfigReader::text(std::string_view key) {
  require(key);
  std::string value = text(key, "?");
  if (value.empty()) fault(key, "must not be empty");
  return value;
}
std::string ConfigReader::text(std::string_view key, std::string fallback) {
  const JsonNode* json = node_->ask(key);
  if (json == nullptr) return fallback;
  if (json->kind == Kind::text) {
    if (formats::has_control_character(json->text)) fault(key, "holds a control character");
    return json->text;
  }
  fault(key, "expected a text, found " + show(*json));
  return fallback;
}

std::string ConfigReader::choice(std::string_view key,
                                 const std::vector<std::string_view>& allowed) {
  require(key);
  return choice(key, allowed, std::string(allowed.front()));
}

std::string ConfigReader::choice(std::string_view key, const std::vector<std::string_view>& allowed,
                                 std::string fallback) {
  const JsonNode* json = node_->ask(key);
  if (json == nullptr) return fallback;
  if (json->kind == Kind::text &&
      std::find(allowed.begin(), allowed.end(), json->text) != allowed.end()) {
    return json->text;
  }
  std::string list, hint;
  for (const std::string_view word : allowed) list += (list.empty() ? "" : ", ") + in_quotes(word);
  if (json->kind == Kind::text) hint = did_you_mean(json->text, {allowed.begin(), allowed.end()});
  fault(key, "expected one of " + list + "; found " + show(*json) + hint);
  return fallback;
}

// Of an array that is required and must not be empty; none where it is not so, with the fault.
const std::vector<JsonNode>& ConfigReader::items(std::string_view key, const char* of) {
  static const std::vector<JsonNode> none;
  const JsonNode* json = node_->ask(key);
  require(key);
  if (json == nullptr) return none;
  if (json->kind != Kind::array) {
    fault(key, std::string("expected an array of ") + of + ", found " + show(*json));
    return none;
  }
  if (json->items.empty()) fault(key, "must not be empty");
  return json->items;
}

std::vector<double> ConfigReader::numbers(std::string_view key, Bounds bounds) {
  std::vector<double> values;
  for (const JsonNode& item : items(key, "numbers")) {
    const std::string wrong = number_fault(item, bounds);
    if (!wrong.empty()) document_->note({item.line, node_->place(key, values.size()), wrong});
    values.push_back(wrong.empty() ? item.number : bounds.min);
  }
  return values.empty() ? std::vector<double>{bounds.min} : values;
}

std::vector<std::string> ConfigReader::texts(std::string_view key) {
  std::vector<std::string> values;
  for (const JsonNode& item : items(key, "texts")) {
    if (item.kind != Kind::text) {
      document_->note(
          {item.line, node_->place(key, values.size()), "expected a text, found " + show(item)});
    }
    values.push_back(item.text);
  }
  return values;
}

ConfigReader ConfigReader::object(std::string_view key) {
  require(key);
  if (auto found = optional_object(key)) return *found;
  return {document_, std::make_shared<Node>()};
}

std::optional<ConfigReader> ConfigReader::optional_object(std::string_view key) {
  const JsonNode* json = node_->ask(key);
  if (json == nullptr) return std::nullopt;
  if (json->kind == Kind::object) {
    return ConfigReader(document_, node_->child(*json, node_->place(key)));
  }
  fault(key, "expected an object, found " + show(*json));
  return std::nullopt;
}

std::vector<ConfigReader> ConfigReader::objects(std::string_view key, bool required) {
  const JsonNode* json = node_->ask(key);
  std::vector<ConfigReader> readers;
  if (required) require(key);
  if (json == nullptr) return readers;
  if (json->kind != Kind::array) {
    fault(key, "expected an array of objects, found " + show(*json));
  } else {
    for (std::size_t i = 0; i < json->items.size(); ++i) {
      const JsonNode& item = json->items[i];
      const std::string place = node_->place(key, i);
      if (item.kind == Kind::object) {
        readers.push_back({document_, node_->child(item, place)});
      } else {
        document_->note({item.line, place, "expected an object, found " + show(item)});
      }
    }
  }
  return readers;
}

std::vector<std::pair<std::string, ConfigReader>> ConfigReader::members() {
  std::vector<std::pair<std::string, ConfigReader>> readers;
  for (const std::string& key : node_->keys()) {
    if (auto reader = optional_object(key)) readers.emplace_back(key, *reader);
  }
  return readers;
}

void ConfigReader::fault(std::string_view key, std::string message) {
  if (node_->json == nullptr) return;  // the stand-in itself was a fault already
  const JsonNode* at = key.empty() ? node_->json : node_->json->find(key);
  document_->note({at == nullptr ? node_->json->line : at->line,
                   key.empty() ? node_->pointer : node_->place(key), std::move(message)});
}

void ConfigReader::disregard() { node_->finished = true; }
void ConfigReader::finish() {
  for (const auto& child : node_->children) ConfigReader(document_, child.second).finish();
  if (std::exchange(node_->finished, true)) return;
  const std::vector<std::string> words(node_->known.begin(), node_->known.end());
  for (const std::string& key : node_->keys()) {
    if (!node_->known.contains(key)) fault(key, "unknown key" + did_you_mean(key, words));
  }
}

const std::vector<ConfigFault>& ConfigReader::faults() const { return document_->faults; }
const std::filesystem::path& ConfigReader::file() const { return document_->file; }

}  // namespace rvbench::hal
