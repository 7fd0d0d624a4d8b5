#include "tests/faults/record_flaw.hpp"

#include <stdexcept>
#include <variant>
#include <vector>

#include "analysis/quality.hpp"
#include "analysis/quality/record_quality.hpp"
#include "bench/kinematics_file.hpp"
#include "tests/faults/fault_bench.hpp"

namespace rvbench::test {
namespace {

using Notes = std::vector<analysis::QualityNote>;

const analysis::Kinematics& kinematics() {
  static const analysis::Kinematics read = [] {
    auto made = bench::read_kinematics("rv20e");
    if (made.index() == 1) throw std::logic_error("the kinematics of rv20e has faults");
    return std::get<0>(std::move(made));
  }();
  return read;
}

std::vector<const Channel*> accelerations(const Recording& record) {
  std::vector<const Channel*> channels;
  for (const Channel& channel : record.channels) {
    if (!is_of_shaft(channel.info)) channels.push_back(&channel);
  }
  return channels;
}

std::string first_of(const Channel& channel, const Notes& notes) {
  for (const analysis::QualityNote& note : notes) {
    if (note.invalidates) return channel.info.name + " is " + note.what;
  }
  return "";
}

template <typename Check>
std::string first_by(const Recording& record, Check check) {
  for (const Channel* channel : accelerations(record)) {
    const std::string flaw = first_of(*channel, check(*channel, FaultBench::range_m_s2));
    if (!flaw.empty()) return flaw;
  }
  return "";
}

}  // namespace

std::string flaw_of_record(const Recording& record) {
  const auto angle = analysis::ShaftAngle::of(record);
  if (!angle) return "the shaft's speed is not known or not steady";
  const std::vector<const Channel*> channels = accelerations(record);
  const std::vector<Notes> notes =
      analysis::record_quality(channels, *angle, kinematics(), FaultBench::range_m_s2);
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const std::string flaw = first_of(*channels[i], notes[i]);
    if (!flaw.empty()) return flaw;
  }
  return "";
}

std::string flaw_of_channels(const Recording& record) {
  return first_by(record, analysis::accelerometer_quality);
}

std::string flaw_but_dead_stretches(const Recording& record) {
  return first_by(record, analysis::channel_quality);
}

}  // namespace rvbench::test
