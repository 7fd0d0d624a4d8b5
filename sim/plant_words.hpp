#pragma once

#include <array>
#include <string_view>

#include "sim/plant_spec.hpp"

namespace rvbench::sim {

template <typename T>
struct Word {
  std::string_view word;
  T value;
};

/// The words of plant files.
inline constexpr std::array<Word<Motion>, 2> motion_words{
    {{"rotation", Motion::rotation}, {"translation", Motion::translation}}};
inline constexpr std::array<Word<InputKind>, 5> input_words{
    {{"force", InputKind::force},
     {"signal", InputKind::signal},
     {"position", InputKind::position},
     {"speed", InputKind::speed},
     {"acceleration", InputKind::acceleration}}};
inline constexpr std::array<Word<Between>, 3> between_words{
    {{"band_limited", Between::band_limited},
     {"linear", Between::linear},
     {"hold", Between::hold}}};
inline constexpr std::array<Word<OutputKind>, 5> output_words{
    {{"position", OutputKind::position},
     {"speed", OutputKind::speed},
     {"acceleration", OutputKind::acceleration},
     {"effort", OutputKind::effort},
     {"drive", OutputKind::drive}}};

inline constexpr std::array<Word<ComparedBy>, 3> compared_by_words{
    {{"samples", ComparedBy::samples},
     {"orders", ComparedBy::orders},
     {"envelope", ComparedBy::envelope}}};

template <typename T, std::size_t n>
std::string_view word_of(const std::array<Word<T>, n>& words, T value) {
  for (const auto& entry : words) {
    if (entry.value == value) return entry.word;
  }
  return {};
}

}  // namespace rvbench::sim
