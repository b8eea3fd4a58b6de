#include "files/samples/sample_target.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "files/input_file.hpp"
#include "files/output/output_target.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/suggestion.hpp"

namespace geodisk::tools {
namespace {

/// By SampleFormat.
constexpr std::array<std::string_view, 9> kNames{"ply", "csv",  "xyz", "obj", "pcd",
                                                 "npz", "gltf", "glb", "usda"};

std::optional<SampleFormat> find_format(std::string_view name) {
    const auto found = std::find(kNames.begin(), kNames.end(), name);
    return found == kNames.end() ? std::nullopt
                                 : std::optional(SampleFormat(found - kNames.begin()));
}

/// ".ply, .csv and .xyz", or without the dots.
std::string all_names(const std::string& dot) {
    std::string all;
    for (std::size_t i = 0; i < kNames.size(); ++i) {
        all += i == 0 ? "" : i + 1 == kNames.size() ? " and " : ", ";
        all += dot + std::string(kNames[i]);
    }
    return all;
}

SampleFormat format_named(const Path& path, std::string_view name) {
    if (!name.empty()) {
        if (const auto format = find_format(name)) {
            return *format;
        }
        fail_usage("--format: " + in_quotes(name) + " is no sample format; known are " +
                   all_names("") + did_you_mean(name, sample_formats()));
    }
    const std::string extension = lower_extension(path);
    if (const auto format = find_format(extension.empty() ? "" : extension.substr(1))) {
        return *format;
    }
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) {
        fail_to_write(path, "is a folder");
    }
    fail_usage(path.string() + ": unknown sample format; known are " + all_names(".") +
               ", or give --format");
}

} // namespace

SampleTarget sample_target(const Path& path, std::string_view format, bool is_text) {
    return {path, format_named(path, format), is_text, true};
}

std::vector<std::string> sample_formats() {
    return {kNames.begin(), kNames.end()};
}

bool is_sample_format(std::string_view name) {
    return find_format(name).has_value();
}

std::string extension_of(SampleFormat format) {
    return '.' + std::string(kNames[static_cast<std::size_t>(format)]);
}

} // namespace geodisk::tools
