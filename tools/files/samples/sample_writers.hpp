// The writers of single formats, for write_samples(), and what they share.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "files/samples/sample_layout.hpp"

namespace geodisk::tools {

/// Appends the line of a row; `index` is its place in the further columns.
void append_text_row(std::string& text, const SampleRow& row, std::size_t index,
                     const SampleLayout& layout, char separator);

/// Appends the record of a row, its columns side by side, little-endian.
void append_binary_row(std::string& bytes, const SampleRow& row, std::size_t index,
                       const SampleLayout& layout);

/// Throws UserError(usage) for two columns that a format calls the same.
[[noreturn]] void fail_same_name(const SampleTarget& target, const std::string& name);

/// Writes PLY, CSV or XYZ.
void write_by_row(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
                  const SampleTarget& target, const SampleLayout& layout);

void write_obj(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
               const SampleTarget& target, const SampleLayout& layout);

/// Throws UserError(usage), like write_gltf(), for coordinates that a float does not hold.
void write_pcd(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
               const SampleTarget& target, const SampleLayout& layout);

/// Throws UserError(usage) for coordinates that a float does not hold.
void write_usd(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
               const SampleTarget& target, const SampleLayout& layout);

class ZipWriter;
/// Adds an attribute to an archive of numpy.
void add_field(ZipWriter& zip, const SampleField& field);

void write_npz(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
               const SampleTarget& target, const SampleLayout& layout);

/// Begins the comment of a file that write_vtp() writes.
inline constexpr std::string_view kVtpSamples = "samples of geodisk";

/// Writes points of VTK's XML, each with a cell, binary behind the XML or as text.
void write_vtp(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
               const SampleTarget& target, const SampleLayout& layout);

/// Writes particles of RELION: coordinates in pixels, and the angles that turn z to the normal, or
/// those of the frames.
void write_star(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
                const SampleTarget& target, const SampleLayout& layout);

/// Throws UserError(usage) for whole numbers that a float does not hold. Has -1 for kNoPart.
void write_gltf(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
                const SampleTarget& target, const SampleLayout& layout);

} // namespace geodisk::tools
