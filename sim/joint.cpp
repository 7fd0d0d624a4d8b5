#include "sim/joint.hpp"

#include <algorithm>

namespace rvbench::sim {

Joint Joint::at(const Terms& terms, std::size_t term) {
  const auto* of = dynamic_cast<const OneAxisTerm*>(terms[term].get());
  if (of != nullptr && of->axis().body_b != housing) {
    return between(terms, of->axis().body_a, of->axis().body_b);
  }
  Joint alone;
  alone.parts_.emplace_back(terms[term].get(), 1);
  return alone;
}

Joint Joint::between(const Terms& terms, int body_a, int body_b) {
  Joint joint;
  for (const auto& term : terms) {
    const auto* part = dynamic_cast<const OneAxisTerm*>(term.get());
    if (part == nullptr) continue;
    const Axis axis = part->axis();
    if (axis.body_a == body_a && axis.body_b == body_b) joint.parts_.emplace_back(part, 1);
    if (axis.body_a == body_b && axis.body_b == body_a) joint.parts_.emplace_back(part, -1);
  }
  return joint;
}

double Joint::passed(const PlantState& s) const {
  double sum = 0;
  for (const auto& [part, sign] : parts_) sum += sign * part->effort(s);
  return sum;
}

bool Joint::is_linear() const {
  return std::ranges::all_of(parts_, [](const auto& part) { return part.first->is_linear(); });
}

}  // namespace rvbench::sim
