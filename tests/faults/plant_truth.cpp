#include "tests/faults/plant_truth.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "hal/types/units.hpp"

namespace rvbench::test {
namespace {

template <typename T>
void put(std::ofstream& out, const std::vector<T>& all) {
  const std::size_t count = all.size();
  out.write(reinterpret_cast<const char*>(&count), sizeof count);
  out.write(reinterpret_cast<const char*>(all.data()), std::streamsize(count * sizeof(T)));
}

template <typename T>
void get(std::ifstream& in, std::vector<T>& all) {
  std::size_t count = 0;
  in.read(reinterpret_cast<char*>(&count), sizeof count);
  if (!in || count > 100'000'000) throw std::runtime_error("PlantTruth: not one");
  all.resize(count);
  in.read(reinterpret_cast<char*>(all.data()), std::streamsize(count * sizeof(T)));
  if (!in) throw std::runtime_error("PlantTruth: cut short");
}

bool is_same(double recorded, float sampled) {
  if (std::isnan(sampled)) return std::isnan(recorded);
  return std::bit_cast<std::uint32_t>(float(recorded)) == std::bit_cast<std::uint32_t>(sampled);
}

// The numbers of the samples follow from the time of the first: a scan is stamped when it is due,
// a frame when it was sent, a step of the plant later at most.
std::size_t first_scan(const Channel& channel) {
  return std::size_t(std::llround(channel.start_s * channel.rate_Hz)) - 1;
}

std::size_t first_frame(const Channel& channel) {
  return std::size_t(std::floor(channel.start_s * channel.rate_Hz + 0.01));
}

}  // namespace

void PlantTruth::save(const std::filesystem::path& file) const {
  std::ofstream out(file, std::ios::binary);
  put(out, scans);
  put(out, torques);
  if (!out.flush()) throw std::runtime_error("PlantTruth: cannot write " + file.string());
}

PlantTruth PlantTruth::load(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  PlantTruth truth;
  get(in, truth.scans);
  get(in, truth.torques);
  return truth;
}

std::string PlantTruth::contradiction(const Recording& record) const {
  std::size_t number = 0;
  for (const Channel& channel : record.channels) {
    if (is_of_shaft(channel.info)) continue;
    const std::size_t from = channel.samples.size() == 0 ? 0 : first_scan(channel);
    for (Eigen::Index i = 0; i < channel.samples.size(); ++i) {
      const std::size_t at = (from + std::size_t(i)) * channels + number;
      if (at < scans.size() && is_same(channel.samples[i], scans[at])) continue;
      return fmt::format("{}: sample {} is not what was sampled", channel.info.name, i);
    }
    ++number;
  }
  const Channel* torque = record.find(channel_names::input_torque);
  const Channel* angle = record.find(channel_names::input_angle);
  if (number != channels || torque == nullptr || angle == nullptr) return "channels are missing";
  if (torque->samples.size() != angle->samples.size()) return "torque and angle differ in length";
  const std::size_t from = torque->samples.size() == 0 ? 0 : first_frame(*torque);
  for (Eigen::Index i = 0; i < torque->samples.size(); ++i) {
    if (std::isnan(torque->samples[i])) continue;
    const std::size_t at = from + std::size_t(i);
    if (at >= torques.size() || torques[at].angle_counts < 0) return "torque that nobody sent";
    const double counts = 65536 * angle->samples[i] / units::two_pi;
    const double off = std::remainder(counts - torques[at].angle_counts, 65536);
    if (is_same(torque->samples[i], torques[at].torque_Nm) && std::abs(off) < 0.01) continue;
    return fmt::format("torque sample {} is not what was sent", i);
  }
  return "";
}

}  // namespace rvbench::test
