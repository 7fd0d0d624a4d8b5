#include "tests/faults/killed_run.hpp"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tests/faults/scene.hpp"

namespace rvbench::test {
namespace {

using nlohmann::json;

// JSON has no NaN.
json number(double value) { return std::isnan(value) ? json() : json(value); }
double number(const json& value) { return value.is_null() ? not_known : value.get<double>(); }

// What was seen of the plant, and what the dead controller had been told about its recording.
std::string told(Scene& scene) {
  const FaultReport& report = scene.report();
  json all = {{"struck", report.struck},
              {"held_up", report.held_up},
              {"undriven_s", number(report.undriven_s)},
              {"released_s", number(report.released_s)},
              {"violations", report.violations},
              {"acknowledged", json::array()}};
  for (const hal::PointResult& point : scene.recording().acknowledged()) {
    all["acknowledged"].push_back({point.point, number(point.t0_s), point.status,
                                   number(point.speed_rpm), number(point.torque_Nm),
                                   number(point.acceleration_time_uncertainty_s),
                                   number(point.torque_time_uncertainty_s)});
  }
  return all.dump();
}

struct Told {
  FaultReport report;
  std::vector<hal::PointResult> acknowledged;
};

Told understood(const std::string& text) {
  const json all = json::parse(text);
  Told result;
  result.report.struck = all.at("struck");
  result.report.held_up = all.at("held_up");
  result.report.undriven_s = number(all.at("undriven_s"));
  result.report.released_s = number(all.at("released_s"));
  result.report.violations = all.at("violations").get<std::vector<std::string>>();
  for (const json& row : all.at("acknowledged")) {
    result.acknowledged.push_back({row.at(0), number(row.at(1)), row.at(2), number(row.at(3)),
                                   number(row.at(4)), number(row.at(5)), number(row.at(6))});
  }
  return result;
}

// Ends this process without a word of farewell, as the end of a fork must.
[[noreturn]] void tell_and_end(Scene& scene, int pipe, const std::filesystem::path& truth) {
  scene.bench().truth.save(truth);
  const std::string text = told(scene);
  const bool written = ::write(pipe, text.data(), text.size()) == ssize_t(text.size());
  ::_exit(written ? 0 : 1);
}

// The plant outlives its controller in a copy of the process: shaft, drive and brake as they are
// in this instant, and nobody who talks to them.
void kill_controller(Scene& scene, int pipe, const std::filesystem::path& truth) {
  std::fflush(nullptr);
  if (::fork() == 0) {
    scene.leave_alone();
    scene.judge_plant();
    tell_and_end(scene, pipe, truth);
  }
  ::raise(SIGKILL);
}

std::string read_all(int pipe) {
  std::string text;
  std::array<char, 4096> part{};
  for (ssize_t count = 0; (count = ::read(pipe, part.data(), part.size())) > 0;) {
    text.append(part.data(), std::size_t(count));
  }
  return text;
}

}  // namespace

FaultReport run_killed(const FaultCase& fault, const std::filesystem::path& file,
                       const Guard* without) {
  const std::filesystem::path truth = file.string() + ".truth";
  std::array<int, 2> pipe{};
  if (::pipe(pipe.data()) != 0) throw std::runtime_error("run_killed: no pipe");
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);  // the plant's process becomes this one's when it is orphaned
  const pid_t controller = ::fork();
  if (controller == 0) {
    ::close(pipe[0]);
    Scene scene(fault, file, without,
                [&](Scene& struck) { kill_controller(struck, pipe[1], truth); });
    (void)scene.measure();
    scene.leave_alone();
    scene.judge_plant();
    tell_and_end(scene, pipe[1], truth);
  }
  ::close(pipe[1]);
  const std::string text = read_all(pipe[0]);
  ::close(pipe[0]);
  int status = 0;
  ::waitpid(controller, &status, 0);
  while (::wait(nullptr) > 0) continue;  // the plant's: nobody has the recording open any more
  if (text.empty()) throw std::runtime_error("run_killed: nobody told what became of the plant");
  Told result = understood(text);
  FaultReport& report = result.report;
  const bool was_killed = WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
  report.outcome = was_killed ? "killed" : "not killed";
  if (report.struck != was_killed) report.violations.push_back("the controller lived on");
  const ReadBack found =
      read_back(file, result.acknowledged, PlantTruth::load(truth), flaw_of_record);
  report.violations.insert(report.violations.end(), found.losses.begin(), found.losses.end());
  return report;
}

}  // namespace rvbench::test
