#include "bench/bench_lock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

#include "bench/network_address.hpp"
#include "bench/run_folder.hpp"
#include "bench/text_file.hpp"

namespace rvbench::bench {
namespace {

std::string real_path(const std::string& device) {
  std::error_code error;
  const std::filesystem::path path = std::filesystem::weakly_canonical(device, error);
  return error ? device : path.string();
}

using Names = std::vector<std::string>;

// Of a context of libiio: "ip:HOST", "ip:HOST:PORT", "ip:[IPv6]:PORT", "serial:DEVICE,BAUD", and
// whatever has one name only. One front end for each address that its host has.
Names real_uris(const std::string& uri) {
  const std::string network = "ip:", line = "serial:", port = ":30431";
  if (uri.starts_with(line)) {
    const std::size_t end = std::min(uri.find(','), uri.size());
    return {line + real_path(uri.substr(line.size(), end - line.size()))};
  }
  if (!uri.starts_with(network) || uri == network) return {uri};
  std::string host = uri.substr(network.size());
  const bool in_brackets = host.front() == '[' && host.find(']') != std::string::npos;
  const bool has_port = std::ranges::count(host, ':') == 1;
  std::size_t end = in_brackets ? host.find(']') + 1 : has_port ? host.find(':') : host.size();
  std::string at = host.substr(end);
  if (at == port) at.clear();  // the usual one
  host = in_brackets ? host.substr(1, end - 2) : host.substr(0, end);
  Names uris;
  for (const std::string& address : addresses_of(host)) uris.push_back(network + address + at);
  return uris;
}

// The host of a Modbus device is an IPv4 address, of which there is one way to write it.
Names devices_at(const hal::ModbusTcp& tcp) { return {fmt::format("{}:{}", tcp.host, tcp.port)}; }
Names devices_at(const hal::ModbusRtu& rtu) { return {real_path(rtu.device)}; }
Names devices_at(const std::string& can_interface) { return {can_interface}; }
Names devices_at(const hal::SlcanOptions& slcan) { return {real_path(slcan.device)}; }
Names devices_at(const hal::ComediOptions& comedi) { return {real_path(comedi.device)}; }
Names devices_at(const hal::IioOptions& iio) {
  Names devices = real_uris(iio.uri);
  for (std::string& device : devices) device += ' ' + iio.device;
  return devices;
}

// Whoever holds the lock signs a moment after it has it. Anybody may write there: what is no number
// is not for a terminal.
std::string holder_of(const std::filesystem::path& file) {
  const std::string signature = read_file(file).value_or("");
  const std::string number = signature.substr(0, signature.find('\n'));
  const bool is_number = number.find_first_not_of("0123456789") == std::string::npos;
  return number.empty() || number.size() > 10 || !is_number ? "another rvbench"
                                                            : "another rvbench, process " + number;
}

}  // namespace

std::vector<std::string> devices_of(const DriveSection& drive) {
  return std::visit([](const auto& at) { return devices_at(at); }, drive.options.path);
}

std::vector<std::string> devices_of(const BenchRig& rig) {
  std::vector<std::string> devices = devices_of(rig.drive);
  const auto add = [&](const auto& place) {
    std::ranges::move(std::visit([](const auto& at) { return devices_at(at); }, place),
                      std::back_inserter(devices));
  };
  if (rig.can) add(rig.can->bus);
  if (rig.accelerometers) add(rig.accelerometers->options);
  if (rig.safety) add(rig.safety->options.path);
  std::ranges::sort(devices);
  devices.erase(std::unique(devices.begin(), devices.end()), devices.end());
  return devices;
}

std::variant<BenchLock, std::string> BenchLock::take(const std::vector<std::string>& devices,
                                                     const std::filesystem::path& folder) {
  BenchLock taken;
  std::map<std::string, std::string> in_use;  // of each holder
  for (const std::string& device : devices) {
    const std::filesystem::path file = folder / ("rvbench-" + folder_name_of(device) + ".lock");
    std::optional<FileLock> lock = FileLock::take_shared(file);
    if (lock) {
      lock->sign();
      taken.locks_.push_back(std::move(*lock));
    } else {
      std::string& held = in_use[holder_of(file)];
      held += (held.empty() ? "" : ", ") + device;
    }
  }
  if (in_use.empty()) return taken;
  std::string told;
  for (const auto& [holder, held] : in_use) {
    told += fmt::format("{}in use by {}: {}", told.empty() ? "" : "; ", holder, held);
  }
  return told;
}

// Not where this user may write: two users would then lock in two folders.
std::filesystem::path BenchLock::folder_for_all() {
  const char* const lock_folder = "/run/lock";
  std::error_code unknown;
  return std::filesystem::is_directory(lock_folder, unknown) ? lock_folder : "/tmp";
}

}  // namespace rvbench::bench
