#include "bench/xml_text.hpp"

#include <catch2/catch.hpp>

namespace rvbench::bench {
namespace {

const std::string replacement = "\xEF\xBF\xBD";

}  // namespace

TEST_CASE("markup becomes entities, all other text stays as it is", "[bench][xml]") {
  CHECK(xml_escaped("<a b=\"c\">&") == "&lt;a b=&quot;c&quot;&gt;&amp;");
  CHECK(xml_escaped("N·m, m/s², 🔩") == "N·m, m/s², 🔩");
  CHECK(xml_escaped("a\tb\nc\rd") == "a\tb\nc\rd");
  CHECK(xml_escaped("").empty());
}

TEST_CASE("characters that XML 1.0 forbids are replaced", "[bench][xml]") {
  CHECK(xml_escaped("a\x01z") == "a" + replacement + "z");
  CHECK(xml_escaped(std::string("a\0z", 3)) == "a" + replacement + "z");
  CHECK(xml_escaped("\xEF\xBF\xBE") == replacement);  // U+FFFE
  CHECK(xml_escaped("\xEF\xBF\xBF") == replacement);  // U+FFFF
  CHECK(xml_escaped("\xED\x9F\xBF\xEE\x80\x80") ==
        "\xED\x9F\xBF\xEE\x80\x80");                             // beside surrogates
  CHECK(xml_escaped("\xF4\x8F\xBF\xBF") == "\xF4\x8F\xBF\xBF");  // U+10FFFF, the last one
}

TEST_CASE("each byte that is not UTF-8 is replaced", "[bench][xml]") {
  const auto replaced = [](int bytes) {
    std::string all;
    for (int i = 0; i < bytes; ++i) all += replacement;
    return all;
  };
  CHECK(xml_escaped("caf\xe9") == "caf" + replaced(1));
  CHECK(xml_escaped("\xC0\xBC") == replaced(2));          // '<', overlong
  CHECK(xml_escaped("\xE0\x80\xBC") == replaced(3));      // likewise
  CHECK(xml_escaped("\xF0\x80\x80\xBC") == replaced(4));  // likewise
  CHECK(xml_escaped("\xED\xA0\x80") == replaced(3));      // a surrogate
  CHECK(xml_escaped("\xF4\x90\x80\x80") == replaced(4));  // U+110000, beyond the last
  CHECK(xml_escaped("\xF5\x80\x80\x80") == replaced(4));
  CHECK(xml_escaped("\x80z") == replaced(1) + "z");         // nothing that it could go on from
  CHECK(xml_escaped("\xE2\x82<") == replaced(2) + "&lt;");  // cut off
}

}  // namespace rvbench::bench
