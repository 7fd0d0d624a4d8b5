#include "analysis/evidence/article_reading.hpp"

#include <algorithm>
#include <cmath>

namespace rvbench::analysis {
namespace {

// The highest line within slip of an order: −ln p of it, for all the lines looked at.
ArticleReading::Line line_at(const EnvelopeSpectra& envelope, double order, double slip) {
  const LineFloor& floor = envelope.lines;
  const double resolution = envelope.whole.resolution;
  const auto last = floor.power.size() - 2;
  const auto bin = [&](double at) {
    return std::clamp<Eigen::Index>(std::lround(at / resolution), 2, last);
  };
  const Eigen::Index from = bin(order * (1 - slip)), to = bin(order * (1 + slip));
  ArticleReading::Line line{.order = order};
  for (Eigen::Index i = from; i <= to; ++i) {
    const double ratio = floor.log_ratio(i);
    if (ratio <= line.log_ratio) continue;
    const double excess = std::max(0.0, floor.power[i] - floor.floor[i]);
    line = {ratio, static_cast<double>(i) * resolution, std::sqrt(excess) / envelope.mean};
  }
  line.log_ratio -= std::log(static_cast<double>(to - from + 1));
  return line;
}

}  // namespace

ArticleReading::ArticleReading(const Kinematics& kinematics) {
  for (const Signature& part : kinematics.signatures) {
    parts_.push_back({.order = part.order, .slip = std::max(part.slip, part.tolerance)});
  }
}

void ArticleReading::add(const EnvelopeSpectra& envelope, int imf) {
  if (imf > article_imfs || envelope.lines.power.size() < 4) return;
  ++envelopes_;
  for (Part& part : parts_) {
    if (part.order > envelope.highest_order) continue;
    const Line line = line_at(envelope, part.order, part.slip);
    part.sum += line.log_ratio - 1;
    if (line.log_ratio <= part.line.log_ratio) continue;
    part.line = line;
    part.imf = imf;
  }
}

}  // namespace rvbench::analysis
