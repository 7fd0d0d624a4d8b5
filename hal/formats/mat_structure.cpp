#include "hal/formats/mat_structure.hpp"

#include <algorithm>
#include <cctype>

#include "hal/formats/facts.hpp"

namespace rvbench::hal::formats {
namespace {

constexpr const char* of_all = "recording";
constexpr std::size_t longest_name = 63;  // of a MATLAB variable (namelengthmax)

Facts facts_in(const MatStructure& structure) {
  Facts facts;
  facts.texts = structure.texts;
  for (const auto& [name, values] : structure.numbers) {
    if (values.size() == 1) facts.numbers[name] = values(0, 0);
  }
  return facts;
}

void add(const Facts& facts, MatStructure& structure) {
  for (const auto& [name, value] : facts.numbers) {
    structure.numbers[name] = Eigen::MatrixXd::Constant(1, 1, value);
  }
  for (const auto& [name, text] : facts.texts) structure.texts[name] = text;
}

// What MATLAB takes as a variable: a letter, then letters, digits and underscores.
std::string variable_name(const std::string& name, const std::vector<MatStructure>& others) {
  std::string own;
  for (const char c : name) {
    const bool fits = std::isalnum(static_cast<unsigned char>(c)) != 0;
    own += fits ? c : '_';
  }
  if (own.empty() || std::isalpha(static_cast<unsigned char>(own.front())) == 0) own = "c_" + own;
  own.resize(std::min(own.size(), longest_name - 4));  // room for a number
  const auto is_taken = [&others](const std::string& text) {
    return text == of_all || std::ranges::find(others, text, &MatStructure::name) != others.end();
  };
  std::string free = own;
  for (int n = 2; is_taken(free); ++n) free = own + "_" + std::to_string(n);
  return free;
}

}  // namespace

std::vector<MatStructure> mat_structures(const Recording& recording) {
  std::vector<MatStructure> structures;
  for (const Channel& channel : recording.channels) {
    MatStructure structure;
    structure.name = variable_name(channel.info.name, structures);
    add(facts_of(channel), structure);
    structure.texts["name"] = channel.info.name;
    if (!channel.info.unit.empty()) structure.texts["unit"] = channel.info.unit;
    structure.numbers["rate_Hz"] = Eigen::MatrixXd::Constant(1, 1, channel.rate_Hz);
    structure.numbers["data"] = channel.samples;
    structures.push_back(std::move(structure));
  }
  MatStructure all;
  all.name = of_all;
  add(facts_of(recording), all);
  structures.push_back(std::move(all));
  return structures;
}

std::optional<Channel> channel_in(const MatStructure& structure) {
  const auto data = structure.numbers.find("data");
  const auto rate = structure.numbers.find("rate_Hz");
  if (data == structure.numbers.end() || rate == structure.numbers.end()) return std::nullopt;
  const Eigen::MatrixXd& values = data->second;
  const bool is_signal = values.size() > 0 && std::min(values.rows(), values.cols()) == 1;
  if (!is_signal || rate->second.size() != 1 || !(rate->second(0, 0) > 0)) return std::nullopt;
  Channel channel;
  channel.info.name = structure.name;
  channel.rate_Hz = rate->second(0, 0);
  channel.samples = values.reshaped();
  channel.samples = channel.samples.array().isFinite().select(channel.samples, not_known);
  const Facts facts = facts_in(structure);
  apply(facts, channel);
  const auto name = facts.texts.find("name"), unit = facts.texts.find("unit");
  if (name != facts.texts.end() && !name->second.empty()) channel.info.name = name->second;
  if (unit != facts.texts.end()) channel.info.unit = unit->second;
  return channel;
}

bool take_recording(const MatStructure& structure, Recording& recording) {
  if (structure.name != of_all) return false;
  apply(facts_in(structure), recording);
  return true;
}

}  // namespace rvbench::hal::formats
