#include "paper/table.hpp"

#include "test_files.hpp"

using namespace geodisk::paper;

TEST_CASE("a table is aligned for people and quoted for programs") {
    Table table({"mesh", "value"});
    table.add({"a, \"b\"", "1.5"});
    table.add({"c", ""});
    CHECK(table.text() == "mesh    value\n"
                          "a, \"b\"    1.5\n"
                          "c           -\n");
    CHECK(table.csv() == "mesh,value\n\"a, \"\"b\"\"\",1.5\nc,\n");
}

TEST_CASE("decimals are as many as asked for") {
    CHECK(fixed(0.77912, 4) == "0.7791");
    CHECK(fixed(3, 0) == "3");
    CHECK(fixed(1e300, 0).size() == 301);
}
