#include "bench/station/gage_json.hpp"

#include <nlohmann/json.hpp>

#include "bench/json_text.hpp"
#include "bench/software_version.hpp"
#include "hal/json_object.hpp"

namespace rvbench::bench {
namespace {

using nlohmann::ordered_json;

const char* word(GageWord word) {
  switch (word) {
    case GageWord::acceptable: return "acceptable";
    case GageWord::conditional: return "conditional";
    case GageWord::not_acceptable: return "not_acceptable";
  }
  return "";
}

ordered_json interval_json(const analysis::ConfidenceInterval& interval) {
  return ordered_json::array({interval.low, interval.high});
}

ordered_json component_json(const analysis::GageComponent& component, const GageAnswer& answer) {
  ordered_json json = hal::json_object({{"deviation", component.deviation},
                                        {"interval", interval_json(component.interval)},
                                        {"of_total", answer.study.share(component)}});
  if (answer.tolerance) {
    json["of_tolerance"] = analysis::share_of_tolerance(component, *answer.tolerance);
  }
  return json;
}

ordered_json line_json(const analysis::AnovaLine& line) {
  return hal::json_object({{"sum_of_squares", line.sum_of_squares},
                           {"freedom", line.freedom},
                           {"mean_square", line.mean_square()}});
}

ordered_json tested_json(const analysis::AnovaLine& line) {
  ordered_json json = line_json(line);
  json["f"] = line.f;
  json["p_value"] = line.p_value;
  return json;
}

}  // namespace

std::string gage_to_json(const GageAnswer& answer) {
  const analysis::GageStudy& study = answer.study;
  const ordered_json json = hal::json_object(
      {{"verdict", word(word_of(answer))},
       {"summary", gage_sentence(answer)},
       {"file", answer.file},
       {"unit", answer.data.unit.empty() ? ordered_json(nullptr) : ordered_json(answer.data.unit)},
       {"parts", answer.data.readings.parts},
       {"operators", answer.data.readings.operators},
       {"trials", answer.data.readings.trials},
       {"tolerance", answer.tolerance ? ordered_json(*answer.tolerance) : ordered_json(nullptr)},
       {"confidence", answer.confidence},
       {"gage_share", study.gage_share},
       {"gage_share_interval", interval_json(study.gage_share_interval)},
       {"distinct_categories", study.distinct_categories()},
       {"categories", study.categories},
       {"categories_interval", interval_json(study.categories_interval)},
       {"components",
        hal::json_object(
            {{"repeatability", component_json(study.repeatability, answer)},
             {"operators", component_json(study.operators, answer)},
             {"interaction", study.anova.is_pooled ? ordered_json(nullptr)
                                                   : component_json(study.interaction, answer)},
             {"gage", component_json(study.gage, answer)},
             {"parts", component_json(study.parts, answer)}})},
       {"total", study.total},
       {"anova", hal::json_object({{"parts", tested_json(study.anova.parts)},
                                   {"operators", tested_json(study.anova.operators)},
                                   {"interaction", tested_json(study.anova.interaction)},
                                   {"repeatability", line_json(study.anova.repeatability)},
                                   {"pooled", study.anova.is_pooled}})},
       {"software", software_version()}});
  return json_text(json);
}

}  // namespace rvbench::bench
