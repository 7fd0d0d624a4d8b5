#include "tests/factory/judged_runs.hpp"

#include <utility>

#include "bench/run_folder.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "bench/verdict_json.hpp"
#include "tests/support/this_build.hpp"

namespace rvbench::test {

std::filesystem::path judged_run(const std::filesystem::path& root, bench::Judgement judgement,
                                 const std::string& serial, const std::string& utc) {
  judgement.facts.serial = serial;
  judgement.facts.started_utc = utc;
  const auto folder = bench::create_run_folder(root, serial, utc);
  bench::write_file(folder / "plan.json", R"({"name": "quick"})");
  bench::write_file(folder / "rig.json", R"({"rig": "sim"})");
  bench::write_file(folder / "verdict.json", bench::judgement_to_json(judgement));
  bench::write_sums(folder);
  return folder;
}

std::string broker_file(const std::filesystem::path& folder, int port, const std::string& more) {
  const std::filesystem::path file = folder / "mqtt.json";
  bench::write_file(file, R"({"host": "127.0.0.1", "station_name": "b3", "port": )" +
                              std::to_string(port) + more + "}");
  return file.string();
}

std::vector<std::string> publish_words(const std::filesystem::path& root,
                                       const std::string& broker_file,
                                       std::vector<std::string> more) {
  std::vector<std::string> words{build_dir() / "rvbench", "publish",  "--out",
                                 root.string(),           "--broker", broker_file};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

Answer publish(const std::filesystem::path& root, const std::string& broker_file,
               std::vector<std::string> more) {
  return Program(root, publish_words(root, broker_file, std::move(more))).wait();
}

}  // namespace rvbench::test
