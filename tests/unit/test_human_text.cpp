#include "program/human_text.hpp"

#include <doctest/doctest.h>

using namespace geodisk::tools;

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

TEST_CASE("in_quotes keeps a message on one short line") {
    CHECK(in_quotes("abc") == "'abc'");
    CHECK(in_quotes("a\nb\x80") == "'a?b?'");
    CHECK(in_quotes("сетка") == "'сетка'");
    CHECK(in_quotes(std::string(100, 'x')) == "'" + std::string(40, 'x') + "...'");
    std::string wide, cut;
    for (int i = 0; i < 50; ++i) {
        wide += "網";
        cut += i < 40 ? "網" : "";
    }
    CHECK(in_quotes(wide) == "'" + cut + "...'");
}
