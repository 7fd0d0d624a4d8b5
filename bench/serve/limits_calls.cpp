#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>
#include <vector>

#include "bench/json_text.hpp"
#include "bench/results/audit_index.hpp"
#include "bench/serve/json_fields.hpp"
#include "bench/serve/station_api.hpp"
#include "bench/serve/tokens.hpp"
#include "bench/text_file.hpp"

namespace rvbench::bench {
namespace {

// The number of a version; it may come as text.
std::string version_at(const nlohmann::json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_number_integer() ? found->dump() : text_at(json, key);
}

// A word that a command may take for an argument of its own.
bool is_word(const std::string& text) {
  return !text.empty() && text.size() <= 200 && text.front() != '-' &&
         text.find("..") == std::string::npos && text.front() != '/';
}

}  // namespace

HttpAnswer StationApi::rejudge(const Call& call) {
  const std::string run = text_at(call.body, "run");
  const std::string version = version_at(call.body, "limits");
  if (!is_word(run)) return wrong_field("run");
  if (!version.empty() && !is_word(version)) return wrong_field("limits");
  return logged(call, "rejudge", [&] {
    std::vector<std::string> words{"rejudge", (station_.file().runs / run).string(), "--json"};
    if (!version.empty()) {
      const auto file = station_.file().runs / "limits" / (version + ".json");
      words.push_back("--limits=" + file.string());
    }
    return ask_long(std::move(words));
  });
}

// All versions, or what one of them would change.
HttpAnswer StationApi::limits(const Call& call) {
  const std::string field = wrong_parameter(call.request, {{"version", is_word}});
  if (!field.empty()) return wrong_field(field);
  const std::string version = call.request.parameter("version");
  if (!version.empty()) {
    return ask_long(
        {"limits", "effect", version, "--json", "--out=" + station_.file().runs.string()});
  }
  return ask({"limits", "list", "--json", "--out=" + station_.file().runs.string()});
}

// Of a limits file, or learnt from the good units of a plan: the station's where none is named.
HttpAnswer StationApi::propose_limits(const Call& call) {
  const std::string named = text_at(call.body, "plan");
  const std::string plan = named.empty() ? station_.file().plan : named;
  const std::string version = version_at(call.body, "version");
  const bool learns = !call.body.contains("limits");
  for (const auto& [key, value] : call.body.items()) {
    if (!learns && key != "limits") return wrong_field(key);  // the limits file says all
  }
  if (learns && !named.empty() && !is_word(named)) return wrong_field("plan");
  if (learns && !is_word(version)) return wrong_field("version");
  return logged(call, "limits propose", [&] {
    if (learns) {
      std::vector<std::string> words{"limits",
                                     "learn",
                                     version,
                                     "--plan=" + plan,
                                     "--by=" + call.session.user,
                                     "--out=" + station_.file().runs.string()};
      if (flag_at(call.body, "per_point")) words.emplace_back("--per-point");
      return ask_long(std::move(words));
    }
    // Of a name of its own: two may propose at once.
    const auto file =
        station_folder(station_.file().runs) / ("proposed-" + random_hex(8) + ".json");
    write_file(file, json_line(call.body["limits"]) + "\n");
    HttpAnswer answer =
        ask({"limits", "propose", "--from=" + file.string(), "--by=" + call.session.user,
             "--plan=" + station_.file().plan, "--out=" + station_.file().runs.string()});
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
    return answer;
  });
}

HttpAnswer StationApi::approve_limits(const Call& call) { return limits_step(call, "approve"); }
HttpAnswer StationApi::activate_limits(const Call& call) { return limits_step(call, "activate"); }

// The page shows the effect before it offers the step; who calls by another program asks for it.
HttpAnswer StationApi::limits_step(const Call& call, const std::string& step) {
  const std::string version = version_at(call.body, "version");
  if (!is_word(version)) return wrong_field("version");
  return logged(call, "limits " + step, [&] {
    std::vector<std::string> words{"limits",
                                   step,
                                   version,
                                   "--by=" + call.session.user,
                                   "--plan=" + station_.file().plan,
                                   "--out=" + station_.file().runs.string()};
    if (step == "approve") words.emplace_back("--yes");
    return ask_long(std::move(words));
  });
}

}  // namespace rvbench::bench
