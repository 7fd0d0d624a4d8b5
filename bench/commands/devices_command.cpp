#include <net/if.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <exception>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <utility>

#include "bench/commands/commands.hpp"
#include "bench/commands/sim_choice.hpp"
#include "bench/fault_lines.hpp"
#include "bench/file_kind.hpp"
#include "bench/json_text.hpp"
#include "bench/rig_factory.hpp"
#include "bench/rig_file.hpp"
#include "bench/served_bench.hpp"
#include "bench/sim_world.hpp"
#include "bench/status_line.hpp"
#include "bench/stop_on_signal.hpp"
#include "bench/text_file.hpp"
#include "hal/did_you_mean.hpp"
#include "hal/real_time.hpp"

namespace rvbench::bench {
namespace {

constexpr int look_again_ms = 50;  // whether somebody wants it to end

// Lines that somebody types, as far as standard input goes.
class TypedLines {
 public:
  /// Waits a little. @return whole lines that have come
  std::vector<std::string> wait() {
    pollfd input{is_open_ ? STDIN_FILENO : -1, POLLIN, 0};
    std::vector<std::string> lines;
    if (::poll(&input, 1, look_again_ms) <= 0) return lines;
    std::array<char, 256> bytes{};
    const auto count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
    is_open_ = count > 0;
    if (count > 0) begun_.append(bytes.data(), static_cast<std::size_t>(count));
    for (auto end = begun_.find('\n'); end != std::string::npos; end = begun_.find('\n')) {
      if (end > 0) lines.push_back(begun_.substr(0, end));
      begun_.erase(0, end + 1);
    }
    return lines;
  }

 private:
  bool is_open_ = true;
  std::string begun_;  // a line of which the end has not come
};

class DevicesCommand final : public Command {
 public:
  std::string name() const override { return "devices"; }
  std::string summary() const override {
    return "the simulated bench's devices on their real protocols, in real time";
  }
  std::string examples() const override {
    return "  rvbench devices --rig sim --write-rig bench.json\n"
           "  rvbench run quick --rig bench.json --serial A17      in a second terminal\n"
           "  rvbench devices --rig sim --preset input_shaft --drive-line --write-rig bench.json\n"
           "  rvbench devices --rig sim --can vcan0 --write-rig bench.json\n"
           "Serves until Ctrl-C, on this computer only. Type, while it does:\n" +
           ServedBench::commands();
  }
  std::vector<Option> options() override {
    return {
        {"--rig", "rig: sim, or a rig file of the simulated bench", &rig_, true},
        unit_.preset(),
        unit_.seed(),
        unit_.severity(),
        {"--write-rig", "file that says where the devices are: the --rig of a run", &written_rig_},
        {"--drive-line", "that file has the drive's serial line instead of its TCP port",
         &drive_on_line_},
        {"--can", "SocketCAN interface for transducer and brake; default: a serial adapter", &can_},
        port("--tcp-port", "of the inverter", inverter_port_),
        port("--safety-port", "of the safety inputs' coupler", coupler_port_),
        port("--daq-port", "of the accelerometers", daq_port_)};
  }
  int run(Console& console) override;

 private:
  static Option port(const char* name, const std::string& whose,
                     std::optional<std::uint64_t>& target) {
    return {name, "TCP port " + whose + "; default: a free one", &target, false, {}, 65535, 1};
  }
  static std::uint16_t chosen(const std::optional<std::uint64_t>& port) {
    return static_cast<std::uint16_t>(port.value_or(0));
  }
  int serve(Console& console, const SimRig& rig);

  std::string rig_;
  SimChoice unit_;
  std::string written_rig_;
  bool drive_on_line_ = false;
  std::string can_;
  std::optional<std::uint64_t> inverter_port_, coupler_port_, daq_port_;
};

int DevicesCommand::run(Console& console) {
  const auto file = read_rig(rig_, unit_.rig_options());
  if (file.index() == 1) return refuse_file(console, rig_, std::get<1>(file));
  const auto* sim = std::get_if<SimRig>(&std::get<0>(file));
  if (sim == nullptr) {
    return refuse_file(console, rig_,
                       with_lines(rig_, {{0, "/rig", "only the simulated bench can be served"}}));
  }
  if (can_.size() >= IFNAMSIZ) {
    return refuse_usage(console, "devices: --can " + hal::in_quotes(can_) +
                                     ": an interface has a name of at most 15 characters");
  }
  std::error_code none;
  if (std::filesystem::exists(written_rig_, none) &&
      !std::filesystem::is_regular_file(written_rig_, none)) {
    return refuse_usage(console, "devices: --write-rig " + written_rig_ + " is no regular file");
  }
  if (std::filesystem::exists(written_rig_, none) &&
      file_kind(hal::ConfigReader::from_file(written_rig_)) != "rig") {
    return refuse_usage(console, "devices: --write-rig " + written_rig_ +
                                     " is there, and is no rig file: it would be lost");
  }
  try {
    return serve(console, *sim);
  } catch (const std::runtime_error& error) {  // a port that is taken, no such interface
    return refuse_usage(console, std::string("devices: ") + error.what());
  }
}

int DevicesCommand::serve(Console& console, const SimRig& rig) {
  const StopOnSignal signals;
  // Hardware is not held up by what else the computer does. Threads have it from their maker;
  // without the right to it they are as late as the computer is busy, and that is told.
  (void)hal::make_this_thread_urgent();
  auto world = make_world(rig, chosen(inverter_port_));
  if (world.index() == 1) {
    return refuse_file(console, rig_, with_lines(rig_, std::get<1>(world)));
  }
  std::mutex speaking;
  StatusLine status(console);
  // The bench's own thread tells as well: on a terminal that has been stopped it would stand still,
  // and with it every device.
  const auto tell = [&](const std::string& what) {
    const std::lock_guard lock(speaking);
    if (!takes_a_line(console)) return;
    console.err << "rvbench devices: " << what << std::endl;
    status.move_down();
  };
  ServedBench bench(rig, std::get<0>(std::move(world)),
                    {.coupler_port = chosen(coupler_port_),
                     .daq_port = chosen(daq_port_),
                     .can_interface = can_,
                     .drive_on_line = drive_on_line_},
                    tell);
  console.out << bench.addresses() << std::flush;
  if (!written_rig_.empty()) {
    write_file(written_rig_, json_text(to_json(bench.rig())));
    console.out << "  rvbench run quick --rig " << written_rig_ << " --serial A17\n";
  }
  console.out << std::flush;
  tell("serving; Ctrl-C ends it");
  for (TypedLines typed; !signals.token().stop_requested();) {
    for (const std::string& line : typed.wait()) tell(bench.obey(line));
    const std::lock_guard lock(speaking);
    if (status.is_due()) status.show(bench.status());
  }
  return exit_codes::done;
}

}  // namespace

std::unique_ptr<Command> make_devices_command() { return std::make_unique<DevicesCommand>(); }

}  // namespace rvbench::bench
