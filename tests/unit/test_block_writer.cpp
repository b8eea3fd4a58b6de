#include "files/archives/checksum.hpp"
#include "files/output/block_writer.hpp"
#include "program/exact_text.hpp"
#include "test_files.hpp"

#include <new>
#include <string>

using namespace geodisk::tools;

namespace {

constexpr std::size_t kManyRows = 20 * kRowsPerBlock + 17;

/// The definition, bit by bit.
std::uint32_t plain_crc32(std::string_view bytes) {
    std::uint32_t crc = ~0u;
    for (const char c : bytes) {
        crc ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit) {
            crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
        }
    }
    return ~crc;
}

} // namespace

TEST_CASE("rows are written in order") {
    const TemporaryFolder folder;
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, kRowsPerBlock, kManyRows}) {
        CAPTURE(count);
        AtomicFile file(folder / "rows.txt");
        write_rows(file, count, [](std::string& bytes, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                append_number(bytes, i);
                bytes += '\n';
            }
        });
        file.commit();
        std::string expected;
        for (std::size_t i = 0; i < count; ++i) {
            expected += std::to_string(i) + '\n';
        }
        CHECK(bytes_of(folder / "rows.txt") == expected);
    }
}

TEST_CASE("a row that fails ends the writing") {
    const TemporaryFolder folder;
    const auto write_failing = [&](std::size_t row, const auto& fail) {
        AtomicFile file(folder / "rows.txt");
        write_rows(file, kManyRows, [&](std::string& bytes, std::size_t begin, std::size_t end) {
            if (begin <= row && row < end) {
                fail();
            }
            bytes += 'x';
        });
    };
    for (const std::size_t row : {std::size_t{0}, kManyRows / 2, kManyRows - 1}) {
        CAPTURE(row);
        check_fails(ExitCode::bad_output, "full",
                    [&] { write_failing(row, [] { fail_output("full"); }); });
        CHECK_THROWS_AS(write_failing(row, [] { throw std::bad_alloc(); }), std::bad_alloc);
    }
    CHECK(folder.file_count() == 0);
}

TEST_CASE("the checksum is CRC-32") {
    CHECK(crc32_of("") == 0);
    CHECK(crc32_of("123456789") == 0xcbf43926);
    std::string bytes;
    for (std::uint32_t i = 0; i < 1'000'003; ++i) {
        bytes += static_cast<char>(i * i >> 7);
    }
    for (const std::size_t size : {7u, 8u, 9u, 1u << 18, (1u << 18) + 1, 1'000'003u}) {
        CAPTURE(size);
        const std::string_view part = std::string_view(bytes).substr(0, size);
        CHECK(crc32_of(part) == plain_crc32(part));
    }
}
