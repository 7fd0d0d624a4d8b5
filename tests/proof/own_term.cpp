// own_term OUT: hides physics of its own in a plant of rvbench, and writes recordings of it.
//
// The term is not of rvbench's library: it is registered here, in a copy of it, as any program may.
// OUT/campaign.json and OUT/record_*.csv are then explained by what does not know of it:
//     rvbench explain --plant emps --rec OUT/campaign.json
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "sim/plant_json.hpp"
#include "sim/simulate.hpp"
#include "sim/terms/one_axis_term.hpp"

namespace {

using namespace rvbench;
using nlohmann::json;

constexpr double rate_Hz = 1000, length_s = 4, two_pi = 2 * std::numbers::pi;
constexpr double noise_V = 0.01;
constexpr int repeats = 3;

// Magnets of a linear motor pull the slide from tooth to tooth.
class Cogging final : public sim::OneAxisTerm {
 public:
  explicit Cogging(const sim::TermSite& at)
      : OneAxisTerm("cogging", at.axis), force_(at["force"]), pitch_(at["pitch"]) {}
  double effort(const sim::PlantState& s) const override {
    return force_ * std::sin(two_pi * way(s) / pitch_);
  }
  double stored_energy_J(const sim::PlantState& s) const override {
    return force_ * pitch_ / two_pi * (1 - std::cos(two_pi * way(s) / pitch_));
  }
  double fastest_rad_s(const Eigen::VectorXd& inertia) const override {
    return std::sqrt(two_pi * std::abs(force_) / pitch_ * mobility(inertia));
  }

 private:
  double force_, pitch_;
};

sim::TermType cogging() {
  return {.card = {.name = "cogging", .equation = "F = A·sin(2π·x/p)"},
          .parameters = {{.name = "force", .unit = sim::UnitKind::force, .max = sim::unbounded},
                         {.name = "pitch",
                          .unit = sim::UnitKind::coordinate,
                          .min = 1e-6,
                          .max = sim::unbounded}},
          .make = [](const sim::TermSite& at) { return std::make_unique<Cogging>(at); }};
}

// To and fro, at one of three paces.
Eigen::VectorXd way_m(double pace_Hz) {
  return Eigen::VectorXd::NullaryExpr(Eigen::Index(length_s * rate_Hz), [=](Eigen::Index i) {
    const double turns = pace_Hz * static_cast<double>(i) / rate_Hz;
    return 0.1 * std::sin(two_pi * turns) + 0.03 * std::sin(two_pi * 2.3 * turns + 1);
  });
}

template <typename T, typename Fault>
T value_or_exit(std::variant<T, Fault> made, const char* what) {
  if (auto* value = std::get_if<T>(&made)) return std::move(*value);
  std::cerr << "own_term: " << what << '\n';
  std::exit(1);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: own_term OUT\n";
    return 2;
  }
  const std::filesystem::path out = argv[1];
  std::filesystem::create_directories(out);

  sim::TermLibrary library = sim::standard_terms();
  library.add(cogging());
  const auto plant = value_or_exit(sim::read_plant("emps", library), "no plant emps");
  const auto hidden = sim::with_effect(plant, "cogging", {.body_a = "slide"},
                                       {{"force", {12, "N"}}, {"pitch", {0.024, "m"}}}, library);

  std::mt19937 engine(1);
  std::normal_distribution<double> normal(0, noise_V);
  json files = json::array();
  for (const double pace_Hz : {0.5, 0.8, 1.2}) {
    const Channel way{{"qm", "m", "", not_known}, rate_Hz, 0, way_m(pace_Hz)};
    const int steps = value_or_exit(sim::substeps_for(hidden, rate_Hz, library), "too stiff");
    const auto moved = value_or_exit(sim::Excitation::make(hidden, {way}, steps), "no motion");
    const auto run = value_or_exit(sim::simulate(hidden, moved, library), "not simulated");
    for (int repeat = 0; repeat < repeats; ++repeat) {
      const std::string name = "record_" + std::to_string(files.size() + 1) + ".csv";
      std::ofstream csv(out / name);
      csv << "qm,vir\n";
      for (Eigen::Index i = 0; i < way.samples.size(); ++i) {
        csv << way.samples[i] << ',' << run.channels[0].samples[i] + normal(engine) << '\n';
      }
      const std::string pace = std::to_string(pace_Hz).substr(0, 3) + " Hz";
      files.push_back({{"file", name},
                       {"rate_Hz", rate_Hz},
                       {"records", {{{"condition", pace}, {"programme", pace}}}}});
    }
  }
  std::ofstream(out / "campaign.json") << json{{"campaign", "own"}, {"files", files}}.dump(1);
}
