// sealer list | sealer CASE --seed SEED --plants FOLDER --out FOLDER --sealed FOLDER
// Makes recordings of a machine that holds more physics than its plant file tells. FOLDER/CASE gets
// what may be seen, plant.json and recordings; the answer goes to sealed/CASE.json.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <iostream>

#include "tests/proof/seal/sealed_case.hpp"
#include "tests/proof/seal/write_text.hpp"

using nlohmann::json;

namespace {

void list() {
  for (const seal::CasePlan& plan : seal::all_cases()) {
    std::cout << fmt::format("{} {} {} {} {}\n", plan.number, plan.kind, plan.machine,
                             plan.concealment_dB, fmt::join(plan.effects, ","));
  }
}

json sealed(const seal::CasePlan& plan, seal::Draw& draw, const std::filesystem::path& plants,
            const std::filesystem::path& folder) {
  if (plan.machine == "axis") return seal::seal_axis(plan, draw, folder);
  if (plan.machine == "oscillator") return seal::seal_oscillator(plan, draw, folder);
  return seal::seal_bench(plan, draw, plants, folder);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"seals what rvbench explain is to find"};
  std::string which, plants, out, answers;
  std::uint64_t seed = 0;
  app.add_option("case", which, "number of the case, or list")->required();
  app.add_option("--seed", seed);
  app.add_option("--plants", plants, "where rvbench's plant files are");
  app.add_option("--out", out, "for what may be seen");
  app.add_option("--sealed", answers, "for the answer");
  CLI11_PARSE(app, argc, argv);
  try {
    if (which == "list") return list(), 0;
    const seal::CasePlan plan = seal::all_cases().at(std::stoul(which) - 1);
    // Different cases of one seed have nothing in common, nor do the same cases of two seeds.
    seal::Draw draw(seed * 1'000'003 + static_cast<std::uint64_t>(plan.number) * 7919);
    std::filesystem::create_directories(out);
    std::filesystem::create_directories(answers);
    json answer = sealed(plan, draw, plants, out);
    answer["case"] = plan.number;
    answer["seed"] = seed;
    answer["kind"] = plan.kind;
    answer["machine"] = plan.machine;
    answer["variant"] = plan.kind == "null" ? plan.effects.front() : plan.variant;
    answer["salt"] = fmt::format("{:016x}", draw.seed());  // or the few answers could be guessed
    seal::write_text(std::filesystem::path(answers) / fmt::format("{}.json", plan.number),
                     answer.dump(2) + '\n');
    return 0;
  } catch (const std::exception& problem) {
    std::cerr << "sealer: " << problem.what() << '\n';
    return 2;
  }
}
