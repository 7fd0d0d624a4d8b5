#include "bench/serve/tell_live.hpp"

#include <memory>
#include <system_error>

#include "bench/serve/live_feed.hpp"
#include "bench/serve/watched_rig.hpp"
#include "bench/text_file.hpp"

namespace rvbench::bench {

void tell_live(const std::string& socket, hal::Rig& rig, Acceptance& acceptance, ProgressBar& bar) {
  try {
    const auto run = acceptance.folder.parent_path().filename() / acceptance.folder.filename();
    const auto feed = std::make_shared<LiveFeed>(LiveSocket::to(socket), run.string(),
                                                 acceptance.plan.points().size());
    watch(rig, feed);
    acceptance.begin_recording = watched_recording(acceptance.begin_recording, feed);
    bar.tell([feed](const std::string& stage, double fraction, double left_s,
                    const std::string& doing) { feed->progress(stage, fraction, left_s, doing); });
  } catch (const std::system_error& error) {
    acceptance.warnings.push_back("--live: " + reason_of(error));
  }
}

}  // namespace rvbench::bench
