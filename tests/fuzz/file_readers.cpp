// Files that users give: meshes, samples, points and lines, materials, images, values and tuning.
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <geodisk/mesh.hpp>

#include "files/archives/npz_arrays.hpp"
#include "files/base64.hpp"
#include "files/byte_order.hpp"
#include "files/images/image.hpp"
#include "files/meshes/line_file.hpp"
#include "files/meshes/mesh_file.hpp"
#include "files/meshes/named_files.hpp"
#include "files/meshes/sidecar_files.hpp"
#include "files/output/output_file.hpp"
#include "files/samples/sample_fields.hpp"
#include "files/samples/sample_file.hpp"
#include "files/tuning_file.hpp"
#include "fuzz/reader.hpp"
#include "program/failure.hpp"
#include "support/data_file.hpp"
#include "unit/gltf_parts.hpp"
#include "unit/jpeg_bytes.hpp"
#include "unit/png_bytes.hpp"
#include "unit/test_files.hpp"

namespace geodisk::test {
namespace {

using namespace geodisk::tools;

/// Returns the files of tests/data with an extension.
std::vector<std::string> data_files(const std::string& extension) {
    std::vector<std::string> files;
    for (const char* const folder : {"bad", "cases"}) {
        for (const auto& file : std::filesystem::directory_iterator(*data_file(folder))) {
            if (file.path().extension() == "." + extension) {
                files.push_back(bytes_of(file.path()));
            }
        }
    }
    return files;
}

/// All attributes must be there for all triangles, or be refused.
void read_attributes(const Path& path) {
    MeshSources sources;
    sources.mesh = path.string();
    sources.fields.all = sources.fields.normals = sources.fields.materials = true;
    try {
        const MeshFile mesh = read_mesh(sources);
        std::vector<SampleRow> rows;
        for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
            if (mesh.takes_part(t)) {
                rows.emplace_back().face = t;
                rows.back().bary[t % 3] = 1;
            }
        }
        sample_fields(mesh, rows);
        if (mesh.normals) {
            file_normal(mesh, rows.at(0));
        }
    } catch (const UserError&) {
    }
}

/// Requires that what was read can be prepared, or is refused by that.
void read_as_mesh(const FuzzedFile& file) {
    files_named_in(file.path);
    read_attributes(file.path);
    const MeshFile mesh = read_mesh(file.path.string());
    const auto prepared =
        PreparedMesh::prepare({mesh.positions, mesh.triangles, mesh.dimension}, ThreadOptions{1});
    require_in_fuzzer(prepared || !prepared.error().message.empty());
}

/// Returns meshes of VTK, GIFTI and FreeSurfer, text and binary.
std::vector<std::string> array_seeds(const std::string& format) {
    const std::string points = "0 0 0 1 0 0 0 1 0 1 1 0";
    if (format == "vtk") {
        const std::string head = "# vtk DataFile Version ",
                          square = "DATASET POLYDATA\nPOINTS 4 float\n",
                          data = "POINT_DATA 4\nSCALARS a unsigned_char 3\nLOOKUP_TABLE d\n"
                                 "1 2 3 4 5 6 7 8 9 1 2 3\nTEXTURE_COORDINATES t 2 float\n"
                                 "0 0 0 1 1 0 1 1\nCELL_DATA 2\nFIELD f 2\nb 1 2 int\n7 8\n"
                                 "s 1 1 string\ntext\nNORMALS n float\n0 0 1 0 0 1\n";
        return {head + "3.0\nt\nASCII\n" + square + points +
                    "\nPOLYGONS 1 4\n3 0 1 2\nTRIANGLE_STRIPS 1 5\n4 0 1 2 3\n" + data,
                head + "5.1\nt\nASCII\n" + square + points +
                    "\nMETADATA\nINFORMATION 0\n\nPOLYGONS 3 6\nOFFSETS vtktypeint64\n0 3 6\n"
                    "CONNECTIVITY vtktypeint64\n0 1 2 2 1 3\n" +
                    data,
                head + "3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n" + points +
                    "\nCELLS 2 9\n3 0 1 2\n4 0 1 2 3\nCELL_TYPES 2\n5 8\n" + data,
                head + "2.0\nt\nBINARY\n" + square + std::string(48, '\x3e') + "\nPOLYGONS 1 4\n" +
                    std::string("\0\0\0\3\0\0\0\0\0\0\0\1\0\0\0\2", 16) +
                    "\nPOINT_DATA 4\nFIELD f 2\nb 1 4 bit\n\x70\ns 1 1 string\n\xc1t\n"};
    }
    if (format == "freesurfer") {
        std::string bytes = "\xff\xff\xfe"
                            "t\n\n";
        bytes += std::string("\0\0\0\3\0\0\0\1", 8) + std::string(36, '\x3e') +
                 std::string("\0\0\0\0\0\0\0\1\0\0\0\2", 12);
        return {bytes, "#!ascii\n4 2\n0 0 0 0\n1 0 0 0\n0 1 0 0\n1 1 0 0\n0 1 2 0\n2 1 3 0\n"};
    }
    const auto in_base64 = [](std::string_view bytes) {
        std::string text;
        append_base64(text, bytes);
        return text;
    };
    std::string corners, head;
    for (const std::uint32_t corner : {0u, 1u, 2u, 2u, 1u, 3u}) {
        append_little_endian(corners, corner);
    }
    const std::string packed = zlib_bytes(corners);
    if (format == "gii") {
        const auto array = [](const std::string& intent, const std::string& type,
                              const std::string& size, const std::string& encoding,
                              const std::string& data) {
            return "<DataArray Intent=\"NIFTI_INTENT_" + intent + "\" DataType=\"NIFTI_TYPE_" +
                   type + "\" Dimensionality=\"2\" Dim0=\"" + size + "\" Encoding=\"" + encoding +
                   "\" Endian=\"LittleEndian\"><Data>" + data + "</Data></DataArray>";
        };
        const std::string start = "<GIFTI>" +
                                  array("POINTSET", "FLOAT32", "4\" Dim1=\"3", "ASCII", points) +
                                  array("SHAPE", "FLOAT32", "4\" Dim1=\"1", "ASCII", "1 2 3 4");
        std::vector<std::string> seeds;
        for (const auto& [encoding, data] :
             {std::pair<std::string, std::string>{"ASCII", "0 1 2 2 1 3"},
              {"Base64Binary", in_base64(corners)},
              {"GZipBase64Binary", in_base64(packed)}}) {
            seeds.push_back(start + array("TRIANGLE", "INT32", "2\" Dim1=\"3", encoding, data) +
                            "</GIFTI>");
        }
        return seeds;
    }
    for (const std::size_t count :
         {std::size_t{1}, corners.size(), std::size_t{0}, packed.size()}) {
        append_little_endian(head, static_cast<std::uint32_t>(count));
    }
    const auto vtp = [&](const std::string& more, const std::string& array,
                         const std::string& end) {
        return "<VTKFile type=\"PolyData\"" + more +
               "><PolyData><Piece NumberOfPoints=\"4\" NumberOfPolys=\"2\"><PointData><DataArray "
               "type=\"UInt8\" Name=\"c\" NumberOfComponents=\"3\">1 2 3 4 5 6 7 8 9 1 2 "
               "3</DataArray>"
               "</PointData><CellData><DataArray type=\"Float32\" Name=\"h\">1 "
               "2</DataArray></CellData>"
               "<Points><DataArray type=\"Float32\">" +
               points +
               "</DataArray></Points><Polys><DataArray type=\"Int32\" Name=\"offsets\">3 "
               "6</DataArray>"
               "<DataArray type=\"UInt32\" Name=\"connectivity\" " +
               array + "</Polys></Piece></PolyData>" + end + "</VTKFile>";
    };
    std::string size;
    append_little_endian(size, static_cast<std::uint32_t>(corners.size()));
    const std::string zlib = " compressor=\"vtkZLibDataCompressor\"",
                      raw = "<AppendedData encoding=\"raw\">_";
    return {
        vtp("", ">0 1 2 2 1 3</DataArray>", ""),
        vtp("", "format=\"binary\">" + in_base64(size + corners) + "</DataArray>", ""),
        vtp(zlib, "format=\"binary\">" + in_base64(head) + in_base64(packed) + "</DataArray>", ""),
        vtp("", "format=\"appended\" offset=\"0\"/>", raw + size + corners + "</AppendedData>"),
        vtp(zlib, "format=\"appended\" offset=\"0\"/>", raw + head + packed + "</AppendedData>")};
}

std::vector<std::string> mesh_seeds(const std::string& format) {
    std::vector<std::string> seeds = data_files(format);
    if (format == "glb") {
        seeds.push_back(binary_of({}));
    } else if (format == "stl") {
        seeds.emplace_back("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                           "vertex 0 1 0\nendloop\nendfacet\nendsolid a\n");
    } else if (format == "off") {
        seeds.emplace_back("COFF\n4 1 0\n0 0 0 255 0 0 255\n1 0 0 0 255 0 255\n1 1 0 9 9 9 9\n"
                           "0 1 0 0 0 0 0\n4 0 1 2 3\n");
    } else if (format == "usda") {
        seeds.emplace_back(
            "#usda 1.0\n(\n    metersPerUnit = 0.01\n    upAxis = \"Y\"\n)\ndef Xform \"W\" (kind "
            "= "
            "\"group\")\n{\n    double3 xformOp:translate.timeSamples = { 1: (1, 2, 3), 2: (4, 5, "
            "6) "
            "}\n    float3 xformOp:rotateXYZ:a = (90, 0, 30)\n    matrix4d xformOp:transform = ( "
            "(1, "
            "0, 0, 0), (0, 2, 0, 0), (0, 0, -1, 0), (5, 6, 7, 1) )\n    uniform token[] "
            "xformOpOrder = [\"xformOp:translate\", \"!invert!xformOp:rotateXYZ:a\", "
            "\"xformOp:transform\"]\n    rel material:binding = </M/red>\n    def Mesh \"m\"\n    "
            "{\n"
            "        uniform token orientation = \"leftHanded\"\n        int[] faceVertexCounts = "
            "[4, "
            "3]\n        int[] faceVertexIndices = [0, 1, 2, 3, 0, 2, 4]\n        point3f[] points "
            "= "
            "[(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1)]\n        normal3f[] normals = "
            "[(0, "
            "0, 1)] (interpolation = \"constant\")\n        color3f[] primvars:displayColor = [(1, "
            "0, "
            "0), (0, 1, 0)] (interpolation = \"uniform\")\n        texCoord2f[] primvars:st = [(0, "
            "0), "
            "(1, 1)] (interpolation = \"faceVarying\")\n        int[] primvars:st:indices = [0, 1, "
            "0, "
            "1, 0, 1, 0]\n        int[] holeIndices = [1]\n        def GeomSubset \"s\" {\n        "
            "    "
            "uniform token elementType = \"face\"\n            int[] indices = [1]\n            "
            "rel "
            "material:binding = </M/blue>\n        }\n    }\n}\n");
    } else if (format == "vtk" || format == "vtp" || format == "gii" || format == "freesurfer") {
        return array_seeds(format);
    }
    return seeds;
}

void read_as_samples(const FuzzedFile& file) {
    try {
        const SampleFile samples = read_points_and_lines(file.path);
        for (const auto& [a, b] : samples.segments) {
            require_in_fuzzer(a < samples.rows.size() && b < samples.rows.size());
        }
    } catch (const UserError&) {
        read_box_samples(file.path);
    }
}

/// Returns samples as geodisk writes them: with all columns, of four dimensions, and in a box.
std::vector<std::string> written_samples(const std::string& format) {
    const TemporaryFolder folder;
    const Path path = folder / ("written." + format);
    const SampleHeader header{{{"version", "1"}, {"min_distance", "0.5"}, {"seed", "7"}}};
    std::vector<SampleRow> rows(3);
    for (std::uint32_t i = 0; i < rows.size(); ++i) {
        rows[i] = {{0.25 * i, 1, 1e6}, {0, 0, 1}, i, {0.5, 0.25, 0.25}, 0.25 + i, i};
    }
    const std::vector<ExtraColumn> numbers{{"class", {0, 1, 0}}};
    const std::vector<SampleField> fields{{"heat", {"heat"}, false, false, {0.5, 1, 2}}};
    std::vector<std::string> seeds;
    for (const bool is_text : {false, true}) {
        const SampleTarget target = sample_target(path, {}, is_text);
        const auto add = [&](const auto& write) {
            AtomicFile file(path);
            write(file, target);
            file.commit();
            seeds.push_back(bytes_of(path));
        };
        add([&](AtomicFile& file, const SampleTarget& to) {
            write_samples(file, to, header, rows, 3, {numbers, fields});
        });
        add([&](AtomicFile& file, const SampleTarget& to) {
            write_samples(file, to, header, rows, 4);
        });
        add([&](AtomicFile& file, const SampleTarget& to) {
            write_box_samples(file, to, {{{"box", "1 x 2"}, {"sides", "open"}}}, rows, 2);
        });
        if (format != "ply" && format != "pcd") { // Only these have two kinds.
            break;
        }
    }
    return seeds;
}

std::vector<std::string> sample_seeds(const std::string& format) {
    if (format == "npy") {
        std::string points = array_header("<f8", "(2, 3)"), floats = array_header(">f4", "(2, 2)");
        for (int i = 0; i < 6; ++i) {
            append_little_endian(points, i / 4.0);
        }
        return {points, floats + std::string(16, '\0')};
    }
    if (format == "obj") {
        return {"v 0 0 0\nvn 0 0 1\nv 1 0 0\nv 0 1 0\np 1 2\nl 1 2 3\n"};
    }
    if (format == "xyz") {
        return {"2\nC 1 2 3\nN 4 5.5 -6\n", "2\nelement x y z\n6 1 2 3\n7 4 5.5 -6\n",
                "1 2 3\n4 5.5 -6\n", "name\tx\ty\tz\nwell old\t1\t2\t3\n\t4\t5.5\t-6\n",
                "note;x;y;z\n\"of two\nlines\";1;2;3,5\n"};
    }
    if (format == "off") {
        return {"OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n2 1 2\n"};
    }
    if (format == "gltf") {
        Parts lines, points;
        lines.primitives = R"([{"attributes": {"POSITION": 0}, "indices": 1, "mode": 1}])";
        points.primitives = R"([{"attributes": {"POSITION": 0}, "mode": 0}])";
        for (Parts* const parts : {&lines, &points}) { // 48 bytes of vertices and 12 of indices.
            parts->buffer = R"("uri": "data:application/octet-stream;base64,)" +
                            std::string(80, 'A') + R"(", "byteLength": 60)";
        }
        return {text_of(lines), text_of(points)};
    }
    std::vector<std::string> seeds = written_samples(format);
    if (format == "npz") {
        seeds.push_back(bytes_of(*data_file("cases/points_compressed.npz")));
    } else if (format == "csv") {
        seeds.emplace_back("x y z line\n0 0 0 1\n1 0 0 1\n0 1 0 2\n");
    } else if (format == "ply") {
        seeds.emplace_back("ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty "
                           "float y\nproperty float z\nelement edge 1\nproperty int vertex1\n"
                           "property int vertex2\nend_header\n0 0 0\n1 0 0\n0 1\n");
    }
    return seeds;
}

void read_as_side_files(const FuzzedFile& file) {
    try {
        read_coordinates(file.path);
    } catch (const UserError&) {
    }
    try {
        EdgeLengths lengths(file.path, 1);
        lengths.between(0, 1);
    } catch (const UserError&) {
    }
    read_values(file.path, 100);
}

std::vector<std::string> side_seeds(const std::string&) {
    return {"0 0 0 0.5\n1 0 0 1 # a comment\n", "1 2 0.5\n2 3 1e-3\n", "0.5\n\n1\n",
            std::string("\xff\xff\xff\0\0\0\1\0\0\0\1\0\0\0\1\x3f\0\0\0", 19)};
}

/// All vertices must have a value, or the file is refused.
void read_as_values(const FuzzedFile& file) {
    constexpr std::size_t kVertices = 100;
    const VertexValues values = read_values(file.path, kVertices);
    if (file.path.extension() == ".label") {
        require_in_fuzzer(values.values.size() == kVertices);
    }
    require_in_fuzzer(values.values.size() <= file.bytes.size() + kVertices);
}

/// Returns annotations with tables of either form, and a list of vertices.
std::vector<std::string> value_seeds(const std::string& format) {
    if (format == "label") {
        return {"#!ascii label  , from subject a vox2ras=TkReg\n2\n0  1.5 2 -3 0.25\n3  1 2 3 0\n"};
    }
    const auto words = [](std::initializer_list<int> numbers) {
        std::string bytes;
        for (const int number : numbers) {
            bytes += big_endian(static_cast<std::uint32_t>(number));
        }
        return bytes;
    };
    const std::string vertices = words({3, 0, 0x030201, 1, 0, 2, 0x060504, 1});
    return {vertices + words({2, 1}) + '\0' + words({2}) + "a\0" + words({1, 2, 3, 0, 1}) + 'b' +
                words({4, 5, 6, 0}),
            vertices + words({-2, 9, 2}) + "t\0" + words({2, 0, 2}) + "a\0" +
                words({1, 2, 3, 0, 8, 1}) + 'b' + words({4, 5, 6, 0})};
}

void read_as_image(const FuzzedFile& file) {
    const ColourImage colours(file.path);
    colours.at(0.3, 0.7);
    const GreyImage image(file.path);
    for (const double at : {0.0, 0.3, 0.999999, -7.2}) {
        const double value = image.at(at, 1 - at);
        require_in_fuzzer(value >= 0 && value <= 1);
    }
}

std::vector<std::string> image_seeds(const std::string&) {
    return {png_bytes(2, 2, std::string("\x00\x40\x80\xff", 4)),
            png_bytes(2, 1, std::string("\x00\x40\x80\xff", 4), 16),
            png_bytes(1, 2, std::string("\x00\x40\x80\xff\x01\x02", 6), 8, 2), jpeg_bytes()};
}

/// Reads the materials of an OBJ file beside it, with an image of one pixel.
void read_as_mtl(const FuzzedFile& file) {
    const Path folder = file.path.parent_path();
    const Path mesh = folder / Path("materials.obj");
    if (static bool is_made = false; !is_made) {
        std::ofstream(mesh) << "mtllib " << file.path.filename().string()
                            << "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
                               "usemtl a\nf 1/1 2/2 3/3\nusemtl b c\nf 3/3 2/2 1/1\n";
        std::ofstream(folder / Path("i.png"), std::ios::binary) << png_bytes(1, 1, "\x40");
        is_made = true;
    }
    files_named_in(mesh);
    MeshSources sources;
    sources.mesh = mesh.string();
    sources.fields.uvs = sources.fields.materials = true;
    read_mesh(sources);
}

std::vector<std::string> mtl_seeds(const std::string&) {
    return {"newmtl a\nKd 1 0.5 0\nmap_Kd -s 2 2 2 -o 0.5 0 0 -clamp on i.png\n"
            "newmtl b c\nKd 0.5\nmap_Kd -blendu on -mm 0 1 -cc on \\\n i.png\n",
            "# by hand\r\nnewmtl a\r\nKa 0 0 0\r\nd 1\r\nillum 2\r\nmap_Kd i.png\r\n"};
}

/// A device that takes any tuning.
DeviceReport tuned_device() {
    DeviceReport device;
    device.limits.max_workgroup_invocations = device.limits.max_workgroup_size_x = 1024;
    return device;
}

void read_as_tuning(const FuzzedFile& file) {
    static const DeviceReport device = [&] {
        setenv("XDG_CACHE_HOME", file.path.parent_path().c_str(), 1);
        DeviceReport tuned = tuned_device();
        const std::filesystem::path path = tuning_path(tuned);
        std::filesystem::create_directories(path.parent_path());
        std::filesystem::create_symlink(file.path, path);
        return tuned;
    }();
    const auto tuning = load_tuning(device);
    require_in_fuzzer(tuning && chosen_tuning(*tuning, device));
}

std::vector<std::string> tuning_seeds(const std::string&) {
    const TemporaryFolder folder;
    std::vector<std::string> seeds;
    for (const Reads reads : {Reads::automatic, Reads::storage, Reads::texels}) {
        Tuning tuning;
        tuning.local_size = tuning.slot_local_size = 64;
        tuning.pool_block = 1;
        tuning.batches = 24;
        tuning.reads = reads;
        store_tuning(folder / "tuning.json", tuned_device(), tuning);
        seeds.push_back(bytes_of(folder / "tuning.json"));
    }
    return seeds;
}

constexpr Reader kFileReaders[] = {
    {"mesh", "", read_as_mesh, mesh_seeds},
    {"samples", "", read_as_samples, sample_seeds},
    {"side_files", "side.txt", read_as_side_files, side_seeds},
    {"values", "", read_as_values, value_seeds},
    {"image", "image", read_as_image, image_seeds},
    {"mtl", "fuzzed.mtl", read_as_mtl, mtl_seeds},
    {"tuning", "tuning.json", read_as_tuning, tuning_seeds},
};

} // namespace

const std::span<const Reader> kReaders = kFileReaders;

} // namespace geodisk::test
