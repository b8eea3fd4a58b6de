// VTK's XML files.
#include "array_facts.hpp"
#include "files/base64.hpp"
#include "files/byte_order.hpp"
#include "files/output/output_file.hpp"
#include "files/samples/sample_file.hpp"
#include "mesh_bytes.hpp"
#include "png_bytes.hpp"
#include "test_files.hpp"

#include <algorithm>
#include <string>
#include <type_traits>
#include <vector>

using namespace geodisk::tools;

namespace {

using VtpCorners = std::vector<std::uint32_t>;

template <class Number>
std::string raw_bytes(const std::vector<Number>& numbers, bool is_little) {
    std::string bytes;
    for (const Number number : numbers) {
        char raw[sizeof number];
        store_little_endian(raw, number);
        if (!is_little) {
            std::reverse(raw, raw + sizeof raw);
        }
        bytes.append(raw, sizeof raw);
    }
    return bytes;
}

std::string in_base64(std::string_view bytes) {
    std::string text;
    append_base64(text, bytes);
    return text;
}

/// How a file holds its arrays.
struct VtpKind {
    std::string format = "ascii"; ///< "binary", "appended" or "base64": appended in base64.
    bool has_long_heads = false, is_little = true, is_packed = false;
};

/// Writes a file with a square as two triangles of a strip, and one triangle.
class VtpText {
  public:
    explicit VtpText(const VtpKind& kind) : kind_(kind) {}

    std::string file() {
        const std::string points = array<float>("Points", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}),
                          faces = array<std::int64_t>("connectivity", 1, {0, 1, 2}) +
                                  array<std::int64_t>("offsets", 1, {3}),
                          strips = array<std::int32_t>("connectivity", 1, {0, 1, 2, 3}) +
                                   array<std::int32_t>("offsets", 1, {4}),
                          heat = array<double>("heat", 1, {1, 2, 3, 4}) +
                                 array<std::uint8_t>("RGB", 3,
                                                     {255, 0, 0, 0, 0, 0, 0, 0, 51, 9, 9, 9}),
                          cells = array<std::int16_t>("cell", 1, {-5, -6});
        std::string text =
            std::string("<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" byte_order=\"") +
            (kind_.is_little ? "LittleEndian" : "BigEndian") + "\" header_type=\"" +
            (kind_.has_long_heads ? "UInt64" : "UInt32") + "\"" +
            (kind_.is_packed ? " compressor=\"vtkZLibDataCompressor\"" : "") +
            ">\n<PolyData><Piece NumberOfPoints=\"4\" NumberOfStrips=\"1\" NumberOfPolys=\"1\">\n"
            "<Points>" +
            points + "</Points><Polys>" + faces + "</Polys><Strips>" + strips +
            "</Strips><PointData>" + heat + "</PointData><CellData>" + cells +
            "</CellData></Piece></PolyData>\n";
        if (!appended_.empty()) {
            text += "<AppendedData encoding=\"" +
                    std::string(kind_.format == "base64" ? "base64" : "raw") + "\">\n _" +
                    appended_ + "\n</AppendedData>";
        }
        return text + "</VTKFile>\n";
    }

  private:
    template <class Number>
    std::string array(const std::string& name, std::size_t components,
                      const std::vector<Number>& numbers) {
        const bool is_float = std::is_floating_point_v<Number>;
        const std::string type = (is_float                   ? "Float"
                                  : std::is_signed_v<Number> ? "Int"
                                                             : "UInt") +
                                 std::to_string(8 * sizeof(Number));
        std::string text = "<DataArray type=\"" + type + "\" Name=\"" + name +
                           "\" NumberOfComponents=\"" + std::to_string(components) + "\" format=\"";
        if (kind_.format == "ascii") {
            text += "ascii\">\n";
            for (const Number number : numbers) {
                text += ' ' + std::to_string(number);
            }
            return text + "\n</DataArray>\n";
        }
        const std::string bytes = coded(raw_bytes(numbers, kind_.is_little));
        if (kind_.format == "binary") {
            return text + "binary\">\n  " + bytes + "\n</DataArray>\n";
        }
        const std::size_t offset = appended_.size();
        appended_ += bytes;
        return text + "appended\" offset=\"" + std::to_string(offset) + "\"/>\n";
    }

    std::string head(const std::vector<std::uint64_t>& counts) const {
        return kind_.has_long_heads
                   ? raw_bytes(counts, kind_.is_little)
                   : raw_bytes(std::vector<std::uint32_t>(counts.begin(), counts.end()),
                               kind_.is_little);
    }

    /// Returns an array with its head, packed in blocks of 16 bytes where it is.
    std::string coded(const std::string& bytes) const {
        constexpr std::size_t kBlock = 16;
        std::string counts = head({bytes.size()}), data = bytes;
        if (kind_.is_packed) {
            std::vector<std::uint64_t> numbers{(bytes.size() + kBlock - 1) / kBlock, kBlock,
                                               bytes.size() % kBlock};
            data.clear();
            for (std::size_t at = 0; at < bytes.size(); at += kBlock) {
                const std::string block = zlib_bytes(bytes.substr(at, kBlock));
                numbers.push_back(block.size());
                data += block;
            }
            counts = head(numbers);
        }
        if (kind_.format == "appended") {
            return counts + data;
        }
        return kind_.is_packed ? in_base64(counts) + in_base64(data) : in_base64(counts + data);
    }

    VtpKind kind_;
    std::string appended_;
};

std::string replaced(std::string text, std::string_view from, std::string_view to) {
    const std::size_t at = text.find(from);
    REQUIRE(at != text.npos);
    return text.replace(at, from.size(), to);
}

} // namespace

TEST_CASE("surfaces of VTK's XML are the same however their arrays are written") {
    for (const char* const format : {"ascii", "binary", "appended", "base64"}) {
        for (const bool has_long_heads : {false, true}) {
            for (const bool is_little : {false, true}) {
                for (const bool is_packed : {false, true}) {
                    CAPTURE(format);
                    CAPTURE(has_long_heads);
                    CAPTURE(is_little);
                    CAPTURE(is_packed);
                    const std::string bytes =
                        VtpText({format, has_long_heads, is_little, is_packed}).file();
                    const MeshFile mesh = mesh_and_fields("a.vtp", bytes, "all");
                    CHECK(mesh.positions ==
                          std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
                    CHECK(mesh.triangles[3] == 0);
                    CHECK(mesh.triangles == VtpCorners{0, 1, 2, 0, 0, 0, 2, 1, 3});
                    CHECK(values_of(mesh, "heat") == std::vector<double>{1, 2, 3, 4});
                    CHECK(values_of(mesh, "cell") == std::vector<double>{-5, -6, -6});
                    CHECK(values_of(mesh, "color")[8] == doctest::Approx(0.2));
                }
            }
        }
    }
}

TEST_CASE("pieces of VTK's XML are put together") {
    const std::string piece =
        "<Piece NumberOfPoints=\"3\" NumberOfVerts=\"1\" NumberOfPolys=\"1\">"
        "<PointData><DataArray type=\"Float32\" Name=\"heat\">1 2 3</DataArray>"
        "</PointData><CellData><DataArray type=\"Int8\" Name=\"c\">8 9</DataArray>"
        "</CellData><Points><DataArray type=\"Float32\">";
    const std::string rest =
        "</DataArray></Points><Polys><DataArray type=\"Int32\" Name=\"offsets\">3"
        "</DataArray><DataArray type=\"Int32\" Name=\"connectivity\">0 1 2"
        "</DataArray></Polys></Piece>";
    const std::string text = "<VTKFile type=\"PolyData\"><PolyData>" + piece + "0 0 0 1 0 0 0 1 0" +
                             rest + piece + "5 0 0 6 0 0 5 1 0" + rest + "</PolyData></VTKFile>";
    const MeshFile mesh = mesh_and_fields("a.vtp", text, "all");
    CHECK(mesh.triangles == VtpCorners{0, 1, 2, 3, 4, 5});
    CHECK(values_of(mesh, "heat") == std::vector<double>{1, 2, 3, 1, 2, 3});
    CHECK(values_of(mesh, "c") == std::vector<double>{9, 9});
    const MeshFile other =
        mesh_and_fields("a.vtp", replaced(text, "Name=\"heat\"", "Name=\"cold\""), "all");
    CHECK(other.fields.size() == 1); // The others are of one piece alone.
    CHECK(other.warnings.size() == 2);
}

TEST_CASE("faults of VTK's XML are told with their line") {
    const std::string text = VtpText({}).file(), raw = VtpText({"appended"}).file(),
                      packed = VtpText({"appended", false, true, true}).file();
    const auto check = [](const std::string& bytes, std::string_view part) {
        geodisk::tools::check_refused("a.vtp", bytes, part);
    };
    const auto check_changed = [&](std::string_view from, std::string_view to,
                                   std::string_view part) {
        check(replaced(text, from, to), part);
    };
    check("", "a.vtp: is empty");
    check("ply\n", "is a PLY file, so its name should end in .ply");
    check("hello", "is no XML file");
    check(text.substr(0, text.size() / 2), "is no whole XML");
    check("<?xml version=\"1.0\"?>\n<a>", "line 2: is no whole XML");
    check("<a/>", "line 1: <a> is not the VTKFile");
    check("<?xml version=\"1.0\"?><!DOCTYPE a [<!ENTITY b \"c\">]><a>&b;&b;</a>",
          "is not the VTKFile");
    check_changed("\"PolyData\"", "\"ImageData\"", "line 2: <VTKFile> is of type 'ImageData'");
    check_changed("\"LittleEndian\"", "\"PDP\"", "unknown byte_order 'PDP'");
    check_changed("\"UInt32\"", "\"UInt128\"", "unknown header_type 'UInt128'");
    check_changed(">\n<PolyData>", " compressor=\"vtkLZ4DataCompressor\"><PolyData>",
                  "is compressed by 'vtkLZ4DataCompressor'");
    check_changed("NumberOfPoints=\"4\"", "NumberOfPoints=\"x\"",
                  "line 3: <Piece> has NumberOfPoints=");
    check_changed("NumberOfPoints=\"4\"", "NumberOfPoints=\"99999999999\"",
                  "more than can be numbered");
    check_changed("NumberOfPoints=\"4\"", "NumberOfPoints=\"4000000000\"",
                  "line 4: <DataArray> 'Points' has 12 numbers, not 12,000,000,000");
    check_changed("NumberOfPolys=\"1\"", "NumberOfPolys=\"2\"", "'offsets' has 1 number, not 2");
    check_changed("0 1 2\n", "0 1 9\n", "cell 0: vertex index 9 is out of range");
    check_changed("0 1 2\n", "0 1\n", "'connectivity' has 2 numbers, not 3");
    check_changed("Name=\"connectivity\"", "Name=\"corners\"", "no array 'connectivity' of Polys");
    check_changed("0.000000", "zero", "has 'zero', which is not a number");
    check_changed("Float32", "Float16", "has the type 'Float16', which is none of numbers");
    check_changed("format=\"ascii\"", "format=\"hex\"", "unknown format 'hex'");
    check_changed("format=\"ascii\"", "format=\"binary\"", "is no base64");
    check_changed("format=\"ascii\"", "format=\"appended\"", "has no offset");
    check(replaced(raw, "offset=\"0\"", "offset=\"99999\""), "begins at byte 99,999 of");
    check(replaced(raw, "offset=\"0\"", "offset=\"5\""), "bytes, not 48");
    check(replaced(raw, "encoding=\"raw\"", "encoding=\"hex\""), "unknown encoding 'hex'");
    check(raw.substr(0, raw.find("\n _") + 20), "'Points' ends after 17 of 52 bytes");
    check(replaced(packed, std::string("_\x03\0\0\0\x10", 6), std::string("_\x03\0\0\0\x11", 6)),
          "has blocks of 17 and 17 bytes, which do not make 48");
    check(replaced(packed, std::string("_\x03\0\0\0", 5), std::string("_\x03\0\0\x7f", 5)),
          "cannot have 2,130,706,435 blocks");
    check(replaced(packed, "\x78\x01\x01", "\x78\x01\x07"), "'Points' is damaged in block 0");
    const auto shared = [](const std::string& offset) {
        const std::string array =
            "<DataArray type=\"Int8\" format=\"appended\" offset=\"" + offset + "\" Name=\"";
        std::string bytes =
            "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"3\" "
            "NumberOfPolys=\"1\"><Points><DataArray type=\"Float32\">0 0 0 1 0 0 0 1 0"
            "</DataArray></Points><Polys><DataArray type=\"Int8\" Name=\"offsets\">3"
            "</DataArray><DataArray type=\"Int8\" Name=\"connectivity\">0 1 2"
            "</DataArray></Polys><PointData>";
        bytes +=
            array + "a\"/><DataArray type=\"Int8\" format=\"appended\" offset=\"0\" Name=\"b\"/>";
        const std::string one = std::string("\3\0\0\0", 4) + "abc";
        return bytes + "</PointData></Piece></PolyData><AppendedData>_" + one + one;
    };
    CHECK(mesh_and_fields("a.vtp", shared("7"), "a,b").fields.size() == 2);
    check_fails(ExitCode::bad_input, "'b' shares bytes with other arrays", [&] {
        mesh_and_fields("a.vtp", shared("0").substr(0, shared("0").size() - 3), "a,b");
    });
    const std::string odd = replaced(text, "1.000000 2.0", "1.000000 x 2.0");
    check_fails(ExitCode::bad_input, "'heat' has 'x', which is not",
                [&] { mesh_and_fields("a.vtp", odd, "heat"); });
    CHECK(mesh_and_fields("a.vtp", odd, "all").fields.size() == 2);
    CHECK(mesh_of("a.vtp", odd).triangle_count() == 3);
}

TEST_CASE("samples are points of VTK with a cell each") {
    const TemporaryFolder folder;
    std::vector<SampleRow> rows(2);
    rows[0] = {{0, 0.5, 1}, {0, 0, 1}, 3, {0.5, 0.25, 0.25}, 0, {}};
    rows[1] = {{1, 2, 3}, {0, 1, 0}, 4, {1, 0, 0}, 0, {}};
    const std::vector<ExtraColumn> numbers{{"class", {0, 1}}};
    const std::vector<SampleField> fields{
        {"color", {"red", "green", "blue"}, false, true, {1, 0, 0.2, 0, 1, 0}},
        {"label", {"label"}, true, false, {-7, 8}}};
    const SampleHeader header{{{"seed", "7"}, {"key", "a"}, {"key", "b<"}}};
    const auto written = [&](bool is_text) {
        const Path path = folder / "a.vtp";
        AtomicFile file(path);
        write_samples(file, sample_target(path, {}, is_text), header, rows, 3, {numbers, fields});
        file.commit();
        return bytes_of(path);
    };
    const std::string text = written(true);
    const auto array = [&](const std::string& type, const std::string& name,
                           const std::string& components, const std::string& values) {
        CHECK(contains(text, "<DataArray type=\"" + type + "\" Name=\"" + name +
                                 "\" NumberOfComponents=\"" + components +
                                 "\" format=\"ascii\">\n" + values + "</DataArray>\n"));
    };
    CHECK(contains(text, "<Array type=\"String\" Name=\"seed\" NumberOfTuples=\"1\" "
                         "format=\"ascii\">\n55 0\n</Array>\n"));
    CHECK(contains(text, "Name=\"key\" NumberOfTuples=\"2\" format=\"ascii\">\n97 0\n98 60 0\n"));
    CHECK(contains(text, "<Piece NumberOfPoints=\"2\" NumberOfVerts=\"2\""));
    CHECK(contains(text, "<PointData Normals=\"Normals\">"));
    array("Float32", "Points", "3", "0 0.5 1\n1 2 3\n");
    array("Int64", "connectivity", "1", "0\n1\n");
    array("Int64", "offsets", "1", "1\n2\n");
    array("Float32", "Normals", "3", "0 0 1\n0 1 0\n");
    array("UInt32", "face_index", "1", "3\n4\n");
    array("Float32", "barycentric", "3", "0.5 0.25 0.25\n1 0 0\n");
    array("UInt32", "class", "1", "0\n1\n");
    array("UInt8", "color", "3", "255 0 51\n0 255 0\n");
    array("Int32", "label", "1", "-7\n8\n");

    const std::string bytes = written(false);
    const std::string first = raw_bytes(std::vector<std::uint64_t>{24}, true) +
                              raw_bytes(std::vector<float>{0, 0.5, 1, 1, 2, 3}, true) +
                              raw_bytes(std::vector<std::uint64_t>{16}, true);
    CHECK(contains(bytes, "Name=\"connectivity\" NumberOfComponents=\"1\" format=\"appended\" "
                          "offset=\"32\"/>"));
    CHECK(contains(bytes, "<AppendedData encoding=\"raw\">\n_" + first));
    geodisk::tools::check_refused("a.vtp", bytes, "holds samples, but a mesh is expected");
    for (const bool is_text : {false, true}) {
        written(is_text);
        const SampleFile read = read_samples(folder / "a.vtp");
        CHECK(read.rows.size() == 2);
        CHECK(read.dimension == 3);
        CHECK(read.rows[1].position[2] == 3);
        CHECK(read.rows[1].normal[1] == 1);
        CHECK(read.rows[0].face == 3);
        CHECK(read.rows[0].bary[2] == 0.25f);
        CHECK(read.header.entries == header.entries);
        CHECK(read.extra_values("class")[1] == 1);
        CHECK(read_samples(folder / "a.vtp", "label").numbers == std::vector<double>{-7, 8});
    }
    rows[0].position[3] = 9;
    write_samples(folder / "four.vtp", header, rows, false, 4);
    CHECK(read_samples(folder / "four.vtp").dimension == 4);
    CHECK(read_samples(folder / "four.vtp").rows[0].position[3] == 9);
    const auto fails = [&](const std::string& content, std::string_view part) {
        check_fails(ExitCode::bad_input, part,
                    [&] { read_samples(folder.write("bad.vtp", content)); });
    };
    fails(VtpText({}).file(), "has faces, so this is a mesh and no file of samples");
    fails(replaced(text, "\"Int32\" Name=\"label\"", "\"Int32\" Name=\"radius\""),
          "point 0: radius is out of range");
    fails(replaced(text, "face_index", "face"), "face_index");
    fails(replaced(text, "NumberOfPoints=\"2\"", "NumberOfPoints=\"3\""), "has 6 numbers, not 9");
    fails(replaced(text, "\n55 0", "\n555 0"), "has '555', which is no character");
    fails(bytes.substr(0, bytes.size() - 60), "ends after");
    check_fails(ExitCode::usage, "a .vtp file holds coordinates, and these samples have none",
                [&] { write_samples(folder / "b.vtp", {}, rows, false, 0); });
}
