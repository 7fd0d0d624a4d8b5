#pragma once

#include <string>
#include <string_view>

#include "hal/types/recording.hpp"

namespace rvbench::hal::formats {

/// When 0 s of a recording's clock was: seconds since 1970-01-01 UTC, without leap seconds. It is
/// kept among the recording's notes, "started 2016-10-14T10:51:17.000000Z", so that people see it.
/// A file that says no time zone is taken to mean UTC.
void note_start(double utc_s, Recording& recording);

bool is_start_note(std::string_view note);

/// NaN if no note says it.
double noted_start_s(const Recording& recording);

/// "2016-10-14T10:51:17.000000Z" (ISO 8601); empty for NaN, and before year 1 or after 9999.
std::string utc_text(double utc_s);

/// The inverse, also with fewer decimals or none; NaN if it is no such text.
double utc_of_text(std::string_view text);

/// "14-Oct-16 10:51:17", as universal files have it, with decimals where there are any. Years of
/// two digits are 1970 to 2069.
std::string uff_date(double utc_s);
double utc_of_uff_date(std::string_view text);  ///< NaN if it is none

}  // namespace rvbench::hal::formats
