#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "bench/commands/commands.hpp"
#include "bench/file_kind.hpp"
#include "bench/run_folder.hpp"
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
           "sim.csv\n";
  }
  std::vector<Option> options() override {
    return {{"--plant", "plant: " + listed(names_of(sim::plant_files())) + ", or a plant file",
             &plant_, true},
            {"--like", "recording that holds the plant's inputs", &like_, true},
            {"--rate", "sample rate [Hz]; default: what the file states", &rate_Hz_},
            {"--out", "CSV file to write: time, inputs and outputs", &out_, true}};
  }
  int run(Console& console) override;

 private:
  std::string plant_, like_, out_;
  std::optional<double> rate_Hz_;
};

// The inputs as they were recorded, then the outputs as they were simulated.
std::string csv_of(const std::vector<const Channel*>& channels) {
  const Channel& first = *channels.front();
  std::string text = "time_s";
  for (const Channel* channel : channels) text += ',' + channel->info.name;
  text += '\n';
  for (Eigen::Index i = 0; i < first.samples.size(); ++i) {
    text += fmt::format("{:.9g}", first.start_s + static_cast<double>(i) / first.rate_Hz);
    for (const Channel* channel : channels) text += fmt::format(",{:.9g}", channel->samples[i]);
    text += '\n';
  }
  return text;
}

int SimulateCommand::run(Console& console) {
  if (!is_positive(console, "--rate", rate_Hz_)) return exit_codes::usage;
  const auto plant = sim::read_plant(plant_);
  if (plant.index() == 1) return refuse_file(console, plant_, std::get<1>(plant));
  const sim::PlantSpec& spec = std::get<0>(plant);
  auto read = hal::read_recordings(like_, {rate_Hz_.value_or(not_known), not_known});
  if (!read) return refuse_data(console, read.error().where);
  if (read.value().size() > 1) {
    return refuse_data(console, fmt::format("{} holds {} recordings; simulate takes one", like_,
                                            read.value().size()));
  }
  const Recording& recording = read.value().front();
  const auto run = sim::simulate(spec, recording.channels);
  if (const auto* fault = std::get_if<hal::ConfigFault>(&run)) {
    refuse_file(console, plant_, {*fault});
    const bool of_recording = fault->pointer.starts_with("/inputs");
    return of_recording ? exit_codes::data_refused : exit_codes::bad_file;
  }
  const sim::Simulated& shown = std::get<sim::Simulated>(run);
  std::vector<const Channel*> channels;
  for (const sim::InputSpec& input : spec.inputs) channels.push_back(recording.find(input.channel));
  for (const Channel& channel : shown.channels) channels.push_back(&channel);
  try {
    write_file(out_, csv_of(channels));
  } catch (const std::system_error& error) {
    return refuse_usage(console, "simulate: " + std::string(error.what()));
  }
  console.out << fmt::format("{}: {} samples at {:g} Hz, {} steps each\n", out_,
                             shown.channels.front().samples.size(), shown.channels.front().rate_Hz,
                             shown.substeps);
  return exit_codes::done;
}

}  // namespace

std::unique_ptr<Command> make_simulate_command() { return std::make_unique<SimulateCommand>(); }

}  // namespace rvbench::bench
