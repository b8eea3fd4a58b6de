// Sample files that geodisk writes for others, read back by means of their own.
#include "files/samples/sample_file.hpp"

#include "files/meshes/data_uri.hpp"
#include "files/output/output_file.hpp"
#include "geometry/frames.hpp"
#include "test_files.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

using namespace geodisk::tools;

namespace {

using Json = nlohmann::json;

const SampleHeader kFormatHeader{{{"version", "geodisk 0.1.0"},
                                  {"mesh", "caf\xc3\xa9.obj"},
                                  {"lift", "normals:1"},
                                  {"lift", "attribute:q:2"},
                                  {"min_distance", "0.25"},
                                  {"seed", "18446744073709551615"},
                                  {"device", "not \xff UTF-8"}}};

std::vector<SampleRow> rows_of_format(double offset, double radius = 0) {
    std::vector<SampleRow> rows;
    for (std::uint32_t i = 0; i < 5; ++i) {
        SampleRow row;
        for (std::size_t k = 0; k < 8; ++k) {
            row.position[k] = offset + std::sin(i * 1.7 + static_cast<double>(k));
        }
        row.normal[i % 3] = i < 3 ? 1.0f : -1.0f;
        row.face = 1000 + i;
        row.bary[0] = 0.25f;
        row.bary[1] = 0.75f;
        row.radius = radius > 0 ? radius + i : 0;
        rows.push_back(row);
    }
    return rows;
}

template <class Value>
Value value_at(std::string_view bytes, std::size_t at) {
    Value value;
    REQUIRE(at + sizeof value <= bytes.size());
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

/// The files of an archive that stores them, by its local headers.
std::map<std::string, std::string> files_of_zip(const std::string& bytes) {
    std::map<std::string, std::string> files;
    std::size_t at = 0;
    while (value_at<std::uint32_t>(bytes, at) == 0x04034b50) {
        CHECK(value_at<std::uint16_t>(bytes, at + 8) == 0);         // Stored.
        CHECK(value_at<std::uint32_t>(bytes, at + 10) == 0x210000); // 1 January 1980.
        const auto size = value_at<std::uint32_t>(bytes, at + 18);
        const auto name = value_at<std::uint16_t>(bytes, at + 26);
        files[bytes.substr(at + 30, name)] = bytes.substr(at + 30 + name, size);
        at += 30u + name + size;
    }
    CHECK(value_at<std::uint32_t>(bytes, at) == 0x02014b50); // The directory.
    CHECK(value_at<std::uint32_t>(bytes, bytes.size() - 22) == 0x06054b50);
    CHECK(value_at<std::uint32_t>(bytes, bytes.size() - 6) == at);
    CHECK(value_at<std::uint16_t>(bytes, bytes.size() - 12) == files.size());
    return files;
}

struct Array {
    std::string description; ///< As Python spells it.
    std::string content;
};

Array array_of(const std::string& npy) {
    REQUIRE(npy.starts_with(std::string("\x93NUMPY\x01\x00", 8)));
    const auto size = value_at<std::uint16_t>(npy, 8);
    CHECK((10 + size) % 64 == 0);
    return {npy.substr(10, size), npy.substr(10u + size)};
}

std::string written(const std::string& name, const std::vector<SampleRow>& rows,
                    std::uint32_t dimension = 3, bool is_text = false) {
    const TemporaryFolder folder;
    write_samples(folder / name, kFormatHeader, rows, is_text, dimension);
    std::string bytes = bytes_of(folder / name);
    write_samples(folder / name, kFormatHeader, rows, is_text, dimension);
    CHECK(bytes_of(folder / name) == bytes); // Whenever it is written.
    CHECK(folder.file_count() == 1);
    return bytes;
}

struct GltfFile {
    Json document = Json::object();
    std::string buffer;
};

/// The document and the buffer of a file of glTF, text or binary.
GltfFile gltf_of(const std::string& bytes) {
    GltfFile file;
    if (!bytes.starts_with("glTF")) {
        file.document = Json::parse(bytes);
        const auto buffer = data_of_uri(file.document["buffers"].at(0)["uri"].get<std::string>());
        REQUIRE(buffer);
        file.buffer = *buffer;
    } else {
        CHECK(value_at<std::uint32_t>(bytes, 4) == 2);
        CHECK(value_at<std::uint32_t>(bytes, 8) == bytes.size());
        const auto text = value_at<std::uint32_t>(bytes, 12);
        CHECK(text % 4 == 0);
        CHECK(bytes.substr(16, 4) == "JSON");
        file.document = Json::parse(bytes.substr(20, text)); // Blanks at its end are JSON.
        CHECK_FALSE(file.document["buffers"].at(0).contains("uri"));
        CHECK(value_at<std::uint32_t>(bytes, 20 + text) == bytes.size() - 28 - text);
        CHECK(bytes.substr(24 + text, 4) == std::string("BIN\0", 4));
        file.buffer = bytes.substr(28 + text);
        CHECK(file.buffer.size() % 4 == 0);
    }
    CHECK(file.document["buffers"].size() == 1);
    CHECK(file.document["buffers"][0]["byteLength"] == file.buffer.size());
    return file;
}

std::string written_box(const std::string& name, const std::vector<SampleRow>& rows,
                        std::uint32_t dimension) {
    const TemporaryFolder folder;
    AtomicFile file(folder / name);
    write_box_samples(file, sample_target(folder / name), kFormatHeader, rows, dimension);
    file.commit();
    return bytes_of(folder / name);
}

} // namespace

TEST_CASE("OBJ has points and their normals") {
    const std::vector<SampleRow> rows = rows_of_format(0);
    const std::vector<std::string> lines = lines_of(written("a.obj", rows));
    REQUIRE(lines.size() == 7 + 3 * 5);
    CHECK(lines[0] == "# version: geodisk 0.1.0");
    CHECK(lines[8].starts_with("v 0.99166481"));
    CHECK(lines[12] == "vn 1 0 0");
    CHECK(lines[17] == "p 1");
    CHECK(lines[21] == "p 5");
    const std::string box = written_box("a.obj", rows_of_format(0), 2);
    CHECK_FALSE(contains(box, "vn "));
    CHECK(contains(box, "p 5\n"));
}

TEST_CASE("PCD tells its fields, in text and binary") {
    const std::vector<SampleRow> rows = rows_of_format(0, 0.5);
    const std::string text = written("a.pcd", rows, 3, true);
    CHECK(text.starts_with("# .PCD v0.7 - Point Cloud Data file format\n# version: geodisk"));
    const std::string fields =
        "VERSION 0.7\nFIELDS x y z normal_x normal_y normal_z face_index bary_u bary_v bary_w "
        "radius\nSIZE 4 4 4 4 4 4 4 4 4 4 8\nTYPE F F F F F F U F F F F\n"
        "COUNT 1 1 1 1 1 1 1 1 1 1 1\nWIDTH 5\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 5\n";
    REQUIRE(contains(text, fields + "DATA ascii\n"));
    CHECK(contains(text, " 1 0 0 1000 0.25 0.75 0 0.5\n"));
    const std::string binary = written("a.pcd", rows);
    REQUIRE(contains(binary, fields + "DATA binary\n"));
    const std::size_t body = binary.find("DATA binary\n") + 12;
    constexpr std::size_t kRecord = 10 * 4 + 8;
    REQUIRE(binary.size() == body + 5 * kRecord);
    for (std::size_t i = 0; i < 5; ++i) {
        const std::size_t at = body + i * kRecord;
        CHECK(value_at<float>(binary, at) == static_cast<float>(rows[i].position[0]));
        CHECK(value_at<float>(binary, at + 12) == rows[i].normal[0]);
        CHECK(value_at<std::uint32_t>(binary, at + 24) == rows[i].face);
        CHECK(value_at<float>(binary, at + 32) == 0.75f);
        CHECK(value_at<double>(binary, at + 40) == rows[i].radius);
    }
    // Others read x y z as floats, so these are kept about a point that the header names.
    const std::vector<SampleRow> far = rows_of_format(1e7);
    for (const bool is_text : {false, true}) {
        const std::string bytes = written("b.pcd", far, 3, is_text);
        CHECK(contains(bytes, "SIZE 4 4 4 4"));
        CHECK(contains(bytes, "# origin: "));
        const TemporaryFolder folder;
        const SampleFile read = read_samples(folder.write("b.pcd", bytes));
        REQUIRE(read.rows.size() == far.size());
        CHECK(std::abs(read.rows[3].position[1] - far[3].position[1]) < 1e-6);
        CHECK(read.rows[3].face == far[3].face);
        CHECK(read.header.find("origin") == nullptr);
    }
    CHECK(precision_note(sample_target("b.pcd"), far, 3));
    CHECK_FALSE(precision_note(sample_target("b.pcd"), rows, 3));
    CHECK_FALSE(precision_note(sample_target("b.ply"), far, 3));
    CHECK(contains(written("b.pcd", rows_of_format(0), 4), "FIELDS x y z x0 x1 x2 x3 face_index"));
    CHECK(contains(written_box("b.pcd", rows_of_format(0), 2), "FIELDS x y z\nSIZE 4 4 4\n"));
}

TEST_CASE("distances in a box that a float rounds are told") {
    const std::vector<SampleRow> rows = rows_of_format(0);
    const auto note = rounding_note(sample_target("b.pcd"), rows, 2, 1e-3);
    REQUIRE(note);
    CHECK(contains(*note, ".pcd holds floats, which change distances by up to "));
    CHECK_FALSE(rounding_note(sample_target("b.pcd"), rows, 2, 1e3));
    CHECK_FALSE(rounding_note(sample_target("b.ply"), rows, 2, 1e-3));
}

TEST_CASE("numbers that a float does not hold are told") {
    for (const char* const name : {"a.pcd", "a.gltf", "a.glb"}) {
        for (const double scale : {1e39, 1e-40}) {
            std::vector<SampleRow> rows = rows_of_format(0);
            for (SampleRow& row : rows) {
                for (double& x : row.position) {
                    x *= scale;
                }
            }
            check_fails(ExitCode::usage, "holds floats, and these samples have coordinates up to",
                        [&] { written(name, rows); });
        }
    }
}

TEST_CASE("NPZ has arrays of numpy") {
    const std::vector<SampleRow> rows = rows_of_format(0, 0.5);
    const auto files = files_of_zip(written("a.npz", rows));
    CHECK(files.size() == 8);
    const auto check = [&](const std::string& name, const std::string& type,
                           const std::string& shape, std::size_t size) {
        CAPTURE(name);
        REQUIRE(files.contains(name + ".npy"));
        const Array array = array_of(files.at(name + ".npy"));
        CHECK(array.description.starts_with(
            "{'descr': '" + type + "', 'fortran_order': False, 'shape': " + shape + ", }"));
        CHECK(array.content.size() == size);
        return array.content;
    };
    const std::string points = check("points", "<f8", "(5, 3)", std::size_t{5} * 24);
    const std::string faces = check("face_index", "<u4", "(5,)", std::size_t{5} * 4);
    const std::string weights = check("barycentric", "<f8", "(5, 3)", std::size_t{5} * 24);
    const std::string normals = check("normals", "<f8", "(5, 3)", std::size_t{5} * 24);
    const std::string radii = check("radius", "<f8", "(5,)", std::size_t{5} * 8);
    for (std::size_t i = 0; i < 5; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t at = 24 * i + 8 * k;
            CHECK(value_at<double>(points, at) == rows[i].position[k]);
            CHECK(value_at<double>(normals, at) == static_cast<double>(rows[i].normal[k]));
            CHECK(value_at<double>(weights, at) == static_cast<double>(rows[i].bary[k]));
        }
        CHECK(value_at<std::uint32_t>(faces, 4 * i) == rows[i].face);
        CHECK(value_at<double>(radii, 8 * i) == rows[i].radius);
    }
    CHECK(value_at<double>(check("min_distance", "<f8", "()", 8), 0) == 0.25);
    CHECK(value_at<std::uint64_t>(check("seed", "<u8", "()", 8), 0) == ~std::uint64_t{0});
    const Array header = array_of(files.at("header.npy"));
    std::string text;
    for (std::size_t at = 0; at < header.content.size(); at += 4) {
        text += static_cast<char>(value_at<std::uint32_t>(header.content, at));
    }
    CHECK(text == R"({"version":"geodisk 0.1.0","mesh":"caf\u00e9.obj",)"
                  R"("lift":["normals:1","attribute:q:2"],"min_distance":"0.25",)"
                  R"("seed":"18446744073709551615","device":"not \ufffd UTF-8"})");
    CHECK(contains(header.description, "'<U" + std::to_string(text.size()) + "'"));
}

TEST_CASE("NPZ has what coordinates there are") {
    const auto points_of = [](const std::map<std::string, std::string>& files) {
        return array_of(files.at("points.npy")).description;
    };
    const auto five = files_of_zip(written("a.npz", rows_of_format(0), 5));
    CHECK(contains(points_of(five), "(5, 5)"));
    CHECK_FALSE(five.contains("normals.npy"));
    CHECK_FALSE(five.contains("radius.npy"));
    const auto none = files_of_zip(written("a.npz", rows_of_format(0), 0));
    CHECK_FALSE(none.contains("points.npy"));
    CHECK(none.contains("barycentric.npy"));
    const auto box = files_of_zip(written_box("a.npz", rows_of_format(0), 2));
    CHECK(contains(points_of(box), "(5, 2)"));
    CHECK_FALSE(box.contains("face_index.npy"));
    CHECK(contains(points_of(files_of_zip(written("a.npz", {}))), "(0, 3)"));
}

TEST_CASE("a ZIP archive has the checksums of its files") {
    const TemporaryFolder folder;
    write_samples(folder / "a.npz", {}, {}, false, 0);
    const std::string bytes = bytes_of(folder / "a.npz");
    // The first file is face_index.npy of no faces, whose checksum zlib tells.
    CHECK(value_at<std::uint32_t>(bytes, 14) == 0x0b353cc8);
}

TEST_CASE("glTF has points with attributes") {
    const double offset = 1e7;
    for (const std::string name : {"a.glb", "a.gltf"}) {
        CAPTURE(name);
        const std::vector<SampleRow> rows = rows_of_format(offset, 0.5);
        const std::string bytes = written(name, rows);
        const GltfFile file = gltf_of(bytes);
        const Json& document = file.document;
        CHECK(document["asset"]["version"] == "2.0");
        CHECK(document["asset"]["extras"]["min_distance"] == "0.25");
        CHECK(document["asset"]["extras"]["lift"].size() == 2);
        REQUIRE(document["meshes"].size() == 1);
        CHECK(document["scenes"][document["scene"].get<std::size_t>()]["nodes"] ==
              Json::array({0}));
        const Json& points = document["meshes"][0]["primitives"][0];
        CHECK(points["mode"] == 0);
        CHECK(points["attributes"].size() == 5);
        const auto values = [&](const char* attribute, std::size_t components) {
            const Json& accessor =
                document["accessors"].at(points["attributes"].at(attribute).get<std::size_t>());
            CHECK(accessor["count"] == 5);
            CHECK(accessor["componentType"] == 5126);
            CHECK(accessor["type"] == (components == 1 ? "SCALAR" : "VEC3"));
            const Json& view =
                document["bufferViews"].at(accessor["bufferView"].get<std::size_t>());
            CHECK(view["buffer"] == 0);
            const auto begin = view.value("byteOffset", std::size_t{0});
            CHECK(begin % sizeof(float) == 0);
            std::vector<float> all(5 * components);
            REQUIRE(view["byteLength"] == 4 * all.size());
            for (std::size_t i = 0; i < all.size(); ++i) {
                all[i] = value_at<float>(file.buffer, begin + 4 * i);
            }
            for (std::size_t k = 0; k < components; ++k) {
                double least = HUGE_VAL, most = -HUGE_VAL;
                for (std::size_t i = k; i < all.size(); i += components) {
                    least = std::min(least, static_cast<double>(all[i]));
                    most = std::max(most, static_cast<double>(all[i]));
                }
                CHECK(accessor["min"].at(k) == least);
                CHECK(accessor["max"].at(k) == most);
            }
            CHECK(accessor["min"].size() == components);
            CHECK(accessor["max"].size() == components);
            return all;
        };
        REQUIRE(document["nodes"].size() == 1);
        CHECK(document["nodes"][0]["mesh"] == 0);
        const auto origin = document["nodes"][0]["translation"].get<std::array<double, 3>>();
        const auto positions = values("POSITION", 3), normals = values("NORMAL", 3),
                   weights = values("_BARYCENTRIC", 3), faces = values("_FACE_INDEX", 1),
                   radii = values("_RADIUS", 1);
        for (std::size_t i = 0; i < 5; ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                CHECK(std::abs(origin[k] + static_cast<double>(positions[3 * i + k]) -
                               rows[i].position[k]) < 1e-6);
                CHECK(normals[3 * i + k] == rows[i].normal[k]);
                CHECK(weights[3 * i + k] == rows[i].bary[k]);
            }
            CHECK(faces[i] == static_cast<float>(rows[i].face));
            CHECK(static_cast<double>(radii[i]) == rows[i].radius);
        }
    }
    CHECK_FALSE(contains(written("b.gltf", rows_of_format(0)), "translation"));
    CHECK_FALSE(contains(written_box("b.gltf", rows_of_format(0), 2), "NORMAL"));
    CHECK_FALSE(contains(written("b.gltf", {}), "accessors"));
    std::vector<SampleRow> far = rows_of_format(0);
    far[3].face = (1u << 24) + 1;
    check_fails(ExitCode::usage, "up to 16,777,216", [&] { written("b.glb", far); });
}

TEST_CASE("scenes hold attributes of more than four numbers, and none twice") {
    const std::vector<SampleRow> rows = rows_of_format(0);
    SampleField wide{"c", {"c_0", "c_1", "c_2", "c_3", "c_4"}, false, false, {}, false};
    for (std::size_t i = 0; i < 5 * rows.size(); ++i) {
        wide.values.push_back(static_cast<double>(i));
    }
    const auto bytes_with = [&](const std::string& name, std::vector<SampleField> fields) {
        const TemporaryFolder folder;
        AtomicFile file(folder / name);
        write_samples(file, sample_target(folder / name), kFormatHeader, rows, 3, {{}, fields});
        file.commit();
        return bytes_of(folder / name);
    };
    for (const char* const name : {"a.gltf", "a.glb"}) {
        CAPTURE(name);
        const GltfFile file = gltf_of(bytes_with(name, {wide}));
        const Json& attributes = file.document["meshes"][0]["primitives"][0]["attributes"];
        for (std::size_t k = 0; k < 5; ++k) {
            const Json& accessor = file.document["accessors"].at(
                attributes.at("_C_" + std::to_string(k)).get<std::size_t>());
            CHECK(accessor["type"] == "SCALAR");
            CHECK(accessor["min"].at(0) == static_cast<double>(k));
            CHECK(accessor["max"].at(0) == static_cast<double>(5 * (rows.size() - 1) + k));
        }
    }
    const std::string usd = bytes_with("a.usda", {wide});
    CHECK(contains(usd, "float[] primvars:c = [0, 1, 2, 3, 4, 5, "));
    CHECK(contains(usd, "] (\n        elementSize = 5\n        interpolation = \"vertex\"\n"));

    const SampleField lower{"a", {"a"}, false, false, std::vector<double>(rows.size()), false};
    SampleField upper = lower;
    upper.name = "A";
    check_fails(ExitCode::usage, "two attributes of glTF would be called '_A'", [&] {
        bytes_with("b.glb", {lower, upper});
    });
}

TEST_CASE("formats refuse what they cannot hold") {
    const TemporaryFolder folder;
    for (const char* const name : {"a.xyz", "a.obj", "a.gltf", "a.glb"}) {
        check_fails(ExitCode::usage, "holds three coordinates, and these samples have 4",
                    [&] { check_dimension(sample_target(folder / name), 4); });
        check_box_dimension(sample_target(folder / name), 2);
    }
    check_fails(ExitCode::usage, "these samples have none",
                [&] { check_dimension(sample_target(folder / "a.pcd"), 0); });
    check_dimension(sample_target(folder / "a.npz"), 0);
}

TEST_CASE("a format that is asked for counts more than the extension") {
    CHECK(sample_target("a.ply", "csv").format == SampleFormat::csv);
    CHECK(sample_target("a", "npz").format == SampleFormat::npz);
    CHECK(sample_target("a.NPZ").format == SampleFormat::npz);
    check_fails(ExitCode::usage, "--format: 'las' is no sample format; known are ply, csv",
                [] { sample_target("a.ply", "las"); });
}

namespace {

/// The labels of the last loop of a STAR file, and the words of its rows.
struct StarTable {
    std::vector<std::string> labels;
    std::vector<std::vector<std::string>> rows;

    explicit StarTable(const std::string& text) {
        const std::size_t begin = text.find("data_particles\n");
        REQUIRE(begin != text.npos);
        for (const std::string& line : lines_of(text.substr(begin))) {
            std::istringstream stream(line);
            std::vector<std::string> words;
            for (std::string word; stream >> word;) {
                words.push_back(word);
            }
            if (line.starts_with('_')) {
                REQUIRE(words.size() == 2);
                labels.push_back(words[0]);
                CHECK(words[1] == "#" + std::to_string(labels.size()));
            } else if (words.size() > 1) {
                CHECK(words.size() == labels.size());
                rows.push_back(words);
            }
        }
    }

    double number(std::size_t row, const std::string& label) const {
        const auto found = std::ranges::find(labels, label);
        REQUIRE(found != labels.end());
        return std::stod(rows.at(row).at(static_cast<std::size_t>(found - labels.begin())));
    }
};

using Matrix = std::array<std::array<double, 3>, 3>;

Matrix product(const Matrix& a, const Matrix& b) {
    Matrix c{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            for (std::size_t k = 0; k < 3; ++k) {
                c[i][j] += a[i][k] * b[k][j];
            }
        }
    }
    return c;
}

/// What turns the reference of RELION to a particle: coordinates turn by rot about z, tilt about y
/// and psi about z, one after the other, so that vectors turn the other way.
Matrix rotation_of(const StarTable& table, std::size_t row) {
    const auto turn_of_coordinates = [](double degrees, bool about_z) {
        const double c = std::cos(degrees * 0.017453292519943295),
                     s = std::sin(degrees * 0.017453292519943295);
        return about_z ? Matrix{{{c, s, 0}, {-s, c, 0}, {0, 0, 1}}}
                       : Matrix{{{c, 0, -s}, {0, 1, 0}, {s, 0, c}}};
    };
    return product(turn_of_coordinates(table.number(row, "_rlnAnglePsi"), true),
                   product(turn_of_coordinates(table.number(row, "_rlnAngleTilt"), false),
                           turn_of_coordinates(table.number(row, "_rlnAngleRot"), true)));
}

std::string star_of(const std::vector<SampleRow>& rows, const FurtherColumns& further = {},
                    std::optional<double> pixel_size = std::nullopt,
                    const std::string& mesh = "a.ply", bool has_header = true) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder / "a.star";
    AtomicFile file(path);
    SampleTarget target = sample_target(path);
    target.pixel_size = pixel_size;
    target.has_header = has_header;
    write_samples(file, target, {{{"mesh", mesh}, {"seed", "7"}}}, rows, 3, further);
    file.commit();
    return bytes_of(path);
}

} // namespace

TEST_CASE("the angles of STAR turn z to the normal, by those of a frame as the frame does") {
    std::vector<SampleRow> rows;
    const std::vector<std::array<float, 3>> known{
        {0, 0, 1}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0}, {0, -1, 0}, {-1, 0, 0}, {0.48f, -0.6f, 0.64f}};
    SampleField frames{"frames", {"qx", "qy", "qz", "qw"}, false, false, {}, false};
    for (const std::array<float, 3>& normal : known) {
        rows.emplace_back();
        std::ranges::copy(normal, rows.back().normal);
        const auto q = frame_of({normal[0], normal[1], normal[2]}, 1.0 + double(rows.size()));
        frames.values.insert(frames.values.end(), q.begin(), q.end());
    }
    const StarTable plain(star_of(rows));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Matrix turn = rotation_of(plain, i);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            CHECK(std::abs(turn[axis][2] - double{known[i][axis]}) < 1e-7);
        }
        CHECK(plain.number(i, "_rlnAngleRot") == 0);
    }
    CHECK(plain.number(0, "_rlnAngleTilt") == 0);
    CHECK(plain.number(0, "_rlnAnglePsi") == 0);
    CHECK(plain.number(1, "_rlnAngleTilt") == 90);
    CHECK(std::abs(plain.number(1, "_rlnAnglePsi")) == 180);
    CHECK(plain.number(2, "_rlnAngleTilt") == 180);
    CHECK(plain.number(3, "_rlnAngleTilt") == 90);
    CHECK(plain.number(3, "_rlnAnglePsi") == 90);
    CHECK(plain.number(4, "_rlnAnglePsi") == -90);

    const std::vector<SampleField> fields{frames,
                                          {"heat", {"heat"}, false, false, {1, 2, 3, 4, 5, 6, 7}}};
    const std::vector<ExtraColumn> numbers{{"class", {0, 1, 0, 1, 0, 1, 2}}};
    const StarTable framed(star_of(rows, {numbers, fields}));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Matrix turn = rotation_of(framed, i);
        const double x = frames.values[4 * i], y = frames.values[4 * i + 1],
                     z = frames.values[4 * i + 2], w = frames.values[4 * i + 3];
        const Matrix expected{
            {{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
             {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
             {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}}};
        for (std::size_t k = 0; k < 9; ++k) {
            CHECK(std::abs(turn[k / 3][k % 3] - expected[k / 3][k % 3]) < 1e-7);
        }
    }
    CHECK(framed.labels.back() == "_heat");
    CHECK(framed.number(6, "_heat") == 7);
    CHECK(framed.number(6, "_class") == 2);
}

TEST_CASE("STAR has pixels, and names that are one word") {
    const std::vector<SampleRow> rows = rows_of_format(100);
    const std::string text = star_of(rows, {}, 4.0, "dir/my membrane#1.ply");
    CHECK(text.starts_with("# mesh: "));
    CHECK(contains(text, "\ndata_optics\n\nloop_\n_rlnOpticsGroupName #1\n_rlnOpticsGroup #2\n"
                         "_rlnImagePixelSize #3\nopticsGroup1 1 4\n"));
    const StarTable table(text);
    REQUIRE(table.rows.size() == rows.size());
    CHECK(table.rows[0][3] == "my_membrane_1");
    CHECK(table.rows[0][4] == "my_membrane_1");
    for (std::size_t i = 0; i < rows.size(); ++i) {
        CHECK(table.number(i, "_rlnCoordinateY") == rows[i].position[1] / 4);
    }
    const std::string pixels = star_of(rows, {}, std::nullopt, "");
    CHECK_FALSE(contains(pixels, "rlnImagePixelSize"));
    CHECK(StarTable(pixels).number(2, "_rlnCoordinateZ") == rows[2].position[2]);
    CHECK(StarTable(pixels).rows[0][3] == "mesh");
    const std::string bare = star_of(rows, {}, std::nullopt, "a/TS_01.vtp", false);
    CHECK(bare.starts_with("\ndata_optics"));
    CHECK(StarTable(bare).rows[0][4] == "TS_01");

    const TemporaryFolder folder;
    AtomicFile file(folder / "b.star");
    write_box_samples(file, sample_target(folder / "b.star"), {}, rows, 2);
    file.commit();
    CHECK_FALSE(contains(bytes_of(folder / "b.star"), "rlnAngle"));
    check_fails(ExitCode::usage, "a .star file holds three coordinates",
                [] { check_dimension(sample_target("a.star"), 4); });
}
