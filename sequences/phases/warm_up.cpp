#include "sequences/phases/warm_up.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "hal/json_object.hpp"
#include "sequences/bench_loop.hpp"
#include "sequences/plan.hpp"

namespace rvbench::sequences {
namespace {

class WarmUp final : public Phase {
 public:
  WarmUp(double duration_s, double speed_rpm, double load_pct)
      : duration_s_(duration_s), speed_rpm_(speed_rpm), load_pct_(load_pct) {}

  std::string_view kind() const override { return "warm_up"; }

  std::string to_json() const override {
    return hal::json_object({{"phase", kind()},
                             {"duration_s", duration_s_},
                             {"speed_rpm", speed_rpm_},
                             {"load_pct", load_pct_}})
        .dump();
  }

  std::vector<Segment> timeline(const Specimen& specimen) const override {
    return {{fmt::format("warm up at {:g} rpm, {:g} %", speed_rpm_, load_pct_), duration_s_,
             speed_rpm_, load_torque_Nm(specimen, load_pct_), false}};
  }

  std::optional<Ending> run(BenchLoop& loop, const Specimen& specimen) override {
    const Segment segment = timeline(specimen).front();
    loop.enter(segment);
    loop.command(segment.speed_rpm, segment.output_torque_Nm);
    return loop.run_for(duration_s_);
  }

 private:
  double duration_s_;
  double speed_rpm_;
  double load_pct_;
};

}  // namespace

std::unique_ptr<Phase> parse_warm_up(hal::ConfigReader& json) {
  const double duration_s = json.number("duration_s", {0, 86400});
  const double speed_rpm = json.number("speed_rpm", {1, 10000});
  return std::make_unique<WarmUp>(duration_s, speed_rpm, json.number("load_pct", {0, 300}));
}

}  // namespace rvbench::sequences
