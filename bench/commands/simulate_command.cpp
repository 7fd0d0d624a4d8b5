#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "bench/commands/commands.hpp"
#include "bench/file_kind.hpp"
#include "bench/planned_inputs.hpp"
#include "bench/run_folder.hpp"
#include "bench/simulated_recording.hpp"
#include "hal/formats/read_recordings.hpp"
#include "sim/plant_files.hpp"
#include "sim/plant_json.hpp"
#include "sim/simulate.hpp"

namespace rvbench::bench {
namespace {

class SimulateCommand final : public Command {
 public:
  std::string name() const override { return "simulate"; }
  std::string summary() const override {
    return "runs a plant along the inputs of a recording, and writes what its sensors show";
  }
  std::string examples() const override {
    return "  rvbench simulate --plant silverbox --like SNLS80mV.csv --rate 610.35 --out sim.csv\n"
           "  rvbench simulate --plant explained/plant_updated.json --like run1.csv --out "
           "sim.csv\n"
           "  rvbench simulate --plant rv20e_bench --like runs/A17/20260102T030405Z/recording.h5 "
           "--out sim.h5\n";
  }
  std::vector<Option> options() override {
    return {{"--plant", "plant: " + listed(names_of(sim::plant_files())) + ", or a plant file",
             &plant_, true},
            {"--like", "recording that holds the plant's inputs, or a run whose plan says them",
             &like_, true},
            {"--rate", "sample rate [Hz]; default: what the file states", &rate_Hz_},
            {"--out",
             "file to write: .csv with time, inputs and outputs, or .h5 with torque and angle of "
             "every point",
             &out_, true}};
  }
  int run(Console& console) override;

 private:
  int simulate(Console& console, const sim::PlantSpec& plant, const Recording& recording,
               std::vector<Recording>& simulated, int& substeps) const;
  void tell(Console& console, const std::vector<Recording>& simulated, int substeps) const;

  std::string plant_, like_, out_;
  std::optional<double> rate_Hz_;
};

// Why a file must not be written; empty if it may.
std::string why_not_written(const std::string& out, const std::vector<std::string>& made_from) {
  std::error_code none;
  if (!std::filesystem::exists(out, none)) return {};
  if (!std::filesystem::is_regular_file(out, none)) return out + " is no regular file";
  for (const std::string& from : made_from) {
    if (std::filesystem::equivalent(out, from, none)) return out + " is what it would be made from";
  }
  return {};
}

int SimulateCommand::run(Console& console) {
  if (!is_positive(console, "--rate", rate_Hz_)) return exit_codes::usage;
  if (const std::string why = why_not_written(out_, {like_, plant_}); !why.empty()) {
    return refuse_usage(console, "simulate: --out: " + why);
  }
  const auto plant = sim::read_plant(plant_);
  if (plant.index() == 1) return refuse_file(console, plant_, std::get<1>(plant));
  const sim::PlantSpec& spec = std::get<0>(plant);
  auto read = hal::read_recordings(like_, {rate_Hz_.value_or(not_known), not_known});
  if (!read) return refuse_data(console, read.error().where);
  const bool as_hdf5 = out_.ends_with(".h5");
  if (read.value().size() > 1 && !as_hdf5) {
    return refuse_data(console, fmt::format("{} holds {} recordings; a CSV file takes one", like_,
                                            read.value().size()));
  }
  std::vector<Recording> simulated;
  int substeps = 0;
  for (const Recording& recording : read.value()) {
    const int code = simulate(console, spec, recording, simulated, substeps);
    if (code != exit_codes::done) return code;
  }
  try {
    if (as_hdf5) {
      const Status written = write_hdf5(out_, simulated);
      if (!written) return refuse_usage(console, "simulate: " + describe(written.error()));
    } else {
      write_file(out_, csv_of(simulated.front()));
    }
  } catch (const std::system_error& error) {
    return refuse_usage(console, "simulate: " + std::string(error.what()));
  }
  tell(console, simulated, substeps);
  return exit_codes::done;
}

// Adds the inputs of one recording and what the plant makes of them.
int SimulateCommand::simulate(Console& console, const sim::PlantSpec& plant,
                              const Recording& recording, std::vector<Recording>& simulated,
                              int& substeps) const {
  const DrivenBy driven = what_drove(plant, recording, like_);
  auto run = sim::simulate(plant, driven.channels);
  if (const auto* fault = std::get_if<hal::ConfigFault>(&run)) {
    refuse_file(console, plant_, {*fault});
    const bool of_recording = fault->pointer.starts_with("/inputs");
    return of_recording ? exit_codes::data_refused : exit_codes::bad_file;
  }
  auto& shown = std::get<sim::Simulated>(run);
  substeps = shown.substeps;
  Recording made = recording;
  made.channels.clear();
  for (const sim::InputSpec& input : plant.inputs) {
    made.channels.push_back(*find_channel(driven.channels, input.channel));
  }
  for (Channel& channel : shown.channels) made.channels.push_back(std::move(channel));
  for (Channel& channel : made.channels) drop_lead_in(channel, driven.lead_in);
  simulated.push_back(std::move(made));
  return exit_codes::done;
}

void SimulateCommand::tell(Console& console, const std::vector<Recording>& simulated,
                           int substeps) const {
  Eigen::Index samples = 0;
  for (const Recording& recording : simulated) samples += recording.channels.front().samples.size();
  const std::string of_points =
      simulated.size() > 1 ? fmt::format(" of {} points", simulated.size()) : "";
  console.out << fmt::format("{}: {} samples{} at {:g} Hz, {} steps each\n", out_, samples,
                             of_points, simulated.front().channels.front().rate_Hz, substeps);
}

}  // namespace

std::unique_ptr<Command> make_simulate_command() { return std::make_unique<SimulateCommand>(); }

}  // namespace rvbench::bench
