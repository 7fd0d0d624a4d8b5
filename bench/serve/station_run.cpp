#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "bench/json_text.hpp"
#include "bench/serve/json_fields.hpp"
#include "bench/serve/station.hpp"
#include "bench/serve/station_state.hpp"
#include "bench/text_file.hpp"

// The run on the bench, as the station sees it.
namespace rvbench::bench {
namespace {

constexpr const char* unit_file = "unit.json";  // what of the unit outlives the station

}  // namespace

// A run that another station began, and that goes on or has ended since.
void Station::find_run() {
  const auto unit = json_or_discarded(read_file(keep_ / unit_file).value_or(""));
  if (!unit.is_object() || text_at(unit, "serial").empty()) return;
  serial_ = text_at(unit, "serial");
  known_ = known_runs(file_.runs, serial_);
  const std::string newest_before = text_at(unit, "newest_before");
  const auto before = std::ranges::find(known_, newest_before, &KnownRun::run);
  known_.erase(before == known_.end() ? known_.begin() : before + 1, known_.end());
  phase_ = Phase::running;
  progress_ = {.stage = "start", .text = ""};
  if (!process_.is_alive()) conclude();
}

void Station::keep_unit() const {
  const nlohmann::json unit{{"serial", serial_},
                            {"newest_before", known_.empty() ? "" : known_.back().run}};
  write_file(keep_ / unit_file, json_line(unit) + "\n");
}

void Station::forget_unit() {
  phase_ = Phase::idle;
  serial_.clear();
  hold_against_time();
  known_.clear();
  forget_run();
  std::error_code ignored;
  std::filesystem::remove(keep_ / unit_file, ignored);
}

void Station::forget_run() {
  run_.clear();
  verdict_ = "null";
  progress_ = {};
  point_states_.assign(points_.size(), 'o');
}

void Station::spawn() {
  is_due_ = false;
  hub_.forget_strips();
  try {
    std::filesystem::remove(process_.answer_file());  // that of the unit before
    keep_unit();
  } catch (const std::system_error& error) {
    return fail("not_started", reason_of(error));
  }
  const std::string failed = process_.start(
      {program_.string(), "run", file_.plan, "--rig=" + file_.rig, "--serial=" + serial_,
       "--out=" + file_.runs.string(), "--live=" + live_file().string(), "--json"});
  if (!failed.empty()) fail("not_started", failed);
}

void Station::hear() {
  while (const auto letter = live_.next()) {
    const auto json = json_or_discarded(*letter);
    if (json.is_object() && phase_ == Phase::running) hear(json);
  }
}

void Station::hear(const nlohmann::json& letter) {
  const std::string kind = text_at(letter, "kind");
  if (kind == "strip" || kind == "spectrum") {
    nlohmann::json event = letter;
    event.erase("kind");
    hub_.publish(kind, json_line(event));
  }
  if (kind != "state") return;
  run_ = text_at(letter, "run");
  const auto number = [&letter](const char* key, double otherwise) {
    const auto found = letter.find(key);
    return found != letter.end() && found->is_number() ? found->get<double>() : otherwise;
  };
  progress_ = {text_at(letter, "stage"), text_at(letter, "text"), number("done", 0),
               number("left_s", not_known)};
  const std::string states = text_at(letter, "points");
  if (states.size() == points_.size()) point_states_ = states;
}

std::string Station::newest_run() const {
  const auto runs = known_runs(file_.runs, serial_);
  if (runs.empty()) return "";
  const bool is_old = std::ranges::find(known_, runs.back().run, &KnownRun::run) != known_.end();
  return is_old ? "" : runs.back().run;
}

void Station::conclude() {
  if (run_.empty()) run_ = newest_run();
  const auto answer = json_or_discarded(read_file(process_.answer_file()).value_or(""));
  if (!answer.is_object()) {
    if (is_told_to_stop_ && run_.empty()) return fail_before_it_began();
    return fail("no_answer", "the run ended without an answer (see " +
                                 process_.log_file().string() +
                                 "); if the shaft turned, the drive's watchdog has stopped it");
  }
  // Where power failed between two runs, the answer is the other's.
  if (const auto run = answer.find("run"); run != answer.end() && run->is_object()) {
    const std::string serial = text_at(*run, "serial"), started = text_at(*run, "started_utc");
    const std::string folder = std::filesystem::path(run_).filename().string();
    if (serial != serial_ || !folder.starts_with(started)) {
      return fail("other_run",
                  "the answer that was left is of another run, of " + serial + " at " + started);
    }
  }
  phase_ = Phase::ended;
  try {
    verdict_ = verdict_of_answer(answer, run_, file_.runs);
  } catch (const nlohmann::json::exception& error) {
    fail("no_answer", std::string("the run's answer is none: ") + error.what());
  }
}

void Station::fail_before_it_began() {
  fail("stopped_before", "stopped before it began", Outcome::aborted);
}

void Station::fail(const std::string& code, const std::string& reason, Outcome outcome) {
  phase_ = Phase::ended;
  const Ending ending{outcome, ErrorKind::device_lost, reason};
  verdict_ = verdict_of_answer({{"verdict", rvbench::to_string(outcome)},
                                {"exit_code", rvbench::exit_code(ending)},
                                {"code", code},
                                {"reason", reason}},
                               run_, file_.runs);
}

}  // namespace rvbench::bench
