#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rvbench::sim {

// Lists of a plant file's parts, each with a `name`.

/// Place of the first of that name; -1 if there is none.
template <typename T>
int index_of(const std::vector<T>& list, std::string_view name) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

/// The first of that name; nullptr if there is none.
template <typename T>
const T* find_named(const std::vector<T>& list, std::string_view name) {
  const int index = index_of(list, name);
  return index < 0 ? nullptr : &list[static_cast<std::size_t>(index)];
}

template <typename T>
std::vector<std::string> names_of(const std::vector<T>& list) {
  std::vector<std::string> names;
  for (const T& item : list) names.push_back(item.name);
  return names;
}

}  // namespace rvbench::sim
