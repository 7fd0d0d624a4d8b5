#include "bench/results/result_entry.hpp"

#include <utility>

#include "bench/result_database.hpp"

namespace rvbench::bench {

std::string enter_result(const std::filesystem::path& root, const std::filesystem::path& folder,
                         const Judgement& judgement) {
  auto database = ResultDatabase::open(root);
  Status entered = Done{};
  if (database) {
    ResultDatabase results = std::move(database).value();
    entered = results.enter(row_of(root, folder, judgement), judgement);
    if (entered) {
      const auto caught_up = results.catch_up();
      if (!caught_up) entered = caught_up.error();
    }
  } else {
    entered = database.error();
  }
  if (entered) return "";
  const std::string what = "rvbench: " + describe(entered.error());
  if (!judgement.unwritten.empty()) return what + "\n";
  return what + "; the result is safe in " + folder.string() +
         " and will be entered by the next run\n";
}

}  // namespace rvbench::bench
