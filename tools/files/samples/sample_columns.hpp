// The columns of a sample file, for the writer and the reader.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace geodisk::tools {

enum class SampleColumn : std::size_t {
    x,
    y,
    z,
    nx,
    ny,
    nz,
    face_index,
    bary_u,
    bary_v,
    bary_w,
    radius,
    polygon_index
};

/// By SampleColumn.
inline constexpr std::array<std::string_view, 12> kSampleColumnNames{
    "x",          "y",      "z",      "nx",     "ny",     "nz",
    "face_index", "bary_u", "bary_v", "bary_w", "radius", "polygon_index"};

/// The coordinates of samples that have more than three.
inline constexpr std::array<std::string_view, 8> kNumberedColumnNames{"x0", "x1", "x2", "x3",
                                                                      "x4", "x5", "x6", "x7"};

/// The column that marks samples that were given, with 1.
inline constexpr std::string_view kExistingColumn = "existing";

/// The column with the classes of samples.
inline constexpr std::string_view kClassColumn = "class";
/// The column that numbers polylines, of points to avoid.
inline constexpr std::string_view kLineColumn = "line";
/// The column of levels, and the entries of the header with their distances and their ends.
inline constexpr std::string_view kLevelColumn = "level", kLevelDistances = "level_distances",
                                  kLevelSamples = "level_samples";

/// The column of --order farthest: distance of each sample to the nearest before it.
inline constexpr std::string_view kCoverColumn = "cover";
/// The other column of --order farthest: place of each sample in the order before, from 0.
inline constexpr std::string_view kRowColumn = "row";

/// The column that tells samples on corners (2) and curves (1) from those on faces (0).
inline constexpr std::string_view kFeatureColumn = "feature";

/// The column of --at-vertices: the vertex that each sample is at, 4294967295 for none.
inline constexpr std::string_view kVertexColumn = "vertex";

/// The attribute and the columns of --frames: a quaternion that turns z to the normal.
inline constexpr std::string_view kFramesField = "frames";
inline constexpr std::array<std::string_view, 4> kFrameColumnNames{"qx", "qy", "qz", "qw"};

/// Returns the largest number that a column may have.
constexpr std::uint32_t largest_in_column(std::string_view name) {
    return name == kExistingColumn ? 1 : 0xffffffff;
}

/// Returns the key of the header that says what is in a column; "" if there is none.
constexpr std::string_view key_of_column(std::string_view name) {
    return name == kExistingColumn  ? "existing"
           : name == kClassColumn   ? "classes"
           : name == kFeatureColumn ? "features"
           : name == kLevelColumn   ? kLevelDistances
                                    : "";
}

/// Keys of header entries that a reader of samples goes by.
inline constexpr std::string_view kSampleCount = "samples", kOrigin = "origin",
                                  kJobFrame = "job_frame", kSamplingVersion = "sampling_version";

} // namespace geodisk::tools
