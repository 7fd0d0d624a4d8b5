#include "tests/survival/torn_pages.hpp"

#include <algorithm>
#include <functional>
#include <map>

namespace rvbench::test {
namespace {

constexpr std::size_t page_bytes = 4096;
constexpr std::size_t sector_bytes = 512;

// How far a page has come: whole as after its first `versions` changes, and in some sectors as
// after its first `later`.
struct PageState {
  std::size_t versions = 0, later = 0;
  std::size_t first_sector = 0, last_sector = 0;  // of those that are later
};

struct Span {
  std::size_t begin, end;
};

// The bytes that a change touches. A truncation leaves zeros behind its end.
Span span_of(const DiskEntry& change, std::size_t size) {
  const auto at = static_cast<std::size_t>(change.offset);
  if (change.kind == DiskEntry::Kind::truncate) return {std::min(at, size), size};
  return {at, at + change.data.size()};
}

std::size_t size_after(const DiskEntry& change, std::size_t size) {
  if (change.kind == DiskEntry::Kind::truncate) return static_cast<std::size_t>(change.offset);
  return std::max(size, static_cast<std::size_t>(change.offset) + change.data.size());
}

void for_each_page(const Span& span, const std::function<void(std::size_t)>& body) {
  for (std::size_t page = span.begin / page_bytes; page * page_bytes < span.end; ++page) body(page);
}

// The part of a change within [begin, end) of the file.
void put(std::string& bytes, const DiskEntry& change, const Span& span, std::size_t begin,
         std::size_t end) {
  begin = std::max(begin, span.begin);
  end = std::min(end, span.end);
  if (begin >= end) return;
  if (change.kind == DiskEntry::Kind::truncate) {
    std::fill(bytes.begin() + std::ptrdiff_t(begin), bytes.begin() + std::ptrdiff_t(end), '\0');
  } else {
    std::copy_n(change.data.begin() + std::ptrdiff_t(begin - span.begin), end - begin,
                bytes.begin() + std::ptrdiff_t(begin));
  }
}

enum class Luck { none_came, nearly_all_came, any_came };

PageState state_of(std::size_t changes, Luck luck, std::mt19937_64& random) {
  PageState state;
  if (luck == Luck::none_came) return state;
  state.versions = luck == Luck::any_came ? random() % (changes + 1) : changes;
  state.later = state.versions;
  if (random() % 4 != 0) return state;  // else it was under way
  state.versions = random() % (state.versions + 1);
  const std::size_t border = random() % (page_bytes / sector_bytes + 1);
  state.first_sector = random() % 2 == 0 ? 0 : border;
  state.last_sector = state.first_sector == 0 ? border : page_bytes / sector_bytes;
  return state;
}

}  // namespace

void TornPages::apply(const DiskEntry& change) {
  const Span span = span_of(change, bytes_.size());
  bytes_.resize(size_after(change, bytes_.size()), '\0');
  put(bytes_, change, span, 0, bytes_.size());
}

std::string TornPages::torn(const std::vector<const DiskEntry*>& changes,
                            std::mt19937_64& random) const {
  const Luck luck = Luck(std::min<std::uint64_t>(random() % 4, 2));
  std::vector<std::size_t> sizes{bytes_.size()};
  std::vector<Span> spans;
  std::map<std::size_t, std::size_t> touched;  // page → by how many changes
  for (const DiskEntry* change : changes) {
    spans.push_back(span_of(*change, sizes.back()));
    sizes.push_back(size_after(*change, sizes.back()));
    for_each_page(spans.back(), [&](std::size_t page) { ++touched[page]; });
  }
  std::map<std::size_t, PageState> states;
  for (const auto& [page, count] : touched) states[page] = state_of(count, luck, random);

  std::string bytes = bytes_;
  bytes.resize(*std::max_element(sizes.begin(), sizes.end()), '\0');
  std::map<std::size_t, std::size_t> done;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    for_each_page(spans[i], [&](std::size_t page) {
      const PageState& state = states.at(page);
      const std::size_t begin = page * page_bytes;
      const std::size_t number = ++done[page];
      if (number <= state.versions) {
        put(bytes, *changes[i], spans[i], begin, begin + page_bytes);
      } else if (number <= state.later) {
        put(bytes, *changes[i], spans[i], begin + state.first_sector * sector_bytes,
            begin + state.last_sector * sector_bytes);
      }
    });
  }
  const std::size_t size = luck == Luck::none_came         ? sizes.front()
                           : luck == Luck::nearly_all_came ? sizes.back()
                                                           : sizes[random() % sizes.size()];
  bytes.resize(size, '\0');
  return bytes;
}

}  // namespace rvbench::test
