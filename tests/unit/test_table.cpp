#include "program/table.hpp"

#include "test_files.hpp"

namespace geodisk::tools {

TEST_CASE("a table is aligned for people and quoted for programs") {
    Table table({"mesh", "value"});
    table.add({"a, \"b\"", "1.5"});
    table.add({"c", ""});
    CHECK(table.text() == "mesh    value\n"
                          "a, \"b\"    1.5\n"
                          "c           -\n");
    CHECK(table.csv() == "mesh,value\n\"a, \"\"b\"\"\",1.5\nc,\n");
}

TEST_CASE("names of columns may have several lines, and several columns stand to the left") {
    Table table({"kernel", "variant", "code\nsize"});
    table.add({"draw", "box", "1234"});
    CHECK(table.text(2) == "                 code\n"
                           "kernel  variant  size\n"
                           "draw    box      1234\n");
}

} // namespace geodisk::tools
