#include "common/number_text.hpp"

#include <doctest/doctest.h>

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

TEST_CASE("rounded text has significant digits without trailing zeros") {
    CHECK(rounded(0.034840812, 6) == "0.0348408");
    CHECK(rounded(2.5, 6) == "2.5");
    CHECK(rounded(1234567, 3) == "1.23e+06");
}

TEST_CASE("decimals are as many as asked for") {
    CHECK(fixed(0.77912, 4) == "0.7791");
    CHECK(fixed(3, 0) == "3");
    CHECK(fixed(1e300, 0).size() == 301);
}
