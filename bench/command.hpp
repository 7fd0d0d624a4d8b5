#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "bench/console.hpp"

namespace rvbench::bench {

/// Exit codes that are no verdict (those are exit_code(Ending)).
namespace exit_codes {
inline constexpr int done = 0;
inline constexpr int internal_error = 1;
inline constexpr int usage = 2;
inline constexpr int bad_file = 3;
inline constexpr int data_refused = 20;
inline constexpr int aborted = 50;
}  // namespace exit_codes

/// One option of a command, and the variable that receives its value.
struct Option {
  using Target = std::variant<bool*, std::string*, std::vector<std::string>*,
                              std::optional<double>*, std::optional<std::uint64_t>*>;

  std::string name;  ///< "--rig"; without dashes it is a positional argument: "PLAN"
  std::string help;
  Target target;
  bool required = false;
  std::vector<std::string> choices = {};  ///< empty: anything
  std::uint64_t most = UINT64_MAX;        ///< of a whole number
  std::uint64_t least = 0;                ///< likewise
};

/// One word that rvbench understands. A new command is a new file in bench/commands/ and one line
/// in commands.cpp. The targets of options() live in the command.
class Command {
 public:
  virtual ~Command() = default;
  virtual std::string name() const = 0;
  virtual std::string summary() const = 0;   ///< one line
  virtual std::string examples() const = 0;  ///< lines for --help
  virtual std::vector<Option> options() = 0;

  /// @return one of exit_codes or that of an Ending; an exception that leaves here becomes exit 1
  virtual int run(Console& console) = 0;
};

/// All commands, in the order of --help.
std::vector<std::unique_ptr<Command>> make_commands();

}  // namespace rvbench::bench
