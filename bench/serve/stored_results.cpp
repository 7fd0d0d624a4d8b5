#include <algorithm>
#include <atomic>
#include <charconv>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <system_error>

#include "bench/json_text.hpp"
#include "bench/results/run_filter.hpp"
#include "bench/results/trend.hpp"
#include "bench/serve/other_process.hpp"
#include "bench/serve/station_api.hpp"
#include "bench/text_file.hpp"
#include "hal/types/outcome.hpp"

namespace rvbench::bench {
namespace {

// What the report's own style needs, and nothing that could act.
constexpr const char* report_policy =
    "default-src 'none'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'self'";

const std::string newest_runs = "200";

// What works through all recordings of a run, or the results of all runs, takes workers and the
// computer that measures: two at a time.
constexpr double longest_judging_s = 600;
constexpr int most_long_jobs = 2;

// One of those that are at work, from 1.
class LongJob {
 public:
  explicit LongJob(std::atomic<int>& at_work) : at_work_(at_work), number_(++at_work) {}
  ~LongJob() { --at_work_; }
  LongJob(const LongJob&) = delete;
  LongJob& operator=(const LongJob&) = delete;
  int number() const { return number_; }

 private:
  std::atomic<int>& at_work_;
  const int number_;
};

// One component of a path that leads nowhere else, nor is it an option of a command.
bool is_plain_name(const std::string& name) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '_' || c == '-';
  };
  return !name.empty() && name.size() <= 100 && name.front() != '.' && name.front() != '-' &&
         std::ranges::all_of(name, is_plain);
}

bool is_within(const std::filesystem::path& file, const std::filesystem::path& root) {
  std::error_code unknown;
  const std::string real = std::filesystem::canonical(file, unknown).string();
  return !unknown && real.starts_with(std::filesystem::canonical(root, unknown).string() + "/");
}

// A run below the folder of runs, "A17/20261126T101112Z"; "" if it is none.
std::string run_of(const std::string& serial, const std::string& time) {
  return is_plain_name(serial) && is_plain_name(time) ? serial + "/" + time : "";
}

// An exit code that tells how a judgement ended, FAIL (10) to not qualified (60).
bool is_verdict(int code) { return code >= 10 && code <= 60; }

// Where nobody asks for more or fewer: an answer does not grow with the years.
void add_last(std::vector<std::string>& words, const HttpRequest& request) {
  if (request.parameter("last").empty()) words.push_back("--last=" + newest_runs);
}

// What the commands would refuse in words of their own options.
bool is_count(const std::string& text) {
  std::uint64_t count = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, count);
  return error == std::errc() && stop == end && count > 0;
}
bool is_time(const std::string& text) { return utc_of_text(text, false).has_value(); }
bool is_point(const std::string& text) { return point_of_text(text).has_value(); }
bool is_outcome(const std::string& text) {
  return std::ranges::any_of(all_outcomes,
                             [&](Outcome outcome) { return text == to_string(outcome); });
}
bool is_text(const std::string&) { return true; }

// "--serial=A17" of what the query holds.
void add_options(std::vector<std::string>& words, const HttpRequest& request) {
  for (const auto& [name, value] : request.query) {
    if (!value.empty()) words.push_back("--" + name + "=" + value);
  }
}

}  // namespace

HttpAnswer StationApi::run_file(const HttpRequest& request) const {
  std::vector<std::string> parts;
  for (std::size_t at = std::string("/api/runs/").size(); at <= request.path.size();) {
    const std::size_t end = std::min(request.path.find('/', at), request.path.size());
    parts.push_back(request.path.substr(at, end - at));
    at = end + 1;
  }
  if (parts.size() != 3 || run_of(parts[0], parts[1]).empty()) return refusal(404, "not_found");
  const bool is_report = parts[2] == "report";
  if (!is_report && parts[2] != "verdict") return refusal(404, "not_found");
  const std::filesystem::path& runs = station_.file().runs;
  const auto file = runs / parts[0] / parts[1] / (is_report ? "report.html" : "verdict.json");
  const auto text = is_within(file, runs) ? read_file(file) : std::nullopt;
  if (!text) return refusal(404, "not_found");
  HttpAnswer answer{.body = *text};
  if (is_report) {
    answer.type = "text/html; charset=utf-8";
    answer.headers = {{"Content-Security-Policy", report_policy}};
  }
  return answer;
}

// What rvbench's other commands answer, as they say it. A unit that fails is an answer as well:
// only what comes without the document that was asked for is a refusal.
HttpAnswer StationApi::ask(std::vector<std::string> words, double longest_s) const {
  words.insert(words.begin(), program_);
  const ProgramAnswer answer = ask_program(words, longest_s, ending_.get_token());
  if (answer.code < 0 && ending_.stop_requested()) return refusal(503, "ending");
  if (answer.code < 0) return refusal(504, "no_answer");
  const bool is_answer = answer.code == 0 || is_verdict(answer.code);
  if (is_answer && !json_or_discarded(answer.out).is_discarded()) return {.body = answer.out};
  if (answer.code == 0) return json_answer(200, {{"text", answer.out}});
  return json_answer(422,
                     {{"error", "refused"}, {"exit_code", answer.code}, {"reason", answer.err}});
}

HttpAnswer StationApi::ask_long(std::vector<std::string> words) const {
  const LongJob job(long_jobs_);
  if (job.number() > most_long_jobs) return refusal(503, "busy");
  return ask(std::move(words), longest_judging_s);
}

HttpAnswer StationApi::history(const Call& call) {
  const std::string field = wrong_parameter(call.request, {{"serial", is_text},
                                                           {"from", is_time},
                                                           {"to", is_time},
                                                           {"verdict", is_outcome},
                                                           {"plan", is_text},
                                                           {"last", is_count}});
  if (!field.empty()) return wrong_field(field);
  std::vector<std::string> words{"history", "--json", "--out=" + station_.file().runs.string()};
  add_options(words, call.request);
  add_last(words, call.request);
  return ask(std::move(words));
}

HttpAnswer StationApi::trend(const Call& call) {
  HttpRequest request = call.request;
  const std::string indicator = request.parameter("indicator");
  if (!is_plain_name(indicator)) return wrong_field("indicator");
  request.query.erase("indicator");
  const std::string field = wrong_parameter(
      request,
      {{"point", is_point}, {"channel", is_text}, {"serial", is_text}, {"last", is_count}});
  if (!field.empty()) return wrong_field(field);
  std::vector<std::string> words{"trend", indicator, "--json",
                                 "--runs=" + station_.file().runs.string()};
  add_options(words, request);
  add_last(words, request);
  return ask(std::move(words));
}

HttpAnswer StationApi::audit(const Call& call) {
  const std::string field = wrong_parameter(call.request, {{"last", is_count}});
  if (!field.empty()) return wrong_field(field);
  const std::string last = call.request.parameter("last");
  const auto lines = last.empty() ? 100 : std::min<std::uint64_t>(1000, std::stoull(last));
  return {.body = "{\"entries\":" + audit_.last(lines) + "}\n"};
}

}  // namespace rvbench::bench
