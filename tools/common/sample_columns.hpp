// The columns of a sample file, for the writer and the reader.
#pragma once

#include <array>
#include <cstddef>
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
    candidate
};

/// By SampleColumn.
inline constexpr std::array<std::string_view, 11> kSampleColumnNames{
    "x", "y", "z", "nx", "ny", "nz", "face_index", "bary_u", "bary_v", "bary_w", "candidate"};

} // namespace geodisk::tools
