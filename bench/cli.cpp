#include "bench/cli.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <exception>
#include <sstream>
#include <string_view>

#include "bench/software_version.hpp"
#include "bench/verdict_json.hpp"
#include "hal/did_you_mean.hpp"
#include "hal/formats/printable.hpp"

namespace rvbench::bench {
namespace {

constexpr std::size_t help_columns = 50;  // of 80, beside the options' names

// Breaks lines at spaces; CLI11 indents what follows.
std::string wrapped(const std::string& text) {
  std::string lines;
  std::size_t used = 0;
  std::istringstream words(text);
  for (std::string word; words >> word; used += word.size() + 1) {
    const bool full = used > 0 && used + word.size() > help_columns;
    if (full) used = 0;
    lines += (full ? "\n" : lines.empty() ? "" : " ") + word;
  }
  return lines;
}

// CLI11 would wrap -1 to 2^64 - 1, and has no word for what is too large.
std::string whole_number_fault(const std::string& text, const Option& option) {
  std::uint64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc() && stop == end && value >= option.least && value <= option.most)
    return "";
  return fmt::format("must be a whole number from {} to {}, not {}", option.least, option.most,
                     hal::in_quotes(text));
}

// CLI11 would take "0x10", " 5" and "nan", and nothing at all for no option.
std::string number_fault(const std::string& text) {
  double value = 0;
  const char* first = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(first, end, value);
  const bool is_number = error == std::errc() && stop == end && std::isfinite(value);
  return is_number && !text.starts_with("+-")
             ? ""
             : "must be a decimal number, not " + hal::in_quotes(text);
}

// What is printed, signed and kept in files: names, numbers of certificates, paths.
std::string text_fault(const std::string& text) {
  constexpr std::size_t most_bytes = 4096;  // of a path
  if (text.find_first_not_of(' ') == std::string::npos) return "must not be empty";
  if (text.size() > most_bytes) return fmt::format("must not be longer than {} bytes", most_bytes);
  if (hal::formats::has_control_character(text))
    return "must be free of control characters, unlike " + hal::in_quotes(text);
  return "";
}

void add_option(CLI::App& app, const Option& option) {
  const auto add = [&](auto* target) -> CLI::Option* {
    using Target = std::remove_pointer_t<decltype(target)>;
    if constexpr (std::is_same_v<Target, bool>) {
      return app.add_flag(option.name, *target, wrapped(option.help));
    } else {
      return app.add_option(option.name, *target, wrapped(option.help));
    }
  };
  CLI::Option* added = std::visit(add, option.target);
  added->required(option.required);
  if (std::holds_alternative<std::optional<std::uint64_t>*>(option.target)) {
    added->check([option](const std::string& text) { return whole_number_fault(text, option); });
  }
  if (std::holds_alternative<std::optional<double>*>(option.target)) added->check(number_fault);
  // Files named one after the other are given by the shell, whatever they are called.
  const bool is_list = std::holds_alternative<std::vector<std::string>*>(option.target);
  if (std::holds_alternative<std::string*>(option.target) ||
      (is_list && option.name.starts_with("--"))) {
    added->check(text_fault);
  }
  if (!option.choices.empty()) added->check(CLI::IsMember(option.choices));
}

std::vector<std::string> option_names(Command& command) {
  std::vector<std::string> names = {"--help"};
  for (const Option& option : command.options()) {
    if (option.name.starts_with("--")) names.push_back(option.name);
  }
  return names;
}

// The first argument that looks like an option and is none of the command's.
std::string unknown_option(const std::vector<std::string>& arguments, Command& command) {
  const std::vector<std::string> known = option_names(command);
  for (const std::string& argument : arguments) {
    const std::string name = argument.substr(0, argument.find('='));
    if (name.starts_with("--") && name != "--" && std::ranges::find(known, name) == known.end()) {
      return name;
    }
  }
  return "";
}

// "--serial=": CLI11 would take the next argument for the value.
std::string empty_option(const std::vector<std::string>& arguments) {
  for (const std::string& argument : arguments) {
    if (argument.starts_with("--") && argument.find('=') == argument.size() - 1) return argument;
  }
  return "";
}

int refuse_arguments(Console& console, const std::string& message, const std::string& help_of) {
  complain(console, "rvbench: " + message);
  console.err << "Try: rvbench " << help_of << "--help\n";
  return exit_codes::usage;
}

int general_help(const std::vector<std::unique_ptr<Command>>& commands, std::ostream& out) {
  out << "rvbench " << software_version() << "\nAcceptance test bench for RV reducers\n\n"
      << "Usage: rvbench COMMAND [OPTIONS]\n\nCommands:\n";
  for (const auto& command : commands) {
    out << "  " << command->name()
        << std::string(10 - std::min<std::size_t>(9, command->name().size()), ' ')
        << command->summary() << '\n';
  }
  out << "\nrvbench COMMAND --help explains a command, with examples.\n"
         "Exit codes: 0 PASS, 1 internal error, 2 usage, 3 file invalid, 10 FAIL, 20 INVALID,\n"
         "            30 ERROR, 40 safety trip, 50 aborted, 60 station not qualified\n";
  return exit_codes::done;
}

int run_command(Command& command, Console& console) {
  try {
    return command.run(console);
  } catch (const std::exception& error) {
    complain(console, "rvbench: internal error in " + command.name() + ": " + error.what());
    return exit_codes::internal_error;
  }
}

int parse_and_run(Command& command, std::vector<std::string> arguments, Console& console) {
  const std::string unknown = unknown_option(arguments, command);
  if (!unknown.empty()) {
    return refuse_arguments(
        console, "unknown option " + unknown + hal::did_you_mean(unknown, option_names(command)),
        command.name() + " ");
  }
  if (const std::string empty = empty_option(arguments); !empty.empty()) {
    return refuse_arguments(console, command.name() + ": nothing follows " + empty,
                            command.name() + " ");
  }
  CLI::App app(command.summary(), "rvbench " + command.name());
  for (const Option& option : command.options()) add_option(app, option);
  app.footer("\nExamples:\n" + command.examples());
  try {
    std::ranges::reverse(arguments);  // CLI11 takes them from the back
    app.parse(std::move(arguments));
  } catch (const CLI::CallForHelp&) {
    console.out << app.help();
    return exit_codes::done;
  } catch (const CLI::ParseError& error) {
    return refuse_arguments(console, command.name() + ": " + error.what(), command.name() + " ");
  }
  return run_command(command, console);
}

int dispatch(const std::vector<std::string>& arguments,
             const std::vector<std::unique_ptr<Command>>& commands, Console& console) {
  const std::string word = arguments.empty() ? "" : arguments.front();
  if (word == "--help" || word == "-h" || word == "help")
    return general_help(commands, console.out);
  if (word == "--version") {
    console.out << "rvbench " << software_version() << '\n';
    return exit_codes::done;
  }
  if (word.empty()) {
    general_help(commands, console.err);
    return exit_codes::usage;
  }
  std::vector<std::string> names;
  for (const auto& command : commands) {
    if (command->name() == word) {
      return parse_and_run(*command, {arguments.begin() + 1, arguments.end()}, console);
    }
    names.push_back(command->name());
  }
  return refuse_arguments(
      console, "unknown command " + hal::in_quotes(word) + hal::did_you_mean(word, names), "");
}

// Whether the code speaks of what standard output was to hold; any other tells of the bench, or
// why there is no answer, and standard error says so.
bool is_answer(int code) {
  const auto is_code_of = [code](Outcome outcome) {
    return code == exit_code({outcome, ErrorKind::none, ""});
  };
  return is_code_of(Outcome::pass) || is_code_of(Outcome::fail) || is_code_of(Outcome::invalid);
}

}  // namespace

int run_cli(const std::vector<std::string>& arguments,
            const std::vector<std::unique_ptr<Command>>& commands, Console& console) {
  const int code = dispatch(arguments, commands, console);
  const bool json = std::ranges::find(arguments, "--json") != arguments.end();
  if (json && !console.complaints.empty()) {
    console.out << refusal_to_json(code, console.complaints);
  }
  if (console.out.flush()) return code;
  console.err << "rvbench: standard output cannot be written\n";
  return is_answer(code) ? exit_codes::internal_error : code;
}

}  // namespace rvbench::bench
