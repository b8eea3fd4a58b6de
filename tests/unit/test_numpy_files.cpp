// Samples and points in files of numpy.
#include "files/samples/sample_file.hpp"

#include "files/archives/zip_writer.hpp"
#include "files/byte_order.hpp"
#include "files/output/output_file.hpp"
#include "support/data_file.hpp"
#include "test_files.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

using namespace geodisk::tools;

namespace {

/// An array as numpy saves it.
template <class Value>
std::string npy(const std::string& type, const std::string& shape, const std::vector<Value>& values,
                bool is_by_columns = false) {
    const std::string header = "{'descr': '" + type +
                               "', 'fortran_order': " + (is_by_columns ? "True" : "False") +
                               ", 'shape': " + shape + ", }\n";
    std::string bytes("\x93NUMPY\x01\x00", 8);
    append_little_endian(bytes, static_cast<std::uint16_t>(header.size()));
    bytes += header;
    for (const Value value : values) {
        std::string raw;
        append_little_endian(raw, value);
        if (type[0] == '>') {
            std::ranges::reverse(raw);
        }
        bytes += raw;
    }
    return bytes;
}

std::string npz(const std::vector<std::pair<std::string, std::string>>& arrays) {
    const TemporaryFolder folder;
    AtomicFile file((folder / "a.npz").string());
    ZipWriter zip(file);
    for (const auto& [name, content] : arrays) {
        zip.add(name + ".npy", content);
    }
    zip.finish();
    file.commit();
    return bytes_of(folder / "a.npz");
}

void check_array_refused(std::string_view name, std::string_view bytes, std::string_view part) {
    const TemporaryFolder folder;
    check_fails(ExitCode::bad_input, part, [&] { read_samples(folder.write(name, bytes)); });
}

const std::vector<double> kRows{1, 2, 3, 4, 5.5, -6};

} // namespace

TEST_CASE("points of numpy are read in any type, order and name") {
    const TemporaryFolder folder;
    const auto check = [&](const std::string& name, const std::string& bytes) {
        CAPTURE(name);
        const SampleFile file = read_samples(folder.write(name, bytes));
        CHECK_FALSE(file.has_faces);
        CHECK(file.dimension == 3);
        REQUIRE(file.rows.size() == 2);
        CHECK(file.rows[1].position[0] == 4);
        CHECK(file.rows[1].position[1] == 5.5);
        CHECK(file.rows[1].position[2] == -6);
    };
    const std::vector<float> floats(kRows.begin(), kRows.end());
    const std::string rows = npy("<f8", "(2, 3)", kRows);
    check("a.npy", rows);
    check("pipe", rows); // Without an extension, by how it begins.
    check("b.npy", npy(">f4", "(2, 3)", floats));
    check("c.npy", npy<double>("<f8", "(2, 3)", {1, 4, 2, 5.5, 3, -6}, true));
    check("a.npz", npz({{"verts", rows}, {"order", npy<double>("<f8", "(1, 2)", {7, 8})}}));
    check("b.npz", npz({{"points", rows}, {"normals", rows}, {"colors", rows}}));
    check("c.npz", npz({{"x", npy<double>("<f8", "(2,)", {1, 4})},
                        {"y", npy<float>("<f4", "(2,)", {2, 5.5f})},
                        {"z", npy<std::int8_t>("|i1", "(2,)", {3, -6})}}));
    CHECK(read_samples(folder.write("e.npy", npy<double>("<f8", "(0, 3)", {}))).rows.empty());
    CHECK(read_samples(folder.write("f.npy", npy<double>("<f8", "(1, 5)", {1, 2, 3, 4, 5})))
              .dimension == 5);
    const SampleFile radii = read_samples(
        folder.write("w.npz",
                     npz({{"points", rows}, {"size", npy<double>("<f8", "(2,)", {.5, .25})}})),
        "size");
    CHECK(radii.numbers == std::vector{.5, .25});
    check("d.npz", bytes_of(geodisk::test::data_file("cases/points_compressed.npz").value()));
}

TEST_CASE("samples in arrays of numpy are whole, whoever wrote them") {
    const TemporaryFolder folder;
    std::vector<std::pair<std::string, std::string>> arrays{
        {"points", npy("<f8", "(2, 3)", kRows)},
        {"face_index", npy<std::int64_t>("<i8", "(2,)", {7, 9})},
        {"barycentric", npy<double>("<f8", "(2, 3)", {1, 0, 0, .5, .25, .25})},
        {"radius", npy<double>("<f8", "(2,)", {.25, .25})},
        {"existing", npy<std::uint8_t>("|b1", "(2,)", {1, 0})},
        {"min_distance", npy<double>("<f8", "()", {.5})}};
    const SampleFile file = read_samples(folder.write("a.npz", npz(arrays)));
    CHECK(file.has_faces);
    CHECK(file.rows[1].face == 9);
    CHECK(file.rows[1].bary[1] == 0.25f);
    CHECK(file.rows[1].radius == 0); // All are half of the distance, so they do not vary.
    CHECK(*file.header.find("min_distance") == "0.5");
    CHECK(file.extra_values("existing")[0] == 1);
    arrays[3].second = npy<double>("<f8", "(2,)", {.25, .125});
    CHECK(read_samples(folder.write("b.npz", npz(arrays))).rows[1].radius == .125);
    arrays[1].second = npy<std::int64_t>("<i8", "(1,)", {7});
    check_array_refused("c.npz", npz(arrays),
                        "array 'face_index' has 1 rows, but there are 2 samples");
    arrays[1].second = npy<std::int64_t>("<i8", "(2,)", {7, -1});
    check_array_refused("c.npz", npz(arrays), "row 1: face_index is out of range");
    arrays.erase(arrays.begin() + 2);
    check_array_refused("c.npz", npz(arrays), "no column bary_u");
}

TEST_CASE("files of numpy that hold no samples are refused with what they hold") {
    const std::string rows = npy("<f8", "(2, 3)", kRows);
    check_array_refused("a.npz", "", "is no file of numpy");
    check_array_refused("a.npy", "1 2 3\n", "is no file of numpy");
    check_array_refused("a.npy", npy("<f8", "(3, 2)", kRows), "no column z");
    check_array_refused("a.npy", npy("<f8", "(6,)", kRows),
                        "but float64 (6,); save the positions as");
    check_array_refused("a.npy", npy<double>("<f8", "(1, 9)", std::vector<double>(9)),
                        "its points are float64 (1, 9); save them as float64 of shape (n, 3)");
    check_array_refused("a.npy", npy<std::uint16_t>("<f2", "(2, 3)", {0, 0, 0, 0, 0, 0}),
                        "its points are <f2 (2, 3); save them as float64");
    check_array_refused("a.npy", npy("<f8", "(2, 4)", kRows), "fewer values than its shape says");
    check_array_refused("a.npy", npy("<f8", "(2, 9223372036854775808, 4)", kRows), "fewer values");
    check_array_refused("a.npy", npy("<f8", "(2, x)", kRows), "which is none");
    check_array_refused(
        "a.npy", npy<double>("<f8", "(1, 3)", {1, std::numeric_limits<double>::infinity(), 0}),
        "row 0: y");
    std::string records = rows;
    records.replace(records.find("'<f8'"), 5, "[('x'");
    check_array_refused("a.npy", records, "has records instead of numbers");
    check_array_refused("a.npy", rows.substr(0, 20), "ends within its header");
    check_array_refused("a.npz", npz({{"a", rows}, {"b", rows}}),
                        "several of shape (n, 3), but a float64 (2, 3), b float64 (2, 3)");
    check_array_refused("a.npz", npz({}), "is a ZIP archive without arrays of numpy");
}

TEST_CASE("damaged archives are refused") {
    const std::string good = npz({{"points", npy("<f8", "(2, 3)", kRows)}});
    for (std::size_t size = 4; size < good.size(); ++size) {
        check_array_refused("a.npz", good.substr(0, size), "is no whole ZIP archive");
    }
    const TemporaryFolder folder;
    const std::size_t local = 30 + std::string("points.npy").size();
    for (std::size_t i = local; i < good.size(); ++i) {
        std::string bad = good;
        bad[i] = static_cast<char>(bad[i] ^ 0x55);
        try { // Some bytes mean nothing here, such as the time.
            const SampleFile file = read_samples(folder.write("a.npz", bad));
            CHECK(file.rows.size() == 2);
        } catch (const UserError& error) {
            CHECK(error.code() == ExitCode::bad_input);
        }
    }
}

TEST_CASE("archives whose files share bytes are refused") {
    const std::string good = npz({{"points", npy("<f8", "(100, 3)", std::vector<double>(300, 1))}});
    const std::size_t entry = 46 + std::string("points.npy").size(), end = 22;
    const std::string listed = good.substr(good.size() - end - entry, entry);
    std::string bad = good;
    bad.insert(good.size() - end, listed);
    bad[bad.size() - end + 10] = 2; // Files in the directory.
    check_array_refused("a.npz", bad, "is a damaged ZIP archive");
}
