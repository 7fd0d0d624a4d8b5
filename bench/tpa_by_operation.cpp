#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "analysis/tpa/operational_paths.hpp"
#include "bench/tpa_methods.hpp"

namespace rvbench::bench {
namespace {

using Eigen::Index;

constexpr Index blocks_per_reference = 2;
constexpr hal::Bounds steps{1e-3, 1e4};

// Two thirds of the blocks are learnt from. The next one overlaps with the last of them.
Index learnt_of(Index blocks) { return 2 * blocks / 3; }

class ByOperation final : public TpaMethod {
 public:
  ByOperation(const TpaProject& project, analysis::OperatingSpectra motion)
      : motion_(std::move(motion)),
        references_(project.indicators),
        targets_(project.targets),
        rule_(analysis::find_rule(project.rule)->rule) {}

  analysis::PathContributions contributions(const analysis::FrfMatrix&,
                                            const std::vector<Index>& blocks,
                                            unsigned) const override {
    analysis::OperationalPaths found = paths_of(blocks);
    const analysis::OperatingSpectra all = blocks_of(motion_, blocks);
    const Index lines = all.grid.lines, references = Index(references_.size());
    analysis::LineMatrices themselves(references, references, lines);
    for (Index line = 0; line < lines; ++line) themselves[line].setIdentity();
    return {references_,
            targets_,
            all.grid,
            rows_of(all, references_).values,
            std::move(found.transmissibilities),
            rows_of(all, targets_).values,
            std::move(found.held_out),
            std::move(found.rules),
            {},
            std::vector<bool>(std::size_t(lines), true),
            Eigen::MatrixXd::Zero(references, lines),
            references_,
            std::move(themselves)};
  }

  MethodFindings findings(const analysis::PathContributions& whole) const override {
    std::vector<Index> blocks(std::size_t(motion_.values.columns));
    for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i] = Index(i);
    const analysis::OperationalPaths found = paths_of(blocks);
    MethodFindings findings;
    findings.ways = found.ways;
    analysis::add_if_not_validated(whole.validation.score(), {}, findings.faults);
    Index together = 0;
    for (Index line = 0; line < found.ways.size(); ++line) together += !found.tells_all(line);
    // To a target that they do not drive, the rule takes nothing of them at all.
    if (findings.faults.empty() && 2 * together > found.ways.size()) {
      findings.faults.push_back(
          {analysis::TpaFaultKind::references_together,
           fmt::format("at {} of {} lines", together, found.ways.size()),
           fmt::format("references moved together: in {:.1f} independent ways of {} on average; "
                       "what they hand on is shared out among them",
                       found.ways.mean(), references_.size())});
    }
    return findings;
  }

 private:
  analysis::OperationalPaths paths_of(const std::vector<Index>& blocks) const {
    const auto learnt = blocks.begin() + learnt_of(Index(blocks.size()));
    return analysis::operational_paths(blocks_of(motion_, {blocks.begin(), learnt}),
                                       blocks_of(motion_, {learnt + 1, blocks.end()}), references_,
                                       targets_, rule_);
  }

  analysis::OperatingSpectra motion_;
  std::vector<DegreeOfFreedom> references_, targets_;
  analysis::RegularisationRule rule_;
};

void read_by_operation(hal::ConfigReader& json, TpaProject& project) {
  project.step_Hz = json.number("step_Hz", steps);
  project.paths = project.indicators;
  for (const char* key : {"frfs", "hammer", "paths", "least_coherence"}) {
    if (json.has(key)) json.fault(key, "operation alone has no FRFs");
  }
  if (analysis::find_rule(project.rule)->needs_noise) {
    json.fault("rule", project.rule + " needs FRFs, and operation alone has none");
  }
}

MadeTpaMethod make_by_operation(const TpaProject& project, const TpaFrfs&,
                                analysis::OperatingSpectra motion) {
  const Index learnt = learnt_of(motion.values.columns);
  const Index needed = blocks_per_reference * Index(project.indicators.size());
  constexpr Index fewest_held_out = 2;
  if (learnt < needed || motion.values.columns - learnt - 1 < fewest_held_out) {
    return fmt::format(
        "{} blocks of {:g} s to learn from, of {}, cannot tell {} references apart: {} at least; "
        "a longer recording, a larger step_Hz or fewer references",
        learnt, 1 / motion.grid.step_Hz, motion.values.columns, project.indicators.size(), needed);
  }
  return std::make_unique<ByOperation>(project, std::move(motion));
}

}  // namespace

NamedTpaMethod operational_method() {
  return {"operational",
          "No force is known: what each reference sensor hands on to the targets is learnt from "
          "two thirds of the blocks of operation, cross-talk cancelled by their singular values, "
          "and held against the rest. A source that no reference is near is handed to those that "
          "move with it.",
          false, read_by_operation, make_by_operation};
}

}  // namespace rvbench::bench
