#include "program/exact_text.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <limits>

using namespace geodisk::tools;

TEST_CASE("exact text reads back as the same number and is no longer than that takes") {
    CHECK(exact_text(0.1) == "0.1");
    CHECK(exact_text(0.1f) == "0.1");
    CHECK(exact_text(1e300) == "1e+300");
    CHECK(exact_text(std::numeric_limits<std::uint64_t>::max()) == "18446744073709551615");
    std::string line = "a,";
    append_number(line, 2.5);
    CHECK(line == "a,2.5");
}

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
