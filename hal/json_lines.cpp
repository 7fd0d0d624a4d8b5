#include "hal/json_lines.hpp"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

namespace rvbench::hal {
namespace {

constexpr std::size_t max_depth = 64;
constexpr std::size_t max_key_bytes = 200;
constexpr std::size_t max_members = 10000;

// Where the parser is. The lexer reads one character beyond a number: blanks do not count, so
// the line is still that of the number.
struct Place {
  int newlines = 0;
  int token_line = 1;

  void pass(char c) {
    if (c == '\n') {
      ++newlines;
    } else if (c != ' ' && c != '\t' && c != '\r') {
      token_line = newlines + 1;
    }
  }
};

class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, Place* place) : at_(at), place_(place) {}
  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    place_->pass(*at_++);
    return *this;
  }
  bool operator==(const CountingIterator& other) const { return at_ == other.at_; }
  bool operator!=(const CountingIterator& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  Place* place_;
};

// "[json.exception...] parse error at line 3, column 5: syntax error while ..." → its last part.
std::string explain(std::string what, const std::string& last_token) {
  if (const auto at = what.find("] "); at != std::string::npos) what.erase(0, at + 2);
  const auto at = what.find(": ");
  if (what.starts_with("parse error") && at != std::string::npos) what.erase(0, at + 2);
  if (what.size() > 200) what = what.substr(0, 200) + " ...";
  const bool closes_early = what.find("unexpected '}'") != std::string::npos ||
                            what.find("unexpected ']'") != std::string::npos;
  const auto letter = last_token.find_last_not_of(" \t\r\n");
  if (closes_early) what += " (a comma too many?)";
  if (letter != std::string::npos && (last_token[letter] == 'N' || last_token[letter] == 'I')) {
    what += " (NaN and Infinity are not allowed)";
  }
  return what;
}

// Builds the tree from the parser's events.
class TreeBuilder : public nlohmann::json_sax<nlohmann::json> {
 public:
  TreeBuilder(JsonTree& tree, const Place& place) : tree_(tree), place_(place) {}

  bool null() override { return add(JsonNode::Kind::null); }
  bool boolean(bool value) override { return add(JsonNode::Kind::boolean, value ? 1 : 0); }
  bool number_integer(number_integer_t value) override { return number(double(value)); }
  bool number_unsigned(number_unsigned_t value) override { return number(double(value)); }
  bool number_float(number_float_t value, const string_t&) override { return number(value); }
  bool string(string_t& value) override { return add(JsonNode::Kind::text, 0, std::move(value)); }
  bool binary(binary_t&) override { return false; }  // no such thing in JSON text
  bool start_object(std::size_t) override { return open(JsonNode::Kind::object); }
  bool start_array(std::size_t) override { return open(JsonNode::Kind::array); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& value) override {
    if (value.size() > max_key_bytes) {
      return refuse("a key is longer than " + std::to_string(max_key_bytes) + " bytes");
    }
    Level& level = open_.back();
    if (level.seen.size() == max_members) {
      return refuse("an object with more than " + std::to_string(max_members) + " keys");
    }
    level.skip_next = !level.seen.insert(value).second;
    level.key = std::move(value);
    if (level.skip_next) {
      tree_.faults.push_back(
          {place_.token_line, pointer(), "duplicate key: the first one stands further up"});
    }
    return true;
  }

  bool parse_error(std::size_t, const std::string& last_token,
                   const nlohmann::json::exception& error) override {
    return refuse(explain(error.what(), last_token));
  }

 private:
  struct Level {
    JsonNode node;
    std::string key;             // of the value to come, if this is an object
    std::set<std::string> seen;  // its keys so far
    bool skip_next = false;
  };

  bool number(double value) { return add(JsonNode::Kind::number, value); }

  bool add(JsonNode::Kind kind, double value = 0, std::string text = {}) {
    return put({kind, place_.token_line, value, std::move(text), {}, {}});
  }

  bool open(JsonNode::Kind kind) {
    if (open_.size() == max_depth) {
      return refuse("nested deeper than " + std::to_string(max_depth) + " levels");
    }
    open_.emplace_back();
    open_.back().node.kind = kind;
    open_.back().node.line = place_.token_line;
    return true;
  }

  bool close() {
    JsonNode node = std::move(open_.back().node);
    open_.pop_back();
    return put(std::move(node));
  }

  bool put(JsonNode node) {
    if (open_.empty()) {
      tree_.root = std::move(node);
      return true;
    }
    Level& level = open_.back();
    if (level.skip_next) {
      level.skip_next = false;
      return true;
    }
    if (level.node.kind == JsonNode::Kind::object) level.node.keys.push_back(level.key);
    level.node.items.push_back(std::move(node));
    return true;
  }

  std::string pointer() const {
    std::string path;
    for (const Level& level : open_) {
      path = json_pointer(path, level.node.kind == JsonNode::Kind::object
                                    ? level.key
                                    : std::to_string(level.node.items.size()));
    }
    return path;
  }

  bool refuse(std::string message) {
    tree_.faults.push_back({place_.token_line, "", std::move(message)});
    return false;
  }

  JsonTree& tree_;
  const Place& place_;
  std::vector<Level> open_;
};

}  // namespace

const JsonNode* JsonNode::find(std::string_view key) const {
  const auto at = std::find(keys.begin(), keys.end(), key);
  return at == keys.end() ? nullptr : &items[std::size_t(at - keys.begin())];
}

JsonTree parse_json_lines(std::string_view text) {
  JsonTree tree;
  if (text.size() > max_config_bytes) {
    tree.faults.push_back({0, "", "larger than 4 MiB: not a configuration file"});
    return tree;
  }
  if (text.empty()) {
    tree.faults.push_back({1, "", "is empty"});
    return tree;
  }
  Place place;
  TreeBuilder builder(tree, place);
  tree.complete =
      nlohmann::json::sax_parse(CountingIterator(text.data(), &place),
                                CountingIterator(text.data() + text.size(), &place), &builder);
  return tree;
}

std::string json_pointer(const std::string& parent, std::string_view key) {
  std::string path = parent + '/';
  for (const char c : key) {
    if (c == '~') {
      path += "~0";
    } else if (c == '/') {
      path += "~1";
    } else {
      path += c;
    }
  }
  return path;
}

}  // namespace rvbench::hal
