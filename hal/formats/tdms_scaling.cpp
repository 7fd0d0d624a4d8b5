#include "hal/formats/tdms_scaling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rvbench::hal::formats {
namespace {

using Values = std::variant<std::vector<double>, std::string>;

constexpr int most_scalings = 64;  // of one channel; each may ask for two others
constexpr double most_coefficients = 1000;

class Scalings {
 public:
  explicit Scalings(const TdmsChannel& channel) : channel_(channel) {}

  // What scaling `id` gives or, if there is none of that number, the raw values that have it.
  Values values_of(std::uint32_t id) {
    const std::string type = text_in(channel_.properties, key(id, "Scale_Type"));
    if (type.empty()) return raw(id);
    if (++used_ > most_scalings) return "its scalings ask for each other";
    if (type == "Linear") return linear(id);
    if (type == "Polynomial") return polynomial(id);
    if (type == "Table") return table(id);
    if (type == "Add" || type == "Subtract") return combined(id, type, type == "Add" ? 1 : -1);
    if (type == "AdvancedAPI") return input(id, "AdvancedAPI_Input_Source");  // does nothing
    return fmt::format("a scaling of the kind {} is not known", type);
  }

 private:
  static std::string key(std::uint32_t id, const std::string& what) {
    return fmt::format("NI_Scale[{}]_{}", id, what);
  }
  std::optional<double> number(std::uint32_t id, const std::string& what) const {
    return number_in(channel_.properties, key(id, what));
  }

  Values raw(std::uint32_t id) const {
    if (channel_.raw.count(id) > 0) return channel_.raw.at(id);
    if (id == tdms_raw_values && channel_.raw.size() == 1) return channel_.raw.begin()->second;
    return fmt::format("a scaling asks for values {} that are not there", id);
  }

  Values input(std::uint32_t id, const std::string& source) {
    const double from = number(id, source).value_or(tdms_raw_values);
    if (!(from >= 0 && from <= tdms_raw_values)) return "a scaling of unknown input";
    return values_of(static_cast<std::uint32_t>(from));
  }

  template <typename Function>
  static Values each(Values values, const Function& function) {
    if (auto* numbers = std::get_if<0>(&values)) {
      for (double& number : *numbers) number = function(number);
    }
    return values;
  }

  Values linear(std::uint32_t id) {
    const auto slope = number(id, "Linear_Slope");
    const auto intercept = number(id, "Linear_Y_Intercept");
    if (!slope || !intercept) return "a linear scaling without slope or intercept";
    return each(input(id, "Linear_Input_Source"),
                [&](double x) { return *slope * x + *intercept; });
  }

  std::optional<std::vector<double>> list(std::uint32_t id, const std::string& what,
                                          double default_size) const {
    const double size = number(id, what + "_Size").value_or(default_size);
    if (!(size >= 1 && size <= most_coefficients)) return std::nullopt;
    std::vector<double> numbers;
    for (int i = 0; i < static_cast<int>(size); ++i) {
      const auto next = number(id, fmt::format("{}[{}]", what, i));
      if (!next || !std::isfinite(*next)) return std::nullopt;
      numbers.push_back(*next);
    }
    return numbers;
  }

  Values polynomial(std::uint32_t id) {
    const auto coefficients = list(id, "Polynomial_Coefficients", 4);
    if (!coefficients) return "a polynomial without its coefficients";
    return each(input(id, "Polynomial_Input_Source"), [&](double x) {
      double sum = 0;
      for (auto c = coefficients->rbegin(); c != coefficients->rend(); ++c) sum = sum * x + *c;
      return sum;
    });
  }

  Values table(std::uint32_t id) {
    auto from = list(id, "Table_Scaled_Values", 0), to = list(id, "Table_Pre_Scaled_Values", 0);
    if (!from || !to || from->size() != to->size()) return "a table without its values";
    if (from->front() > from->back()) {
      std::ranges::reverse(*from);
      std::ranges::reverse(*to);
    }
    if (std::ranges::adjacent_find(*from, std::greater_equal<>()) != from->end()) {
      return "a table that does not rise";
    }
    return each(input(id, "Table_Input_Source"), [&](double x) {
      if (!(x > from->front())) return std::isnan(x) ? x : to->front();
      const auto above = std::ranges::lower_bound(*from, x);
      if (above == from->end()) return to->back();
      const auto i = static_cast<std::size_t>(above - from->begin());
      return std::lerp((*to)[i - 1], (*to)[i],
                       (x - (*from)[i - 1]) / ((*from)[i] - (*from)[i - 1]));
    });
  }

  // right + sign · left
  Values combined(std::uint32_t id, const std::string& type, double sign) {
    Values left = input(id, type + "_Left_Operand_Input_Source");
    Values right = input(id, type + "_Right_Operand_Input_Source");
    if (std::holds_alternative<std::string>(left)) return left;
    if (std::holds_alternative<std::string>(right)) return right;
    const std::vector<double>& a = std::get<0>(left);
    std::vector<double>& b = std::get<0>(right);
    if (a.size() != b.size()) return "a scaling of inputs of unequal length";
    for (std::size_t i = 0; i < a.size(); ++i) b[i] += sign * a[i];
    return right;
  }

  const TdmsChannel& channel_;
  int used_ = 0;
};

// One more than the highest number of a scaling; 0 if there is none. Some writers leave out how
// many there are.
double highest_scaling(const TdmsProperties& properties) {
  double highest = 0;
  for (int id = 0; id < most_scalings; ++id) {
    if (properties.count(fmt::format("NI_Scale[{}]_Scale_Type", id)) > 0) highest = id + 1;
  }
  return highest;
}

}  // namespace

std::variant<std::vector<double>, std::string> scaled_values(const TdmsChannel& channel) {
  const double count = number_in(channel.properties, "NI_Number_Of_Scales")
                           .value_or(highest_scaling(channel.properties));
  const bool is_scaled = text_in(channel.properties, "NI_Scaling_Status") == "scaled";
  if (is_scaled || !(count >= 1 && count <= 1e6)) {
    if (channel.raw.size() == 1) return channel.raw.begin()->second;
    return channel.raw.empty() ? Values(std::vector<double>()) : "several raw values, no scaling";
  }
  return Scalings(channel).values_of(static_cast<std::uint32_t>(count) - 1);
}

std::optional<double> number_in(const TdmsProperties& properties, const std::string& name) {
  const auto found = properties.find(name);
  if (found == properties.end()) return std::nullopt;
  const double* number = std::get_if<double>(&found->second);
  return number == nullptr ? std::nullopt : std::optional<double>(*number);
}

std::string text_in(const TdmsProperties& properties, const std::string& name) {
  const auto found = properties.find(name);
  if (found == properties.end()) return {};
  const std::string* text = std::get_if<std::string>(&found->second);
  return text == nullptr ? std::string() : *text;
}

}  // namespace rvbench::hal::formats
