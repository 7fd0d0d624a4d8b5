#pragma once

#include <string>
#include <vector>

/// Small pieces of HTML. Everything that comes from outside passes through xml_escaped().
namespace rvbench::bench::report {

/// A heading and its body; empty if the body is.
std::string section(const std::string& heading, const std::string& body);

/// A table whose cells are HTML already. Rows may be shorter than the head.
std::string table(const std::vector<std::string>& head,
                  const std::vector<std::vector<std::string>>& rows);

/// `value` to three or so digits; "–" if it is not known.
std::string number(double value, int significant = 3);

/// An order with its fraction of 121 where it is one: "0.3223 (39/121)".
std::string order_text(double order, double period_turns);

/// "171.56 Hz at 1815 rpm": a frequency says nothing without the speed, which its order tells.
std::string frequency_text(double frequency_Hz, double order);

/// "< 1e-15" where a p-value is too small to mean its digits.
std::string p_value_text(double p_value);

std::string spoken(std::string name);  ///< "input_shaft" → "input shaft", escaped

std::string paragraph(const std::string& text);  ///< escapes `text`

}  // namespace rvbench::bench::report
