#include "sim/inverter_table.hpp"

#include <algorithm>
#include <cmath>

namespace rvbench::sim {
namespace {

constexpr std::uint16_t settings_start = 0x0000;
constexpr std::uint16_t command_start = 0x0100;
constexpr std::uint16_t status_start = 0x0200;
constexpr unsigned forward_bit = 0x01;
constexpr unsigned reverse_bit = 0x02;
constexpr unsigned reset_bit = 0x80;

std::uint16_t unsigned_word(double value, double resolution) {
  return static_cast<std::uint16_t>(std::clamp(std::round(value / resolution), 0.0, 65535.0));
}

std::uint16_t signed_word(double value, double resolution) {
  const double rounded = std::clamp(std::round(value / resolution), -32768.0, 32767.0);
  return static_cast<std::uint16_t>(static_cast<std::int16_t>(rounded));
}

std::vector<std::uint16_t> settings_block(const InverterParameters& p) {
  return {0x5242, static_cast<std::uint16_t>(p.pole_pairs),
          unsigned_word(p.comm_loss_timeout_s, 0.1),
          static_cast<std::uint16_t>(p.comm_loss_action)};
}

std::vector<std::uint16_t> command_block(const InverterState& state) {
  std::uint16_t word = 0;
  if (state.run == RunCommand::forward) word = forward_bit;
  if (state.run == RunCommand::reverse) word = reverse_bit;
  return {word, unsigned_word(state.setpoint_Hz, 0.01)};
}

std::vector<std::uint16_t> status_block(const InverterState& state) {
  unsigned word = state.output_enabled ? 1 : 0;
  if (state.tripped) word |= 2;
  if (state.output_frequency_Hz < 0) word |= 4;
  if (state.local) word |= 8;
  return {static_cast<std::uint16_t>(word),
          unsigned_word(std::abs(state.output_frequency_Hz), 0.01),
          unsigned_word(state.current_A, 0.01), signed_word(state.speed_rpm, 0.1),
          static_cast<std::uint16_t>(state.fault_code)};
}

}  // namespace

std::optional<std::vector<std::uint16_t>> read_table(const InverterModel& model,
                                                     std::uint16_t address, std::uint16_t count) {
  const std::uint16_t start = address & 0xFF00;
  std::vector<std::uint16_t> block;
  if (start == settings_start) block = settings_block(model.parameters());
  if (start == command_start) block = command_block(model.state());
  if (start == status_start) block = status_block(model.state());
  const std::size_t first = address - start;
  if (count == 0 || first + count > block.size()) return std::nullopt;
  const auto begin = block.begin() + static_cast<std::ptrdiff_t>(first);
  return std::vector<std::uint16_t>(begin, begin + count);
}

TableAnswer write_table(InverterModel& model, std::uint16_t address,
                        const std::vector<std::uint16_t>& values) {
  const InverterState state = model.state();
  std::vector<std::uint16_t> words = command_block(state);
  if (values.empty() || address < command_start ||
      address + values.size() > command_start + words.size()) {
    return TableAnswer::illegal_address;
  }
  std::copy(values.begin(), values.end(), words.begin() + (address - command_start));
  const unsigned run_bits = words[0] & (forward_bit | reverse_bit);
  const bool reset = (words[0] & reset_bit) != 0;
  const bool unknown_bits = (words[0] & ~(forward_bit | reverse_bit | reset_bit)) != 0;
  if (unknown_bits || run_bits == (forward_bit | reverse_bit) || (reset && run_bits != 0)) {
    return TableAnswer::illegal_value;
  }
  RunCommand run = RunCommand::stop;
  if (run_bits == forward_bit) run = RunCommand::forward;
  if (run_bits == reverse_bit) run = RunCommand::reverse;
  if (!model.command(run, words[1] * 0.01)) {
    return run != RunCommand::stop && model.state().tripped ? TableAnswer::device_failure
                                                            : TableAnswer::illegal_value;
  }
  model.set_reset(reset);
  return TableAnswer::done;
}

}  // namespace rvbench::sim
