#include "tests/survival/witness.hpp"

#include <sstream>

namespace rvbench::test {
namespace {

Handed handed_of(std::istream& words, std::int64_t time_ns) {
  Handed handed;
  char clock = 'a';
  words >> handed.point >> clock >> handed.sum.count >> handed.sum.sum;
  handed.time_ns = time_ns;
  handed.is_torque = clock == 't';
  return handed;
}

}  // namespace

void Witness::hear(const DiskEntry& entry) {
  std::istringstream words(entry.path);
  std::string what;
  words >> what >> std::ws;
  if (what == "made") {  // what an earlier process told of its end is no more
    made = true;
    verdict.reset();
    unwritten.clear();
    at_rest = entered = false;
  }
  if (what == "begun") {
    words >> recording;
    handed.clear();
  }
  if (what == "handed") handed.push_back(handed_of(words, entry.time_ns));
  if (what == "ended") {
    int point = 0;
    Ended end;
    words >> point >> end.accelerations.count >> end.accelerations.sum >> end.torques.count >>
        end.torques.sum >> end.status;
    ended[point] = end;
  }
  if (what == "verdict") std::getline(words, verdict.emplace());
  if (what == "unwritten") std::getline(words, unwritten.emplace_back());
  if (what == "refused") std::getline(words, refusal);
  if (what == "threw") std::getline(words, thrown);
  if (what == "at_rest") at_rest = true;
  if (what == "entered") entered = true;
  if (what == "not_entered") std::getline(words, not_entered);
  if (what == "struck") {
    words >> struck;
    struck_at_end = verdict.has_value();
  }
  if (what == "calls") words >> calls;
  if (what == "killed") killed_ns = entry.time_ns;
}

Witness heard(Witness before, const std::vector<DiskEntry>& entries) {
  for (const DiskEntry& entry : entries) {
    if (entry.kind == DiskEntry::Kind::told) before.hear(entry);
  }
  return before;
}

}  // namespace rvbench::test
