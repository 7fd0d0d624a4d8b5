#include "hal/formats/read_frequency_responses.hpp"

#include "hal/formats/foreign_file.hpp"
#include "hal/formats/lms_text.hpp"
#include "hal/formats/printable.hpp"
#include "hal/formats/uff_datasets.hpp"
#include "hal/formats/uff_frequency_responses.hpp"

namespace rvbench::hal {
namespace {

Result<std::vector<FrequencyResponse>> read_as_it_is(const std::filesystem::path& file) {
  const std::string bytes = formats::bytes_of(file);
  const std::string_view head = std::string_view(bytes).substr(0, 4096);
  if (formats::is_uff(head)) return formats::read_uff_frequency_responses(file, bytes);
  if (formats::is_lms_text(head)) return formats::read_lms_frequency_response(file, bytes);
  return formats::bad_file(file, "no known format of frequency responses (UFF 58, LMS text)");
}

void make_printable(DegreeOfFreedom& place) {
  place.point = formats::printable(place.point);
  place.direction = formats::printable(place.direction);
}

// Foreign text goes into reports and JSON.
void make_printable(FrequencyResponse& response) {
  make_printable(response.response);
  make_printable(response.excitation);
  for (std::string& note : response.notes) note = formats::printable(note);
}

}  // namespace

Result<std::vector<FrequencyResponse>> read_frequency_responses(const std::filesystem::path& file) {
  if (const auto obstacle = formats::find_obstacle(file)) return *obstacle;
  Result<std::vector<FrequencyResponse>> read = read_as_it_is(file);
  if (!read) return IoError{read.error().code, formats::printable(read.error().where)};
  std::vector<FrequencyResponse> responses = std::move(read).value();
  for (FrequencyResponse& response : responses) make_printable(response);
  return responses;
}

}  // namespace rvbench::hal
