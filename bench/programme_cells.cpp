#include "bench/programme_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace rvbench::bench {
namespace {

constexpr double stretch_s = 0.25;
constexpr Eigen::Index most_stretches = 100;
constexpr Eigen::Index fewest_samples = 4;   // of a stretch
constexpr Eigen::Index fewest_degrees = 40;  // of freedom, to tell chance by

using Repeats = std::vector<const ProgrammeRecord*>;

// Means of as many stretches of equal length.
Eigen::VectorXd means_of(const Eigen::VectorXd& x, Eigen::Index stretches) {
  Eigen::VectorXd means(stretches);
  for (Eigen::Index i = 0; i < stretches; ++i) {
    const Eigen::Index from = x.size() * i / stretches;
    means[i] = x.segment(from, x.size() * (i + 1) / stretches - from).mean();
  }
  return means;
}

// One column for each repeat.
Eigen::MatrixXd table_of(const Repeats& repeats, std::size_t output, Eigen::Index stretches) {
  Eigen::MatrixXd table(stretches, static_cast<Eigen::Index>(repeats.size()));
  for (Eigen::Index r = 0; r < table.cols(); ++r) {
    table.col(r) = means_of(repeats[std::size_t(r)]->apart[output], stretches);
  }
  return table;
}

Eigen::Index stretches_of(const Repeats& repeats) {
  const ProgrammeRecord& first = *repeats.front();
  return std::min({static_cast<Eigen::Index>(first.length_s / stretch_s), most_stretches,
                   first.apart.front().size() / fewest_samples});
}

void add_cells(const sim::OutputSpec& output, const Repeats& repeats, const Eigen::MatrixXd& table,
               Twin::Cells& cells) {
  const ProgrammeRecord& first = *repeats.front();
  const auto count = static_cast<double>(table.cols());
  const Eigen::VectorXd mean = table.rowwise().mean();
  const double of_one = std::sqrt((table.colwise() - mean).squaredNorm() /
                                  (static_cast<double>(table.rows()) * (count - 1)));
  if (!(of_one > 0)) return;
  const double each_s = first.length_s / static_cast<double>(table.rows());
  for (Eigen::Index i = 0; i < table.rows(); ++i) {
    cells.all.push_back({output.channel, output.unit, first.programme,
                         analysis::LockedTo::programme,
                         first.first_s + (static_cast<double>(i) + 0.5) * each_s, mean[i],
                         of_one / std::sqrt(count)});
  }
  cells.beside = std::max(cells.beside, 1.5 * each_s);
  cells.noise.push_back(
      {output.channel,
       fmt::format("mean over {:.2g} s, from repeat to repeat of {}", each_s, first.programme),
       output.unit, of_one});
}

}  // namespace

Twin::Cells programme_cells(const std::vector<sim::OutputSpec>& outputs,
                            const std::vector<ProgrammeRecord>& records) {
  std::map<std::string, Repeats> programmes;
  for (const ProgrammeRecord& record : records) programmes[record.programme].push_back(&record);
  Twin::Cells cells;
  for (const auto& [name, repeats] : programmes) {
    const Eigen::Index stretches = stretches_of(repeats);
    if (stretches * (Eigen::Index(repeats.size()) - 1) < fewest_degrees) continue;
    for (std::size_t o = 0; o < outputs.size(); ++o) {
      add_cells(outputs[o], repeats, table_of(repeats, o, stretches), cells);
    }
  }
  return cells;
}

}  // namespace rvbench::bench
