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
