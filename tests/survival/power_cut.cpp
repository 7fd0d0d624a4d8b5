#include "tests/survival/power_cut.hpp"

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "tests/survival/torn_pages.hpp"

namespace rvbench::test {
namespace {

using Kind = DiskEntry::Kind;

std::string parent_of(const std::string& name) {
  const std::size_t slash = name.rfind('/');
  return slash == std::string::npos ? "" : name.substr(0, slash);
}

}  // namespace

PowerCut::PowerCut(std::filesystem::path root, const std::vector<DiskEntry>& entries, bool syncs)
    : root_(std::move(root)), entries_(entries), syncs_(syncs) {
  now_[""] = add_file("", true);
  for (std::size_t i = 0; i < entries_.size(); ++i) take_entry(i);
}

std::string PowerCut::below_root(const std::string& path) const {
  const std::string root = root_.string();
  if (!path.starts_with(root)) throw std::logic_error("survival: not below the root: " + path);
  return path.size() <= root.size() + 1 ? "" : path.substr(root.size() + 1);
}

std::size_t PowerCut::add_file(const std::string& name, bool is_folder) {
  files_.push_back({is_folder, {}, {}});
  now_[name] = files_.size() - 1;
  return files_.size() - 1;
}

void PowerCut::take_entry(std::size_t index) {
  const DiskEntry& entry = entries_[index];
  const auto change = [&](std::size_t file) {
    const std::string name = below_root(entry.path);
    const std::string to = entry.kind == Kind::rename ? below_root(entry.data) : "";
    changes_.push_back({index, now_.at(parent_of(name)), name, to, entry.kind, file});
  };
  switch (entry.kind) {
    case Kind::open: {
      const std::string name = below_root(entry.path);
      if (!now_.contains(name)) change(add_file(name, false));
      opened_[static_cast<int>(index)] = now_.at(name);
      break;
    }
    case Kind::make_folder: change(add_file(below_root(entry.path), true)); break;
    case Kind::write:
    case Kind::truncate: files_[opened_.at(entry.object)].changes.push_back(index); break;
    case Kind::sync: files_[opened_.at(entry.object)].syncs.push_back(index); break;
    case Kind::rename: {
      change(0);
      const auto moved = now_.extract(below_root(entry.path));
      now_[below_root(entry.data)] = moved.mapped();
      break;
    }
    case Kind::unlink:
      change(0);
      now_.erase(below_root(entry.path));
      break;
    case Kind::told: break;
  }
}

// All that was done to it before that entry is on the disk at `moment`.
std::size_t PowerCut::kept_until(const File& file, std::size_t moment) const {
  std::size_t kept = 0;
  if (!syncs_ && !file.is_folder) return kept;
  for (const std::size_t sync : file.syncs) {
    if (sync < moment) kept = std::max(kept, static_cast<std::size_t>(entries_[sync].began));
  }
  return kept;
}

PowerCut::Names PowerCut::names_at(std::size_t moment, std::mt19937_64& random) const {
  Names names{{"", 0}};
  const bool in_order = random() % 2 == 0;
  const std::size_t last = random() % (moment + 1);  // of those not synced, in order
  for (const Change& change : changes_) {
    if (change.entry >= moment) break;
    const File& folder = files_[change.of];
    const bool kept = change.entry < kept_until(folder, moment);
    if (!kept && !(in_order ? change.entry <= last : random() % 2 == 0)) continue;
    if (!names.contains(parent_of(change.name))) continue;
    if (change.kind == Kind::rename) {
      const auto moved = names.extract(change.name);
      if (!moved.empty()) names[change.new_name] = moved.mapped();
    } else if (change.kind == Kind::unlink) {
      names.erase(change.name);
    } else {
      names[change.name] = change.file;
    }
  }
  return names;
}

std::string PowerCut::bytes_at(const File& file, std::size_t moment,
                               std::mt19937_64& random) const {
  TornPages pages;
  const std::size_t kept = kept_until(file, moment);
  std::vector<const DiskEntry*> open_changes;
  for (const std::size_t index : file.changes) {
    if (index >= moment) break;
    if (index < kept) {
      pages.apply(entries_[index]);
    } else {
      open_changes.push_back(&entries_[index]);
    }
  }
  return pages.torn(open_changes, random);
}

void PowerCut::make(const std::filesystem::path& to, std::size_t moment, std::uint64_t seed) const {
  std::mt19937_64 random(seed);
  // Sorted by path: folders come before what is in them.
  for (const auto& [name, index] : names_at(moment, random)) {
    const File& file = files_[index];
    if (name.empty()) continue;
    if (file.is_folder) {
      std::filesystem::create_directory(to / name);
      continue;
    }
    std::ofstream out(to / name, std::ios::binary);
    const std::string bytes = bytes_at(file, moment, random);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!out) throw std::runtime_error("survival: cannot write " + (to / name).string());
  }
}

}  // namespace rvbench::test
