#pragma once

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/simulated_recording.hpp"
#include "bench/text_file.hpp"

namespace rvbench::test {

/// A machine without dynamics, so that its answers can be told by hand: two paths, each sensor the
/// sum of both forces by fixed gains.
struct SmallMachine {
  double rate_Hz = 2000;
  double force_1 = 3, force_2 = 1;  ///< RMS in operation, white, independent [N]
  double noise = 1e-3;              ///< of all sensors, m/s² RMS; of hits as well
  double forearm_noise = 0;         ///< of the sensor for validation, in operation
  double sign_of_j2 = 1;            ///< of the sensor at J2 active, in operation
  bool has_flange = true;           ///< in operation
  double flange_gain = 1;           ///< in operation, of what the hammer test was told
  double mount_stiffness_N_m = 0;   ///< forces act through springs, on the passive sides; 0: none
  unsigned seed = 1;                ///< of all noise and scatter
  int hits = 3;                     ///< at each path

  /// Sensors' answers to a force at J1 and at J2, (m/s²)/N.
  struct Gain {
    const char* point;
    double j1, j2;
  };
  static constexpr Gain gains[] = {{"J1 active", 1, 0.2}, {"J1 passive", 0.6, 0.3},
                                   {"J2 active", 0.2, 1}, {"J2 passive", 0.2, 0.7},
                                   {"flange", 0.5, 0.5},  {"forearm", 0.4, 0.6},
                                   {"base", 0.3, 0.8},    {"plate", 0.7, 0.4}};
};

inline Channel channel_of(const char* name, const char* unit, double rate_Hz,
                          Eigen::VectorXd samples) {
  return {{name, unit, "+X"}, rate_Hz, 0, std::move(samples)};
}

/// Hits of 0.5 s at a path, scattering by 2 % in strength of what is told of them.
inline std::vector<Recording> hits_of(const SmallMachine& machine, bool at_j2, unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> gaussian;
  const auto samples = static_cast<Eigen::Index>(machine.rate_Hz / 2);
  std::vector<Recording> hits(static_cast<std::size_t>(machine.hits));
  for (Recording& hit : hits) {
    Eigen::VectorXd force = Eigen::VectorXd::Zero(samples);
    for (int i = 0; i < 4; ++i) force[50 + i] = 200 * std::sin(std::numbers::pi * (i + 0.5) / 4);
    const auto noisy = [&](const Eigen::VectorXd& x, double rms) {
      return Eigen::VectorXd(x.unaryExpr([&](double v) { return v + rms * gaussian(engine); }));
    };
    hit.channels.push_back(channel_of("hammer", "N", machine.rate_Hz,
                                      noisy(force * (1 + 0.02 * gaussian(engine)), 1e-3)));
    for (const auto& gain : SmallMachine::gains) {
      const double own = at_j2 ? gain.j2 : gain.j1;
      hit.channels.push_back(
          channel_of(gain.point, "m/s²", machine.rate_Hz, noisy(own * force, machine.noise)));
    }
  }
  return hits;
}

/// What the active side of a spring does beside what its passive side does: ẍ of F = k·x.
inline Eigen::VectorXd give_of(const Eigen::VectorXd& force, double stiffness_N_m, double rate_Hz) {
  const Eigen::Index n = force.size();
  Eigen::VectorXd give = Eigen::VectorXd::Zero(n);
  give.segment(1, n - 2) = (force.tail(n - 2) - 2 * force.segment(1, n - 2) + force.head(n - 2)) *
                           (rate_Hz * rate_Hz / stiffness_N_m);
  return give;
}

/// Ten seconds of operation.
inline Recording operation_of(const SmallMachine& machine, unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> gaussian;
  const auto noise = [&](double rms) {
    Eigen::VectorXd x(static_cast<Eigen::Index>(10 * machine.rate_Hz));
    for (double& v : x) v = rms * gaussian(engine);
    return x;
  };
  const Eigen::VectorXd at_j1 = noise(machine.force_1), at_j2 = noise(machine.force_2);
  Recording record;
  for (const auto& gain : SmallMachine::gains) {
    const std::string name = gain.point;
    if (name == "flange" && !machine.has_flange) continue;
    Eigen::VectorXd x = gain.j1 * at_j1 + gain.j2 * at_j2 + noise(machine.noise);
    if (machine.mount_stiffness_N_m > 0 && (name == "J1 active" || name == "J2 active")) {
      const bool is_1 = name == "J1 active";
      x = (is_1 ? 0.6 : 0.2) * at_j1 + (is_1 ? 0.3 : 0.7) * at_j2 + noise(machine.noise) +
          give_of(is_1 ? at_j1 : at_j2, machine.mount_stiffness_N_m, machine.rate_Hz);
    }
    if (name == "J2 active") x *= machine.sign_of_j2;
    if (name == "flange") x *= machine.flange_gain;
    if (name == "forearm" && machine.forearm_noise > 0) x += noise(machine.forearm_noise);
    record.channels.push_back(channel_of(gain.point, "m/s²", machine.rate_Hz, std::move(x)));
  }
  return record;
}

inline nlohmann::json small_project() {
  const auto places = [](const std::vector<std::string>& points) {
    return nlohmann::json{{"points", points}, {"directions", {"+X"}}};
  };
  return {{"tpa", "small machine"},
          {"hammer",
           {{"channel", "hammer"},
            {"hits",
             {{{"file", "J1.h5"}, {"point", "J1 active"}, {"direction", "+X"}},
              {{"file", "J2.h5"}, {"point", "J2 active"}, {"direction", "+X"}}}}}},
          {"paths", places({"J1 active", "J2 active"})},
          {"sensors",
           {{"indicators", places({"J1 active", "J1 passive", "J2 active", "J2 passive"})},
            {"targets", places({"flange"})},
            {"validation", places({"forearm"})}}},
          {"bands", {{{"from_Hz", 20}, {"to_Hz", 500}}}},
          {"resampling", {{"replicates", 40}, {"seed", 1}}},
          {"motions", {{{"name", "slow"}, {"recording", "slow.h5"}}}}};
}

/// Writes the machine's hits, its motion and the project. @return the project's file
inline std::string write_small_machine(const std::filesystem::path& folder,
                                       const SmallMachine& machine,
                                       const nlohmann::json& project = small_project()) {
  const auto write = [&](const char* name, const std::vector<Recording>& recordings) {
    std::filesystem::remove(folder / name);
    if (!bench::write_vibration_hdf5(folder / name, recordings)) throw std::runtime_error(name);
  };
  write("J1.h5", hits_of(machine, false, 3 * machine.seed));
  write("J2.h5", hits_of(machine, true, 3 * machine.seed + 1));
  write("slow.h5", {operation_of(machine, 3 * machine.seed + 2)});
  const std::filesystem::path file = folder / "project.json";
  bench::write_file(file, project.dump(1));
  return file.string();
}

}  // namespace rvbench::test
