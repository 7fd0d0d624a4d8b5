#pragma once

#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "tests/analysis/explain/plain_model.hpp"

namespace rvbench::test {

/// A machine whose force is a sum of known functions of speed and load, measured in records of
/// `record_size` samples, with noise that remembers (AR(1)) and a gain that scatters by record.
class ToyModel final : public PlainModel {
 public:
  using Law = double (*)(double speed, double load, const double* p);
  static constexpr Eigen::Index record_size = 200;

  struct Truth {
    std::vector<std::pair<std::string, std::vector<double>>> effects;  ///< by name, with values
    double noise = 0.05;
    double memory = 0.9;          ///< of the noise from sample to sample
    double record_scatter = 0.0;  ///< of an offset of its own for each record
    unsigned seed = 1;
  };

  explicit ToyModel(const Truth& truth) {
    base_ = {{"machine/viscous", "N·s/m", 1.0, 0, 10, 1e9, 0.1, false},
             {"sensor/offset", "N", 0.0, -10, 10, 1e9, 0.1, true}};
    add("coulomb_friction", {{"force", "N", 0, -10, 10, 1e9, 0.1, false}}, {{0.5}, {-0.5}},
        [](double v, double, const double* p) { return p[0] * (v > 0 ? 1.0 : -1.0); });
    add("drag", {{"drag", "N·s²/m²", 0, -10, 10, 1e9, 0.1, false}}, {{0.5}, {-0.5}},
        [](double v, double, const double* p) { return p[0] * v * std::abs(v); });
    add("cubic_drag", {{"drag", "N·s³/m³", 0, -10, 10, 1e9, 0.1, false}}, {{0.5}, {-0.5}},
        [](double v, double, const double* p) { return p[0] * v * v * v; });
    add("load_friction", {{"coefficient", "", 0, -10, 10, 1e9, 0.1, false}}, {{0.2}, {-0.2}},
        [](double v, double l, const double* p) { return p[0] * l * (v > 0 ? 1.0 : -1.0); });
    add("stribeck_friction",
        {{"force", "N", 0, -10, 10, 1e9, 0.1, false},
         {"speed", "m/s", 0.3, 0.05, 2, 1e9, 0.1, false}},
        {{0.5, 0.2}, {-0.5, 0.2}, {0.5, 1.0}}, [](double v, double, const double* p) {
          return p[0] * std::exp(-v * v / p[1] / p[1]) * (v > 0 ? 1.0 : -1.0);
        });
    conceal("power_drag", [](double v, double, const double* p) {
      return p[0] * std::copysign(std::pow(std::abs(v), 2.5), v);
    });
    conceal("ripple", [](double v, double, const double* p) { return p[0] * std::cos(40 * v); });
    measure(truth);
  }

  std::optional<Eigen::VectorXd> residuals(const std::vector<std::size_t>& effects,
                                           const std::vector<double>& values,
                                           const std::vector<bool>&) const override {
    Eigen::VectorXd out(measured_.size());
    for (Eigen::Index i = 0; i < out.size(); ++i) {
      double force = values[0] * speed_[i] + values[1];
      std::size_t at = base_.size();
      for (const std::size_t e : effects) {
        force += laws_[e](speed_[i], load_[i], values.data() + at);
        at += library_[e].parameters.size();
      }
      out[i] = measured_[i] - force;
    }
    return out;
  }

  Eigen::MatrixXd states() const override {
    Eigen::MatrixXd both(speed_.size(), 2);
    both << speed_, load_;
    return both;
  }

  std::size_t index_of(const std::string& name) const { return by_name_.at(name); }
  void hide(const std::string& name, const std::string& why) {
    library_[by_name_.at(name)].not_exercised = why;
  }
  void start_far(const std::string& name) { library_[by_name_.at(name)].has_far_starts = true; }
  void bound(const std::string& name, double low, double high) {
    library_[by_name_.at(name)].parameters.front().low = low;
    library_[by_name_.at(name)].parameters.front().high = high;
  }

 private:
  void add(const std::string& name, std::vector<analysis::ModelParameter> parameters,
           std::vector<std::vector<double>> starts, Law law) {
    by_name_[name] = library_.size();
    analysis::Candidate candidate;
    candidate.name = name;
    candidate.where = "slide";
    candidate.parameters = std::move(parameters);
    candidate.starts = std::move(starts);
    library_.push_back(std::move(candidate));
    laws_.push_back(law);
  }

  // A law that the truth may hold and the library does not.
  void conceal(const std::string& name, Law law) {
    by_name_[name] = laws_.size();
    laws_.push_back(law);
  }

  void measure(const Truth& truth) {
    std::mt19937_64 engine(truth.seed);
    std::normal_distribution<double> normal;
    const double top_speeds[] = {0.5, 1.0, 2.0};
    const double loads[] = {0.0, 1.0, 2.0};
    measured_.resize(27 * record_size);
    speed_.resize(measured_.size());
    load_.resize(measured_.size());
    Eigen::Index at = 0;
    for (const double top : top_speeds) {
      for (const double load : loads) {
        for (int repeat = 0; repeat < 3; ++repeat) {
          units_.push_back({"record", std::to_string(top) + "/" + std::to_string(load),
                            std::to_string(top), std::to_string(load), at, record_size});
          const double own = truth.record_scatter * normal(engine);
          double noise = 0;
          for (Eigen::Index i = 0; i < record_size; ++i, ++at) {
            speed_[at] = top * std::sin(0.3 * double(i) + 0.1 * repeat);
            load_[at] = load;
            noise =
                truth.memory * noise + std::sqrt(1 - truth.memory * truth.memory) * normal(engine);
            measured_[at] = 1.1 * speed_[at] + 0.2 + own + truth.noise * noise;
            for (const auto& [name, values] : truth.effects) {
              measured_[at] += laws_[by_name_.at(name)](speed_[at], load, values.data());
            }
          }
        }
      }
    }
  }

  std::vector<Law> laws_;
  std::map<std::string, std::size_t> by_name_;
  Eigen::VectorXd measured_, speed_, load_;
};

}  // namespace rvbench::test
