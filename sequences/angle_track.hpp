#pragma once

#include <deque>

namespace rvbench::sequences {

/// The newest angles of the input shaft, and the speed that they tell. It owes nothing to what the
/// drive believes.
class AngleTrack {
 public:
  void add(double time_s, double angle_rad);  ///< at a time that goes on

  /// Over the shortest stretch of at least `window_s` that ends with the newest angle; NaN if there
  /// is none.
  double speed_rpm(double window_s) const;
  bool is_empty() const { return points_.empty(); }
  double newest_s() const { return points_.back().time_s; }  ///< @pre not empty

 private:
  struct Point {
    double time_s, angle_rad;
  };
  std::deque<Point> points_;
};

}  // namespace rvbench::sequences
