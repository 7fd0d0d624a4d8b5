#include <algorithm>
#include <charconv>
#include <filesystem>

#include "bench/commands/commands.hpp"
#include "bench/converted_files.hpp"
#include "hal/did_you_mean.hpp"
#include "hal/formats/choose_writer.hpp"
#include "hal/formats/read_recordings.hpp"

namespace rvbench::bench {
namespace {

std::vector<std::string> format_keys() {
  std::vector<std::string> keys;
  for (const auto& writer : hal::formats::known_writers()) keys.emplace_back(writer.key);
  return keys;
}

class ExportCommand final : public Command {
 public:
  std::string name() const override { return "export"; }
  std::string summary() const override {
    return "writes recordings in the formats of other programs";
  }
  std::string examples() const override {
    return "  rvbench export runs/A17/20260102T030405Z/recording.h5 --to all.tdms\n"
           "  rvbench export recording.h5 --point 12 --to point.uff --format uff58b\n"
           "  rvbench export recording.h5 --to points.mat           # points_000.mat ...\n"
           "  rvbench export IR007_0.mat --rate 12000 --to bearing.flac\n";
  }
  std::vector<Option> options() override {
    return {
        {"REC", "recording, of any format that import reads", &file_, true},
        {"--to", "file to write; one of each point where the format holds one only", &to_, true},
        {"--format", "default: by the ending: .h5, .tdms, .uff, .mat (v5), .wav, .flac, .csv",
         &format_, false, format_keys()},
        {"--point", "number of a point, or its name in the file; default: all", &points_},
        {"--rate", "sample rate [Hz]; default: what the file states", &rate_Hz_},
        {"--force", "replace files that are there", &force_}};
  }
  int run(Console& console) override;

 private:
  std::string file_, to_, format_;
  std::vector<std::string> points_;
  std::optional<double> rate_Hz_;
  bool force_ = false;
};

std::optional<int> number_in(const std::string& text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_whole = error == std::errc() && end == text.data() + text.size();
  return is_whole ? std::optional<int>(number) : std::nullopt;
}

bool is_named(const Recording& recording, const std::string& wanted) {
  const std::string name = point_source(recording).point;
  return name == wanted || (number_in(wanted) && number_in(wanted) == number_in(name));
}

// The points that are wanted, in the order of the file. @return the name of one that is not there
std::string choose_points(const std::vector<std::string>& wanted, std::vector<Recording>& all) {
  if (wanted.empty()) return "";
  for (const std::string& point : wanted) {
    if (std::ranges::none_of(all, [&](const Recording& r) { return is_named(r, point); })) {
      return point;
    }
  }
  std::erase_if(all, [&wanted](const Recording& recording) {
    return std::ranges::none_of(
        wanted, [&](const std::string& point) { return is_named(recording, point); });
  });
  return "";
}

int ExportCommand::run(Console& console) {
  if (!is_rate(console, rate_Hz_)) return exit_codes::usage;
  const auto writer = hal::formats::choose_writer(to_, format_);
  if (!writer) {
    return refuse_usage(console, "export: --to: " + to_ +
                                     " has no ending that says a format; give one with --format: " +
                                     hal::listed(format_keys()));
  }
  if (const std::string fault = made_from_fault(to_, {file_}); !fault.empty()) {
    return refuse_usage(console, "export: --to: " + fault);
  }
  std::error_code unknown;
  if (std::filesystem::is_directory(to_, unknown)) {
    return refuse_usage(console, "export: --to: " + to_ + " is a folder: name a file in it");
  }
  auto read = hal::read_recordings(file_, {.rate_Hz = rate_Hz_.value_or(not_known)});
  if (!read) return refuse_data(console, read.error().where);
  std::vector<Recording> points = std::move(read).value();
  std::vector<std::string> names;
  for (const Recording& point : points) names.push_back(point_source(point).point);
  if (const std::string absent = choose_points(points_, points); !absent.empty()) {
    const bool has_one_only = points.size() == 1 && names.front().empty();
    return refuse_usage(console, "export: --point: " + file_ + " has no point " + absent +
                                     (has_one_only ? ": it holds one recording only"
                                                   : "; it has " + hal::listed(names)));
  }
  for (Recording& recording : points) {
    if (const auto fault = prepare_for_writing(recording)) return refuse_data(console, *fault);
  }
  const auto written = hal::write_recordings(points, to_, *writer, force_);
  if (!written) return refuse_writing(console, "export: --to", written.error());
  tell_notes_of(console, points);
  tell_left_out_events(console, file_);
  tell_written(console, written.value());
  return exit_codes::done;
}

}  // namespace

std::unique_ptr<Command> make_export_command() { return std::make_unique<ExportCommand>(); }

}  // namespace rvbench::bench
