#include "common/text.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace geodisk::tools;

TEST_CASE("parse_real takes whole decimal numbers only") {
    CHECK(parse_real("1.5") == 1.5);
    CHECK(parse_real("+1.5") == 1.5);
    CHECK(parse_real("-.5") == -0.5);
    CHECK(parse_real("1.") == 1.0);
    CHECK(parse_real("1.5E+00") == 1.5);
    CHECK(parse_real("0.1") == 0.1);
    CHECK(std::isnan(parse_real("nan").value()));
    for (const char* text : {"", "+", "-", "+-1", ".", "e5", "1e", "1,5", "0.5q", "0x10", " 1"}) {
        CAPTURE(text);
        CHECK_FALSE(parse_real(text).has_value());
    }
}

TEST_CASE("parse_real tells too big from too small") {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    CHECK(parse_real("1e999") == kInfinity);
    CHECK(parse_real("-1E+999") == -kInfinity);
    CHECK(parse_real("1e-999") == 0.0);
    CHECK(parse_real("0." + std::string(400, '0') + "1") == 0.0);
    CHECK(parse_real("1" + std::string(400, '0')) == kInfinity);
}

TEST_CASE("parse_integer refuses what does not fit") {
    CHECK(parse_integer<int>("-7") == -7);
    CHECK_FALSE(parse_integer<int>("4294967299").has_value());
    CHECK_FALSE(parse_integer<std::uint32_t>("-1").has_value());
    CHECK_FALSE(parse_integer<int>("1.0").has_value());
    CHECK_FALSE(parse_integer<int>("").has_value());
}

TEST_CASE("in_quotes keeps a message on one short line") {
    CHECK(in_quotes("abc") == "'abc'");
    CHECK(in_quotes("a\nb\x80") == "'a?b?'");
    CHECK(in_quotes(std::string(100, 'x')) == "'" + std::string(40, 'x') + "...'");
}
