#include "files/text_file.hpp"

#include <algorithm>
#include <array>

#include "files/input_file.hpp"
#include "files/text_lines.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

struct Content {
    std::string_view begin;
    std::string_view message;
};

using namespace std::string_view_literals;

constexpr std::array kContents{
    Content{"\x1f\x8b"sv, "is compressed by gzip; decompress it first"},
    Content{"PK\x03\x04"sv,
            "is a zip archive, as .3mf, .usdz and .kmz files are; unpack it first and convert the "
            "mesh in it to PLY, OBJ or STL"},
    Content{"BZh"sv, "is compressed by bzip2; decompress it first"},
    Content{"\xfd"
            "7zXZ\0"sv,
            "is compressed by xz; decompress it first"},
    Content{"\x28\xb5\x2f\xfd"sv, "is compressed by zstd; decompress it first"},
    Content{"7z\xbc\xaf\x27\x1c"sv, "is a 7z archive; unpack it first"},
    Content{"version https://git-lfs.github.com/spec/"sv,
            "is a Git LFS pointer, not the file itself: run git lfs pull"},
    Content{"/annex/objects/"sv, "is a git-annex pointer, not the file itself: run git annex get"},
    Content{"\xff\xfe\0\0"sv, "is UTF-32; save it as UTF-8"},
    Content{"\xff\xfe"sv, "is UTF-16; save it as UTF-8"},
    Content{"\xfe\xff"sv, "is UTF-16; save it as UTF-8"},
    Content{"Kaydara FBX Binary"sv, "is an FBX file; convert it to glTF, OBJ or PLY"},
    Content{"BLENDER"sv, "is a Blender file; export it as glTF, OBJ or PLY"},
    Content{"PXR-USDC"sv, "is a binary USD file; convert it to text (.usda) by usdcat"},
    Content{"#usda"sv, "is a USD file, so its name should end in .usda"},
    Content{"# vtk DataFile"sv,
            "is a VTK file, which is read as a mesh only, if its name ends in .vtk"},
    Content{"%PDF-"sv, "is a PDF document, not a mesh"},
};

/// Returns what a file of XML is; "" for other files.
std::string_view xml_message(std::string_view bytes) {
    const std::string_view head = bytes.substr(0, 2000);
    if (head.find("<VTKFile") != head.npos) {
        return "is a VTK file in XML, so its name should end in .vtp";
    }
    if (head.find("<GIFTI") != head.npos) {
        return "is a GIFTI file, so its name should end in .gii";
    }
    return bytes.starts_with("<?xml")
               ? "is an XML file, as COLLADA, X3D and AMF are; convert it to PLY, OBJ or STL"
               : "";
}

/// Text of ASCII characters in UTF-16 has a zero in every other byte.
bool is_wide_ascii(std::string_view bytes) {
    const std::size_t size = std::min<std::size_t>(bytes.size(), 64) / 2 * 2;
    const auto is_half_zero = [&](std::size_t zero) {
        for (std::size_t i = 0; i < size; i += 2) {
            if (bytes[i + zero] != '\0' || bytes[i + 1 - zero] == '\0') {
                return false;
            }
        }
        return size >= 4;
    };
    return is_half_zero(0) || is_half_zero(1);
}

bool is_web_page(std::string_view text) {
    const std::string begin = lower_case(std::string(text.substr(0, 14)));
    return begin.starts_with("<!doctype html") || begin.starts_with("<html");
}

std::string_view after_blanks(std::string_view text) {
    text.remove_prefix(text_begin(text));
    return text.substr(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
}

} // namespace

std::string read_text(const Path& path) {
    std::string bytes = read_file(path);
    refuse_other_content(path, bytes);
    return bytes;
}

void refuse_other_content(const Path& path, std::string_view bytes) {
    for (const Content& content : kContents) {
        if (bytes.starts_with(content.begin)) {
            fail_input(path, std::string(content.message));
        }
    }
    if (const std::string_view message = xml_message(bytes); !message.empty()) {
        fail_input(path, std::string(message));
    }
    if (is_wide_ascii(bytes)) {
        fail_input(path, "is UTF-16; save it as UTF-8");
    }
    if (is_web_page(after_blanks(bytes))) {
        fail_input(path, "is a web page (HTML), not the file itself; download it again");
    }
}

void refuse_other_mesh(const Path& path, std::string_view bytes, std::string_view extension) {
    const auto refuse_if = [&](bool is_found, std::string_view name, std::string_view its) {
        if (is_found && its != extension) {
            fail_input(path, "is " + std::string(name) + ", so its name should end in " +
                                 std::string(its));
        }
    };
    const std::string_view text = after_blanks(bytes);
    const std::string_view first = text.substr(0, text.find_first_of(" \t\r\n"));
    refuse_if(first == "ply", "a PLY file", ".ply");
    refuse_if(first == "OFF" || first == "COFF" || first == "NOFF", "an OFF file", ".off");
    refuse_if(first == "solid" && text.find("facet") < 1000, "an STL file", ".stl");
    refuse_if(bytes.starts_with("glTF"), "a binary glTF file", ".glb");
    refuse_if(text.starts_with('{') && text.find("\"asset\"") != std::string_view::npos,
              "a glTF file", ".gltf");
}

std::size_t drop_final_nuls(std::string& text) {
    const std::size_t end = text.find_last_not_of('\0') + 1;
    const std::size_t dropped = text.size() - end;
    text.resize(end);
    return dropped;
}

} // namespace geodisk::tools
