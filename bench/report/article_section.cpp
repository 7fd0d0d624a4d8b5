#include "analysis/evidence/article_rules.hpp"
#include "bench/findings_stand.hpp"
#include "bench/judging.hpp"
#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"
#include "bench/xml_text.hpp"

namespace rvbench::bench::report {

std::string article_section(const ReportInput& input) {
  analysis::Diagnosis diagnosis = input.judgement.diagnosis;
  if (!findings_stand(input.judgement)) diagnosis.findings.clear();
  std::vector<std::vector<std::string>> rows;
  for (const analysis::ArticleRule& rule : analysis::article_rules(
           examined_points(input.judgement), diagnosis, input.kinematics)) {
    rows.push_back({xml_escaped(rule.question), xml_escaped(rule.answer), xml_escaped(rule.why)});
  }
  if (rows.empty()) return "";
  return section("As the article reasons", table({"question", "answer", "why"}, rows));
}

}  // namespace rvbench::bench::report
