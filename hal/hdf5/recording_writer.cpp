#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <optional>
#include <stdexcept>

#include "hal/hdf5/hdf5_handle.hpp"
#include "hal/hdf5/hdf5_writer.hpp"
#include "hal/hdf5/journal.hpp"
#include "hal/hdf5/journal_record.hpp"
#include "hal/recording_file.hpp"

namespace rvbench::hal {
namespace {

using namespace hdf5;

void check_layout(const RecordingLayout& layout) {
  const auto positive = [](double rate_Hz) { return std::isfinite(rate_Hz) && rate_Hz > 0; };
  const auto bug = [](const std::string& what) {
    throw std::invalid_argument("RecordingWriter::create: " + what);
  };
  if (layout.points.empty()) bug("no points");
  if (!layout.acceleration_channels.empty() && !positive(layout.acceleration_rate_Hz)) {
    bug(fmt::format("acceleration_rate_Hz {} is not above 0", layout.acceleration_rate_Hz));
  }
  if (layout.torque_rate_Hz != 0 && !positive(layout.torque_rate_Hz)) {
    bug(fmt::format("torque_rate_Hz {} is not above 0", layout.torque_rate_Hz));
  }
}

// The HDF5 file and its journal. Each step goes to the file first, which checks what it is given,
// and counts once the journal has it as well.
class JournaledWriter final : public RecordingWriter {
 public:
  JournaledWriter(std::filesystem::path path, const RecordingLayout& layout, RecordingPace pace)
      : path_(std::move(path)), journal_(path_, layout, pace.sync) {
    try {
      file_ = make_hdf5_writer(path_, layout, pace.flush);
      put_folder_on_disk(path_);
    } catch (const FileFailure&) {
      abandon();
      throw;
    }
  }

  ~JournaledWriter() override;

  Status append(int point, const AccelerationBlock& block) override {
    return keep([&] { return file_->append(point, block); },
                [&] {
                  if (block.scans.rows() > 0) journal_.add(bytes_of(point, block));
                });
  }
  Status append(int point, const TorqueBlock& block) override {
    return keep([&] { return file_->append(point, block); },
                [&] {
                  if (!block.samples.empty()) journal_.add(bytes_of(point, block));
                });
  }
  Status end_point(const PointResult& result) override {
    return keep([&] { return file_->end_point(result); },
                [&] {
                  journal_.add(bytes_of(result));
                  journal_.sync();  // from here on it counts as measured
                });
  }
  Status note(double time_s, const std::string& event) override {
    return keep([&] { return file_->note(time_s, event); },
                [&] { journal_.add(bytes_of(time_s, event)); });
  }
  Status close() override;

 private:
  template <typename ToFile, typename ToJournal>
  Status keep(ToFile&& to_file, ToJournal&& to_journal);
  void abandon();

  std::filesystem::path path_;
  Journal journal_;
  std::unique_ptr<RecordingWriter> file_;
  std::optional<IoError> failure_;  // the first one: after it nothing more is written
  bool is_closed_ = false;
};

JournaledWriter::~JournaledWriter() {
  try {
    static_cast<void>(close());
  } catch (...) {  // out of memory, say: whoever wanted to know has called close()
  }
}

// Once a step failed, all later ones fail likewise: a recording with a hole in it must not look
// whole.
template <typename ToFile, typename ToJournal>
Status JournaledWriter::keep(ToFile&& to_file, ToJournal&& to_journal) {
  if (failure_) return *failure_;
  Status status = to_file();
  if (status) {
    status = guarded(path_, [&]() -> Status {
      to_journal();
      journal_.check_disk();
      return Done{};
    });
  }
  if (!status) failure_ = status.error();
  return status;
}

// The journal goes last: as long as it is there, nobody trusts the file beside it.
Status JournaledWriter::close() {
  if (is_closed_ && !failure_) return Done{};
  const Status status = keep([&] { return file_->close(); },
                             [&] {
                               journal_.check_disk();
                               put_on_disk(path_);
                               journal_.remove();
                             });
  is_closed_ = true;
  return status;
}

// Of a recording that could not be begun: the journal says that there is none.
void JournaledWriter::abandon() {
  std::error_code ignored;
  if (file_ != nullptr) std::filesystem::remove(path_, ignored);
  std::filesystem::remove(journal_of(path_), ignored);
}

}  // namespace

Result<std::unique_ptr<RecordingWriter>> RecordingWriter::create(const std::filesystem::path& file,
                                                                 const RecordingLayout& layout,
                                                                 RecordingPace pace) {
  check_layout(layout);
  return guarded(file, [&]() -> Result<std::unique_ptr<RecordingWriter>> {
    if (std::filesystem::exists(file)) throw FileFailure(IoErrc::refused, "create: exists already");
    return std::unique_ptr<RecordingWriter>(std::make_unique<JournaledWriter>(file, layout, pace));
  });
}

}  // namespace rvbench::hal
