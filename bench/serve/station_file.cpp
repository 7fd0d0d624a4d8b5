#include "bench/serve/station_file.hpp"

#include <algorithm>
#include <set>

#include "bench/file_kind.hpp"
#include "bench/find_plan.hpp"
#include "bench/plan_files.hpp"
#include "bench/qualification/qualification_section.hpp"
#include "bench/rig_factory.hpp"
#include "bench/rig_file.hpp"
#include "bench/serve/check_digit.hpp"
#include "hal/did_you_mean.hpp"

namespace rvbench::bench {
namespace {

// Built-in names stay names; what begins with '/' stays where it is.
std::string seen_from(const std::filesystem::path& file, const std::string& path,
                      const std::vector<std::string>& built_in) {
  if (path.empty() || std::ranges::find(built_in, path) != built_in.end()) return path;
  return (file.parent_path() / path).lexically_normal().string();
}

void note_first(hal::ConfigReader& root, const char* key, const std::string& path,
                const std::vector<hal::ConfigFault>& faults) {
  if (!faults.empty()) root.fault(key, hal::describe(path, faults.front()));
}

SerialRule read_rule(hal::ConfigReader& root) {
  SerialRule rule;
  auto json = root.optional_object("serial");
  if (!json) return rule;
  if (json->has("masks")) rule.masks = json->texts("masks");
  rule.check_digit = json->choice("check_digit", check_digit_schemes(), "none");
  return rule;
}

std::vector<StationUser> read_users(hal::ConfigReader& root) {
  std::vector<StationUser> users;
  std::set<std::string> names;
  for (hal::ConfigReader& json : root.objects("users")) {
    StationUser user;
    user.name = json.text("name");
    user.role = role_of(json.choice("role", {"viewer", "operator", "engineer"}));
    user.token_hash = json.text("token_hash");
    if (!is_user_name(user.name)) {
      json.fault("name", "expected up to 32 letters, digits, '-' and '_', a letter or digit first");
    }
    if (!names.insert(user.name).second) {
      json.fault("name", "there is a user " + hal::in_quotes(user.name) + " already");
    }
    if (!is_token_hash(user.token_hash)) {
      json.fault("token_hash", "is no hash: rvbench serve --make-token makes token and entry");
    }
    users.push_back(std::move(user));
  }
  if (root.has("users") && users.empty()) {
    root.fault("users", "nobody could log in: rvbench serve --make-token makes an entry");
  }
  return users;
}

void read_network(hal::ConfigReader& root, StationFile& station) {
  station.remote_start = root.boolean("remote_start", station.remote_start);
  station.bind = root.text("bind", station.bind);
  station.port = root.integer("port", {1, 65535}, station.port);
  if (root.has("hosts")) station.hosts = root.texts("hosts");
  if (!is_loopback(station.bind) && station.hosts.empty()) {
    root.fault("bind", "others reach the station by a name or address: say which in \"hosts\"");
  }
  if (auto limits = root.optional_object("limits")) {
    station.most_connections = limits->integer("connections", {4, 1000}, station.most_connections);
    station.most_body_bytes =
        limits->integer("body_bytes", {1024, 1024 * 1024}, station.most_body_bytes);
  }
}

// Without its golden unit a station is never qualified: its scan may not be refused.
void hold_against_golden_unit(hal::ConfigReader& root, const StationFile& station) {
  const auto rig = read_rig(station.rig, {});
  const auto* asked = rig.index() == 0 ? qualification_in(std::get<0>(rig)) : nullptr;
  if (asked == nullptr || !asked->golden_unit) return;
  const std::string& serial = asked->golden_unit->serial;
  const std::string fault = serial_fault(station.serial, serial);
  if (fault.empty()) return;
  root.fault("serial", "refuses " + hal::in_quotes(serial) + ", the golden unit of " + station.rig +
                           (fault == "check_digit" ? ", by its check digit: it"
                                                   : ", which fits none of the masks: it") +
                           " could never be scanned");
}

}  // namespace

bool is_loopback(const std::string& address) {
  return address == "::1" || address == "localhost" || address.starts_with("127.");
}

bool is_user_name(const std::string& name) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  };
  return !name.empty() && name.size() <= 32 && is_plain(name.front()) &&
         std::ranges::all_of(name, [&](char c) { return is_plain(c) || c == '-' || c == '_'; });
}

std::variant<StationFile, std::vector<hal::ConfigFault>> read_station(
    const std::filesystem::path& file) {
  using Faults = std::vector<hal::ConfigFault>;
  if (is_absent(file)) return Faults{{0, "", "cannot be read: No such file"}};
  hal::ConfigReader root = hal::ConfigReader::from_file(file);
  if (auto fault = other_kind_fault(root, "station")) return Faults{*fault};
  StationFile station;
  station.name = root.text("station");
  station.plan = seen_from(file, root.text("plan"), names_of(plan_files()));
  station.rig = seen_from(file, root.text("rig"), {"sim"});
  station.runs = seen_from(file, root.text("runs", "runs"), {});
  station.serial = read_rule(root);
  station.users = read_users(root);
  read_network(root, station);
  if (!station.plan.empty()) {
    const auto plan = find_plan(station.plan);
    if (plan.index() == 1) note_first(root, "plan", station.plan, std::get<1>(plan));
  }
  if (!station.rig.empty()) {
    const auto faults = check_rig(station.rig);
    note_first(root, "rig", station.rig, faults);
    if (faults.empty()) hold_against_golden_unit(root, station);
  }
  root.finish();
  if (!root.faults().empty()) return root.faults();
  return station;
}

}  // namespace rvbench::bench
