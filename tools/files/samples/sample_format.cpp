#include "files/samples/sample_format.hpp"

#include <algorithm>
#include <array>

#include "files/input_file.hpp"
#include "files/output/output_target.hpp"
#include "files/samples/sample_rows.hpp"
#include "files/samples/sample_writers.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/suggestion.hpp"

namespace geodisk::tools {
namespace {

constexpr auto kPoints = SampleContent::points, kNormals = SampleContent::normals,
               kColumns = SampleContent::columns;
constexpr auto kNoScene = SceneAxes::none;
constexpr auto kSrgb = ColourEncoding::srgb, kBytes = ColourEncoding::bytes,
               kPacked = ColourEncoding::packed, kLight = ColourEncoding::light;

/// By SampleFormat; lists are in this order.
constexpr std::array<FormatFacts, 11> kFormats{{
    // name, content, coordinates, floats, programs, scene, colours, writer, reader
    {"ply", kColumns, 0, 8, false, false, kNoScene, kBytes, write_by_row, read_ply_samples},
    {"csv", kColumns, 0, 8, false, true, kNoScene, kSrgb, write_by_row, read_table_samples},
    {"xyz", kPoints, 3, 3, false, false, kNoScene, kSrgb, write_by_row, read_table_samples},
    {"npz", kColumns, 0, 8, false, true, kNoScene, kSrgb, write_npz, read_numpy_samples},
    {"pcd", kColumns, 1, 8, true, false, kNoScene, kPacked, write_pcd, read_pcd_samples},
    {"obj", kNormals, 3, 3, false, false, kNoScene, kSrgb, write_obj, read_obj_points},
    {"gltf", kColumns, 3, 3, true, false, SceneAxes::y, kLight, write_gltf, nullptr},
    {"glb", kColumns, 3, 3, true, false, SceneAxes::y, kLight, write_gltf, nullptr},
    {"usda", kColumns, 3, 3, true, false, SceneAxes::y_or_z, kLight, write_usd, nullptr},
    {"vtp", kColumns, 1, 8, false, false, kNoScene, kBytes, write_vtp, read_vtp_samples},
    {"star", kColumns, 3, 3, false, false, kNoScene, kSrgb, write_star, nullptr},
}};

} // namespace

const FormatFacts& facts_of(SampleFormat format) {
    return kFormats[static_cast<std::size_t>(format)];
}

std::optional<SampleFormat> find_format(const Path& path, std::string_view name) {
    const std::string wanted = name.empty() ? lower_extension(path) : '.' + std::string(name);
    const auto found = std::ranges::find_if(kFormats, [&](const FormatFacts& format) {
        return wanted == '.' + std::string(format.name);
    });
    return found == kFormats.end() ? std::nullopt
                                   : std::optional(SampleFormat(found - kFormats.begin()));
}

std::string extension_of(SampleFormat format) {
    return '.' + std::string(facts_of(format).name);
}

std::string a_file(SampleFormat format) {
    const bool has_vowel = format == SampleFormat::obj || format == SampleFormat::xyz;
    return (has_vowel ? "an " : "a ") + extension_of(format) + " file";
}

std::vector<std::string> sample_formats(const IsFormat& is, const std::string& before) {
    std::vector<std::string> names;
    for (const FormatFacts& format : kFormats) {
        if (!is || is(format)) {
            names.push_back(before + std::string(format.name));
        }
    }
    return names;
}

std::string listed_formats(const IsFormat& is, const std::string& before, std::string_view last) {
    return listed(sample_formats(is, before), last);
}

SampleTarget sample_target(const Path& path, std::string_view format, bool is_text) {
    if (const auto found = find_format(path, format)) {
        return {path, *found, is_text};
    }
    if (!format.empty()) {
        fail_usage("--format: " + in_quotes(format) + " is no sample format; known are " +
                   listed_formats(nullptr, "", " and ") + did_you_mean(format, sample_formats()));
    }
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) {
        fail_to_write(path, "is a folder");
    }
    fail_usage(path.string() + ": unknown sample format; known are " +
               listed_formats(nullptr, ".", " and ") + ", or give --format");
}

} // namespace geodisk::tools
