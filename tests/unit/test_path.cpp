#include "program/path.hpp"

#include "test_files.hpp"

namespace geodisk::tools {

TEST_CASE("paths are made from UTF-8 and keep what they were") {
    const std::string name = "W\xc3\xbcrfel \xe7\xab\x8b.ply"; // A cube, in German and Chinese.
    const Path path = name;
    CHECK(path.u8string() == std::u8string(name.begin(), name.end()));
    CHECK(Path(name.c_str()) == path);
    CHECK(Path(std::filesystem::path(u8"a") / path).filename() == path);
    CHECK(Path("").empty());
}

} // namespace geodisk::tools
