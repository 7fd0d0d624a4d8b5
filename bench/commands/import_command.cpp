#include <filesystem>

#include "bench/commands/commands.hpp"
#include "bench/commands/table_words.hpp"
#include "bench/converted_files.hpp"
#include "hal/formats/choose_writer.hpp"
#include "hal/formats/read_recordings.hpp"

namespace rvbench::bench {
namespace {

class ImportCommand final : public Command {
 public:
  std::string name() const override { return "import"; }
  std::string summary() const override {
    return "brings recordings of other programs into one of rvbench's own format";
  }
  std::string examples() const override {
    return "  rvbench import drive_end.tdms --out drive_end.h5\n"
           "  rvbench import IR007_0.mat --rate 12000 --speed 1797 --out bearing.h5\n"
           "  rvbench import p1.uff p2.uff p3.uff --out points.h5   # a point of each\n";
  }
  std::vector<Option> options() override {
    std::vector<Option> options{
        {"FILE", "recordings: HDF5, TDMS, UFF 58 and 58b, MAT v5 and v7.3, WAV, FLAC, CSV", &files_,
         true},
        {"--out", "file to write, .h5", &out_, true},
        {"--rate", "sample rate [Hz]; default: what the files state", &rate_Hz_},
        {"--speed", "speed of the input shaft [rpm]; default: what the files state", &speed_rpm_},
        {"--force", "replace the file that --out names", &force_}};
    table_.add_to(options);
    return options;
  }
  int run(Console& console) override;

 private:
  std::vector<std::string> files_;
  std::string out_;
  std::optional<double> rate_Hz_, speed_rpm_;
  bool force_ = false;
  TableWords table_;
};

int ImportCommand::run(Console& console) {
  if (!is_positive(console, "--speed", speed_rpm_) || !is_rate(console, rate_Hz_)) {
    return exit_codes::usage;
  }
  const auto writer = hal::formats::choose_writer(out_);
  if (!writer || writer->key != "hdf5") {
    return refuse_usage(console, "import: --out: must end in .h5: " + out_);
  }
  if (const std::string fault = made_from_fault(out_, files_); !fault.empty()) {
    return refuse_usage(console, "import: --out: " + fault);
  }
  if (const Status place = hal::formats::check_place(out_, force_); !place) {
    return refuse_writing(console, "import: --out", place.error());
  }
  std::vector<Recording> points;
  for (const std::string& file : files_) {
    auto read = hal::read_recordings(file, {.rate_Hz = rate_Hz_.value_or(not_known),
                                            .speed_rpm = speed_rpm_.value_or(not_known),
                                            .table = table_.hints()});
    if (!read) return refuse_data(console, read.error().where);
    for (Recording& recording : std::move(read).value()) {
      if (const auto fault = prepare_for_writing(recording)) return refuse_data(console, *fault);
      points.push_back(std::move(recording));
    }
  }
  const auto written = hal::write_recordings(points, out_, *writer, force_);
  if (!written) return refuse_writing(console, "import: --out", written.error());
  tell_notes_of(console, points);
  for (const std::string& file : files_) tell_left_out_events(console, file);
  tell_written(console, written.value());
  return exit_codes::done;
}

}  // namespace

std::unique_ptr<Command> make_import_command() { return std::make_unique<ImportCommand>(); }

}  // namespace rvbench::bench
