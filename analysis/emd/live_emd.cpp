#include "analysis/emd/live_emd.hpp"

#include <stdexcept>
#include <string>
#include <utility>

namespace rvbench::analysis {
namespace {

constexpr Eigen::Index most_kept = 1 << 16;  // samples of a stage that are final
constexpr std::size_t block = 16;  // of extrema: who watches would rather have them soon than cheap

}  // namespace

LiveEmd::LiveEmd(const EmdOptions& options) {
  check(options);
  if (options.stopping != nullptr) {
    throw std::invalid_argument(std::string("LiveEmd: the rule ") + options.stopping->name +
                                " needs all of a signal to stop; live, sifts are counted");
  }
  for (int imf = 0; imf < options.imfs; ++imf) {
    stages_.emplace_back(options);
    stages_.back().chain.begin(block);
  }
}

void LiveEmd::add(const Eigen::Ref<const Eigen::VectorXd>& samples) {
  if (!samples.allFinite()) throw std::invalid_argument("LiveEmd: sample not finite");
  if (samples.size() == 0) return;
  if (known_ == 0) offset_ = samples[0];
  known_ += samples.size();
  const Eigen::VectorXd moved = samples.array() - offset_;
  pass_on(moved.data(), moved.size(), 0, false);
}

void LiveEmd::end() { pass_on(nullptr, 0, 0, true); }

// What a stage makes final leaves a residue, which is the next one's input.
void LiveEmd::pass_on(const double* samples, Eigen::Index count, std::size_t number, bool is_end) {
  if (number == stages_.size()) return give_to_residue(samples, count);
  Stage& stage = stages_[number];
  stage.input.insert(stage.input.end(), samples, samples + count);
  stage.h.insert(stage.h.end(), samples, samples + count);
  const auto known = static_cast<Eigen::Index>(stage.h.size());
  const Eigen::Index sifted = stage.chain.advance(stage.h.data(), known, is_end);
  if (is_end && stage.chain.extrema() < least_extrema) {
    return give_to_residue(stage.input.data(), known);  // it has no such IMF
  }
  const Eigen::Index fresh = sifted - stage.sifted;
  const double* imf = stage.h.data() + stage.sifted;
  stage.out.insert(stage.out.end(), imf, imf + fresh);
  stage.done += fresh;
  Eigen::VectorXd left(fresh);
  for (Eigen::Index i = 0; i < fresh; ++i) {
    left[i] = stage.input[static_cast<std::size_t>(stage.sifted + i)] - imf[i];
  }
  stage.sifted = sifted;
  if (sifted > most_kept) {
    for (auto* each : {&stage.input, &stage.h}) each->erase(each->begin(), each->begin() + sifted);
    stage.chain.rebase(sifted);
    stage.sifted = 0;
  }
  pass_on(left.data(), fresh, number + 1, is_end);
}

void LiveEmd::give_to_residue(const double* samples, Eigen::Index count) {
  for (Eigen::Index i = 0; i < count; ++i) residue_.push_back(samples[i] + offset_);
  residue_done_ += count;
}

Eigen::VectorXd LiveEmd::take(int imf) {
  const auto number = static_cast<std::size_t>(imf);
  std::vector<double>& out = number == stages_.size() ? residue_ : stages_.at(number).out;
  const std::vector<double> taken = std::exchange(out, {});
  return Eigen::Map<const Eigen::VectorXd>(taken.data(), static_cast<Eigen::Index>(taken.size()));
}

Eigen::Index LiveEmd::done(int imf) const {
  const auto number = static_cast<std::size_t>(imf);
  return number == stages_.size() ? residue_done_ : stages_.at(number).done;
}

}  // namespace rvbench::analysis
