#pragma once

#include <cstddef>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "hal/recording_file.hpp"
#include "sequences/scribe.hpp"
#include "sequences/sequencer.hpp"

namespace rvbench::sequences {

/// A recording that takes everything at once and has it written by a scribe.
///
/// Errors   of the disk come with a later call, at the latest with settle(): until that has
///          succeeded nothing counts as written. overrun: the disk has fallen too far behind
class RecordingBehind final : public hal::RecordingWriter {
 public:
  /// Both must outlive it.
  RecordingBehind(hal::RecordingWriter& recording, Scribe& scribe)
      : recording_(recording), scribe_(scribe) {}
  ~RecordingBehind() override { scribe_.finish(); }  // whose jobs know this object
  RecordingBehind(const RecordingBehind&) = delete;
  RecordingBehind& operator=(const RecordingBehind&) = delete;

  Status append(int point, const hal::AccelerationBlock& block) override;
  Status append(int point, const hal::TorqueBlock& block) override;
  Status end_point(const hal::PointResult& result) override;
  Status note(double time_s, const std::string& event) override;
  Status close() override { return settle(); }  ///< the recording itself is its owner's to close

  Status settle();  ///< waits until all is written, and says how that went

 private:
  Status post(std::size_t bytes, std::function<Status()> write);
  Status so_far() const;
  void fail(IoError error);

  hal::RecordingWriter& recording_;
  Scribe& scribe_;
  mutable std::mutex mutex_;
  std::optional<IoError> failure_;  // the first one
};

/// An observer whose log and screen may take their time, and hang.
///
/// Progress is left out while its screen is behind. Events wait for the log, as many as its scribe
/// takes; more are left out, and once there is room it is told how many. The recording has them
/// all.
class ObserverBehind final : public RunObserver {
 public:
  /// All must outlive it.
  ObserverBehind(RunObserver& observer, Scribe& log, Scribe& screen)
      : observer_(observer), log_(log), screen_(screen) {}

  void progress(double done_s, double total_s, const std::string& doing) override;
  void event(double time_s, const std::string& text) override;

  /// Waits for the log and the screen, as long as they may need and not for ever.
  /// @return false if a call of the observer hangs: see Scribe::finish_within()
  bool finish();
  std::size_t untold() const { return untold_; }  ///< events that were left out, since told last

 private:
  bool tell(double time_s, const std::string& text);

  RunObserver& observer_;
  Scribe& log_;
  Scribe& screen_;
  std::size_t untold_ = 0;
};

}  // namespace rvbench::sequences
