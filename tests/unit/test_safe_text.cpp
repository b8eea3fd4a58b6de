// Names and texts that would do something where they go.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "files/samples/sample_file.hpp"
#include "program/command_text.hpp"
#include "program/human_text.hpp"
#include "program/json_text.hpp"
#include "program/safe_text.hpp"
#include "report/page.hpp"
#include "test_files.hpp"

namespace geodisk::tools {
namespace {

struct Hostile {
    std::string text;
    std::string shown; ///< On one line.
};

const std::vector<Hostile>& hostile() {
    static const std::vector<Hostile> kAll{
        {"\x1b[31mred\x1b[0m", "?[31mred?[0m"}, // C0
        {"a\x07\x08\x0b\x0c\x7f", "a?????"},    // C0, delete
        {"\xc2\x9b"
         "31m",
         "?31m"},                            // C1, in UTF-8: CSI
        {"\xc2\x80\xc2\x85\xc2\x9f", "???"}, // C1
        {"\x9b"
         "31m",
         "?31m"},                     // C1, a stray byte
        {"a\nb\r\nc\td", "a b  c d"}, // line breaks
        {"x\xe2\x80\xae"
         "ylp.obj",
         "x?ylp.obj"},                                   // right-to-left override
        {"\xe2\x81\xa6\xe2\x81\xa9\xe2\x80\xaa", "???"}, // isolates, embeddings
        {"\xe2\x80\x8e\xe2\x80\x8f\xd8\x9c", "???"},     // directional marks
        {"\xe2\x80\xa8\xe2\x80\xa9", "??"},              // line and paragraph separators
        {"\xed\xa0\x80", "???"},                         // a lone surrogate
        {"\xc0\xaf\xe0\x80\xaf", "?????"},               // longer forms than need be
        {"\xf4\x90\x80\x80\xf5", "?????"},               // beyond Unicode
        {"a\xd1", "a?"},                                 // cut short
        {"caf\xe9.obj", "caf?.obj"},                     // Latin-1
        {"сетка 網 é 😀", "сетка 網 é 😀"},                // as it is
        {std::string("nul\0end", 7), "nul?end"},
    };
    return kAll;
}

bool has_control(const std::string& text) {
    return !is_printable(text);
}

} // namespace

TEST_CASE("no text controls a terminal") {
    for (const auto& [text, printed] : hostile()) {
        const std::string shown = printed;
        CAPTURE(shown);
        CHECK(one_line(text) == shown);
        CHECK_FALSE(has_control(one_line(text)));
        CHECK_FALSE(has_control(in_quotes(text)));
        CHECK_FALSE(has_control(shell_word(text)));
        CHECK_FALSE(has_control(csv_cell(text)));
        CHECK_FALSE(has_control(csv_comment(text)));
    }
    CHECK(plain_lines("a\nb\x1b\n") == "a\nb?\n");
}

TEST_CASE("JSON holds every name, and no control character as it is") {
    for (const auto& [text, printed] : hostile()) {
        const std::string shown = printed;
        CAPTURE(shown);
        const std::string line = json_text({{"mesh", text}}, -1);
        CHECK_FALSE(has_control(line));
        CHECK(nlohmann::json::parse(line)["mesh"].is_string());
    }
    // Valid UTF-8 comes back as it was; U+FFFD stands for what is not.
    const std::string mixed = "\x1b\xc2\x9b\xe2\x80\xae\n\"</script>";
    CHECK(nlohmann::json::parse(json_text({{"mesh", mixed}}, 2))["mesh"] == mixed);
    CHECK(json_text("a\xff", -1) == "\"a\xef\xbf\xbd\"");
    CHECK(json_text("\xc2\x9b\x7f", -1) == R"("\u009b\u007f")");
}

TEST_CASE("no cell of a CSV file is computed") {
    CHECK(csv_cell("=1+1") == "'=1+1");
    CHECK(csv_cell("+cmd|' /C calc'!A0") == "'+cmd|' /C calc'!A0");
    CHECK(csv_cell("@SUM(A1,A2)") == "\"'@SUM(A1,A2)\"");
    CHECK(csv_cell("-2+3") == "'-2+3");
    CHECK(csv_cell("\t=1") == "' =1");
    CHECK(csv_cell("\r=1") == "' =1");
    CHECK(csv_cell("-6.10") == "-6.10"); // A number is one.
    CHECK(csv_cell("+1e-3") == "+1e-3");
    CHECK(csv_cell("a,b") == "\"a,b\"");
    CHECK(csv_cell("a\nb") == "a b");
    CHECK(csv_comment("mesh: a,=1+1.obj") == "mesh: a,'=1+1.obj");
    CHECK(csv_comment("mesh: a; @x\n,-y") == "mesh: a;' @x ,'-y");
    CHECK(csv_comment("box: 1 x 0.5, open") == "box: 1 x 0.5, open");
}

TEST_CASE("no text ends the script of a page or begins a comment in it") {
    const std::string page =
        report::in_script(json_text({{"mesh", "</script><!--<script>\xe2\x80\xa8"}}, -1));
    CHECK_FALSE(contains(page, "<"));
    CHECK_FALSE(has_control(page));
}

TEST_CASE("a header holds each entry on one line, and the file is read") {
    const TemporaryFolder folder;
    for (const char* const name : {"a.ply", "a.csv", "a.pcd", "a.obj"}) {
        for (const auto& [text, printed] : hostile()) {
            const std::string shown = printed;
            CAPTURE(name);
            CAPTURE(shown);
            const SampleHeader header{{{"mesh", text + ",=1\nend_header"}, {"seed", "7"}}};
            SampleRow row{};
            row.position[0] = 1;
            row.bary[0] = 1;
            write_samples(folder / name, header, std::vector<SampleRow>{row}, true, 3);
            const std::string bytes = bytes_of(folder / name);
            CHECK(contains(bytes, " mesh: " + shown + ",'=1 end_header\n"));
            CHECK(plain_lines(bytes) == bytes);
            if (name[2] == 'p' && name[3] == 'l') {
                const SampleFile back = read_samples(folder / name);
                CHECK(*back.header.find("seed") == "7");
                CHECK(back.rows.size() == 1);
            }
        }
    }
}

} // namespace geodisk::tools
