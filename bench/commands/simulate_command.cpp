#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <mutex>
#include <system_error>

#include "bench/campaign_points.hpp"
#include "bench/campaign_source.hpp"
#include "bench/commands/commands.hpp"
#include "bench/converted_files.hpp"
#include "bench/file_kind.hpp"
#include "bench/find_plan.hpp"
#include "bench/plan_files.hpp"
#include "bench/planned_inputs.hpp"
#include "bench/progress_bar.hpp"
#include "bench/run_recordings.hpp"
#include "bench/simulated_recording.hpp"
#include "bench/stop_on_signal.hpp"
#include "bench/text_file.hpp"
#include "hal/did_you_mean.hpp"
#include "hal/types/parallel_for.hpp"
#include "sequences/timeline.hpp"
#include "sim/plant_files.hpp"
#include "sim/plant_json.hpp"
#include "sim/simulate.hpp"

namespace rvbench::bench {
namespace {

constexpr double rate_of_plans_Hz = 1000;
constexpr double most_samples = 1e8;  // of a plan: 4 GB

// What a plant is run along: a recording, or a point that a plan has.
struct Course {
  Recording like;
  DrivenBy driven;
};

using Courses = std::vector<Course>;

struct Run {
  std::vector<Recording> recordings;
  int substeps = 1;  ///< per sample, at most
};

class SimulateCommand final : public Command {
 public:
  std::string name() const override { return "simulate"; }
  std::string summary() const override {
    return "runs a plant along a recording or a plan, and writes what its sensors show";
  }
  std::string examples() const override {
    return "  rvbench simulate --plant silverbox --like SNLS80mV.csv --rate 610.35 --out sim.csv\n"
           "  rvbench simulate --plant explained/plant_updated.json --like run1.csv --out "
           "sim.csv\n"
           "  rvbench simulate --plant rv20e_bench --like runs/A17/20260102T030405Z --out sim.h5\n"
           "  rvbench simulate --plant rv20e_bench --plan quick --out sim.h5\n";
  }
  std::vector<Option> options() override {
    return {{"--plant", "plant: " + hal::listed(names_of(sim::plant_files())) + ", or a plant file",
             &plant_, true},
            {"--like", "recording that holds the plant's inputs, or a run whose plan says them",
             &like_},
            {"--plan",
             "instead: all points of a plan: " + hal::listed(names_of(plan_files())) +
                 ", or a plan file",
             &plan_},
            {"--rate",
             fmt::format("sample rate [Hz]; default: what the file states, {:g} of a plan",
                         rate_of_plans_Hz),
             &rate_Hz_},
            {"--out",
             "file to write: .csv with time, inputs and outputs, or .h5 with torque and angle of "
             "every point",
             &out_, true}};
  }
  int run(Console& console) override;

 private:
  std::variant<Courses, int> courses(Console& console, const sim::PlantSpec& plant) const;
  std::variant<Courses, int> courses_of_plan(Console& console, const sim::PlantSpec& plant) const;
  std::variant<Courses, int> courses_like(Console& console, const sim::PlantSpec& plant) const;
  std::variant<Run, int> simulated(Console& console, const sim::PlantSpec& plant,
                                   const Courses& along) const;
  int write(Console& console, const Run& run) const;

  std::string plant_, like_, plan_, out_;
  std::optional<double> rate_Hz_;
};

// Why a file must not be written; empty if it may.
std::string why_not_written(const std::string& out, const std::vector<std::string>& made_from) {
  std::error_code none;
  for (const std::string& from : made_from) {
    const std::filesystem::path folder = std::filesystem::path(out).parent_path();
    if (std::filesystem::is_directory(from, none) &&
        std::filesystem::equivalent(folder.empty() ? "." : folder, from, none)) {
      return out + " would be part of the run that it is made from";
    }
  }
  if (!std::filesystem::exists(out, none)) return {};
  if (!std::filesystem::is_regular_file(out, none)) return out + " is no regular file";
  return made_from_fault(out, made_from);
}

std::string name_of(const Recording& recording) {
  return std::isnan(recording.load_pct)
             ? recording.source
             : fmt::format("{:g} rpm, {:g} %", recording.planned_speed_rpm, recording.load_pct);
}

// A course, and what the plant's sensors show along it.
Recording simulated_along(const Course& course, const sim::PlantSpec& plant,
                          std::vector<Channel> shown) {
  Recording made = course.like;
  made.channels.clear();
  for (const sim::InputSpec& input : plant.inputs) {
    made.channels.push_back(*find_channel(course.driven.channels, input.channel));
  }
  for (Channel& channel : shown) made.channels.push_back(std::move(channel));
  for (Channel& channel : made.channels) drop_lead_in(channel, course.driven.lead_in);
  return made;
}

// Whose clock counts: that of the plant's inputs, or of the torque beside which a plan says them.
std::vector<std::string> clock_of(const sim::PlantSpec& plant) {
  std::vector<std::string> names;
  for (const sim::InputSpec& input : plant.inputs) names.push_back(input.channel);
  names.emplace_back(channel_names::input_torque);
  return names;
}

std::variant<Courses, int> SimulateCommand::courses_of_plan(Console& console,
                                                            const sim::PlantSpec& plant) const {
  const auto read = find_plan(plan_);
  if (read.index() == 1) return refuse_file(console, plan_, std::get<1>(read));
  const sequences::TestPlan& plan = std::get<0>(read);
  const double rate_Hz = rate_Hz_.value_or(rate_of_plans_Hz);
  const double samples = sequences::planned_duration_s(plan) * rate_Hz;
  if (samples > most_samples) {
    return refuse_usage(console, fmt::format("simulate: --rate: {:.2g} samples are too many: {:g} "
                                             "are the most",
                                             samples, most_samples));
  }
  Courses all;
  for (Recording& point : points_of(plan, rate_Hz)) {
    auto driven = planned_inputs(plant, point, plan.specimen.rated_output_torque_Nm);
    if (!driven) {
      return refuse_file(console, plant_,
                         {{0, "/inputs",
                           "a plan drives an induction_motor by the input supply, and a brake by "
                           "brake_torque: this plant lacks them"}});
    }
    all.push_back({std::move(point), *std::move(driven)});
  }
  return all;
}

std::variant<Courses, int> SimulateCommand::courses_like(Console& console,
                                                         const sim::PlantSpec& plant) const {
  std::vector<std::filesystem::path> files{like_};
  if (std::filesystem::is_directory(like_)) {
    const std::vector<std::string> faults = run_faults(like_);
    for (const std::string& fault : faults) refuse_data(console, like_ + ": " + fault);
    if (!faults.empty()) return exit_codes::data_refused;
    files.clear();
    for (const std::string& name : recording_names(like_)) {
      files.push_back(std::filesystem::path(like_) / name);
    }
    if (files.empty())
      return refuse_data(console, like_ + ": no run folder: it holds no recording");
  }
  Courses all;
  for (const std::filesystem::path& file : files) {
    std::vector<std::string> notes;
    auto read = read_source({file.string(), rate_Hz_.value_or(not_known)}, clock_of(plant), notes);
    if (const auto* why = std::get_if<std::string>(&read)) return refuse_data(console, *why);
    for (const std::string& note : notes) console.err << "note: " << note << '\n';
    const double rated_Nm = rated_torque_beside_Nm(file);
    for (Recording& recording : std::get<0>(read)) {
      DrivenBy driven = what_drove(plant, recording, rated_Nm);
      all.push_back({std::move(recording), std::move(driven)});
    }
  }
  return all;
}

std::variant<Courses, int> SimulateCommand::courses(Console& console,
                                                    const sim::PlantSpec& plant) const {
  return plan_.empty() ? courses_like(console, plant) : courses_of_plan(console, plant);
}

int SimulateCommand::run(Console& console) {
  if (!is_rate(console, rate_Hz_)) return exit_codes::usage;
  if (like_.empty() == plan_.empty()) {
    return refuse_usage(console, "simulate: one of --like and --plan is required, and one only");
  }
  if (const std::string why = why_not_written(out_, {like_, plan_, plant_}); !why.empty()) {
    return refuse_usage(console, "simulate: --out: " + why);
  }
  if (!out_.ends_with(".csv") && !out_.ends_with(".h5")) {
    return refuse_usage(console, "simulate: --out: must end in .csv or .h5: " + out_);
  }
  const auto read = sim::read_plant(plant_);
  if (read.index() == 1) return refuse_file(console, plant_, std::get<1>(read));
  const sim::PlantSpec& plant = std::get<0>(read);
  auto made = courses(console, plant);
  if (const int* refused = std::get_if<int>(&made)) return *refused;
  const Courses& along = std::get<Courses>(made);
  if (along.size() > 1 && !out_.ends_with(".h5")) {
    return refuse_data(console, fmt::format("{} holds {} recordings; a CSV file takes one",
                                            like_ + plan_, along.size()));
  }
  auto done = simulated(console, plant, along);
  if (const int* refused = std::get_if<int>(&done)) return *refused;
  return write(console, std::get<Run>(done));
}

std::variant<Run, int> SimulateCommand::simulated(Console& console, const sim::PlantSpec& plant,
                                                  const Courses& along) const {
  const StopOnSignal signals;
  ProgressBar bar(console, progress_style(console, false));
  std::mutex one_at_a_time;
  std::size_t done = 0;
  Run run{std::vector<Recording>(along.size())};
  std::vector<std::optional<hal::ConfigFault>> faults(along.size());
  parallel_for(along.size(), [&](std::size_t i) {
    if (signals.token().stop_requested()) return;
    auto shown = sim::simulate(plant, along[i].driven.channels);
    const std::scoped_lock locked(one_at_a_time);
    if (auto* fault = std::get_if<hal::ConfigFault>(&shown)) {
      faults[i] = std::move(*fault);
      return;
    }
    run.substeps = std::max(run.substeps, std::get<0>(shown).substeps);
    run.recordings[i] = simulated_along(along[i], plant, std::move(std::get<0>(shown).channels));
    if (along.size() > 1) {
      bar.show("simulate", double(++done) / double(along.size()), name_of(along[i].like));
    }
  });
  bar.clear();
  if (signals.token().stop_requested()) return tell_interrupted(console, name());
  for (const auto& fault : faults) {
    if (!fault) continue;
    refuse_file(console, plant_, {*fault});
    const bool of_recording = fault->pointer.starts_with("/inputs");
    return of_recording ? exit_codes::data_refused : exit_codes::bad_file;
  }
  return run;
}

int SimulateCommand::write(Console& console, const Run& run) const {
  try {
    if (out_.ends_with(".h5")) {
      const Status written = write_hdf5(out_, run.recordings);
      if (!written) return refuse_usage(console, "simulate: " + describe(written.error()));
    } else {
      write_file(out_, csv_of(run.recordings.front()));
    }
  } catch (const std::system_error& error) {
    return refuse_usage(console, "simulate: " + std::string(error.what()));
  }
  Eigen::Index samples = 0;
  for (const Recording& recording : run.recordings)
    samples += recording.channels.front().samples.size();
  const std::string of_points =
      run.recordings.size() > 1 ? fmt::format(" of {} points", run.recordings.size()) : "";
  console.out << fmt::format("{}: {} samples{} at {:g} Hz, {} steps each\n", out_, samples,
                             of_points, run.recordings.front().channels.front().rate_Hz,
                             run.substeps);
  return exit_codes::done;
}

}  // namespace

std::unique_ptr<Command> make_simulate_command() { return std::make_unique<SimulateCommand>(); }

}  // namespace rvbench::bench
