#include "bench/manual/man_page.hpp"

#include <fmt/format.h>

#include <string_view>
#include <utility>

#include "bench/manual/roff_text.hpp"

namespace rvbench::bench {
namespace {

constexpr std::string_view description =
    "rvbench runs the acceptance test of an RV reducer, the cycloidal gearbox in the joints of "
    "robots, on a test bench or in simulation: it drives the reducer through a plan of speeds and "
    "loads, records vibration, torque and shaft angle, and says whether the unit is good; if it is "
    "not, which part the vibration points to. It judges stored recordings of other machines, too.";

constexpr std::pair<int, std::string_view> exit_status[] = {
    {0, "PASS, or done"},
    {1, "internal error"},
    {2, "wrong usage"},
    {3, "a plan, rig or other file is invalid"},
    {10, "FAIL: the unit is bad"},
    {20, "INVALID: the data cannot be trusted, or are refused"},
    {30, "ERROR: the bench is at fault"},
    {40, "ERROR: safety trip"},
    {50, "ABORTED: somebody stopped it"},
    {60, "ERROR: the station is not qualified"}};

constexpr std::pair<std::string_view, std::string_view> files[] = {
    {"/usr/share/rvbench/", "rigs, plans, machines, plants and drives that are shipped"},
    {"/usr/share/doc/rvbench/guide/", "first steps, and the way to a bench of your own"},
    {"/etc/rvbench/station.json", "what the service rvbench.service serves"},
    {"/etc/rvbench/mqtt.json",
     "the broker that the service rvbench-publish.service sends results to"},
    {"/var/lib/rvbench/", "where it works"},
    {"/run/lock/rvbench-*.lock", "which devices are in use"}};

bool is_positional(const Option& option) { return !option.name.starts_with("-"); }

// What stands for the value of an option; "" for a switch.
std::string value_of(const Option& option) {
  std::string choices;
  for (const std::string& choice : option.choices) choices += (choices.empty() ? "" : "|") + choice;
  if (!choices.empty()) return choices;
  struct Word {
    std::string operator()(bool*) const { return ""; }
    std::string operator()(std::string*) const { return "TEXT"; }
    std::string operator()(std::vector<std::string>*) const { return "TEXT ..."; }
    std::string operator()(std::optional<double>*) const { return "NUMBER"; }
    std::string operator()(std::optional<std::uint64_t>*) const { return "N"; }
  };
  return std::visit(Word(), option.target);
}

std::string heading(const char* title) { return fmt::format(".SH {}\n", title); }

std::string entry(const std::string& head, std::string_view text) {
  return ".TP\n" + head + '\n' + roff_paragraph(text);
}

// rvbench judge REC ... --kinematics TEXT [OPTIONS]
std::string synopsis(const std::string& name, const std::vector<Option>& options) {
  std::string line = ".B rvbench " + roff_text(name) + '\n';
  for (const Option& option : options) {
    if (is_positional(option)) {
      const bool many = std::holds_alternative<std::vector<std::string>*>(option.target);
      const std::string word = "\\fI" + roff_text(option.name) + "\\fR" + (many ? " ..." : "");
      line += (option.required ? word : "[" + word + "]") + '\n';
    } else if (option.required) {
      line +=
          "\\fB" + roff_text(option.name) + "\\fR \\fI" + roff_text(value_of(option)) + "\\fR\n";
    }
  }
  return line + "[\\fIOPTIONS\\fR]\n";
}

std::string section_of(Command& command) {
  const std::vector<Option> options = command.options();
  std::string page = ".SS " + roff_text(command.name()) + '\n' + roff_paragraph(command.summary());
  page += ".PP\n" + synopsis(command.name(), options);
  for (const Option& option : options) {
    const std::string value = value_of(option);
    const char* font = is_positional(option) ? "\\fI" : "\\fB";
    std::string head = font + roff_text(option.name) + "\\fR";
    if (!is_positional(option) && !value.empty()) head += " \\fI" + roff_text(value) + "\\fR";
    page += entry(head, option.help + (option.required ? " (required)" : ""));
  }
  const std::string examples = command.examples();
  if (!examples.empty()) {
    page += ".PP\nExamples:\n.PP\n.EX\n" + roff_text(examples);
    if (examples.back() != '\n') page += '\n';
    page += ".EE\n";
  }
  return page;
}

}  // namespace

std::string man_page(const std::vector<std::unique_ptr<Command>>& commands,
                     const std::string& version, const std::string& date) {
  std::string page = fmt::format(".TH RVBENCH 1 \"{}\" \"rvbench {}\" \"User Commands\"\n", date,
                                 roff_text(version));
  page += heading("NAME") + "rvbench \\- acceptance test bench for RV reducers\n";
  page += heading("SYNOPSIS") + ".B rvbench\n\\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n.PP\n" +
          ".B rvbench\n\\fB\\-\\-help\\fR | \\fB\\-\\-version\\fR\n";
  page += heading("DESCRIPTION") + roff_paragraph(description);
  page += heading("COMMANDS") + "Each has the option \\fB\\-\\-help\\fR besides.\n";
  for (const auto& command : commands) page += section_of(*command);
  page += heading("EXIT STATUS");
  for (const auto& [code, meaning] : exit_status) {
    page += entry(fmt::format("\\fB{}\\fR", code), meaning);
  }
  page += heading("FILES");
  for (const auto& [file, what] : files) page += entry("\\fI" + roff_text(file) + "\\fR", what);
  return page + heading("SEE ALSO") + ".BR systemctl (1),\n.BR udev (7)\n";
}

}  // namespace rvbench::bench
