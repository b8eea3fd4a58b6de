// The writers of single formats, for write_samples(), and what they share.
#pragma once

#include <span>

#include "files/sample_layout.hpp"

namespace geodisk::tools {

/// Writes a line for each row.
void write_text_rows(AtomicFile& file, std::span<const SampleRow> rows, const SampleLayout& layout,
                     char separator);

/// Writes a record for each row, its columns side by side, little-endian.
void write_binary_rows(AtomicFile& file, std::span<const SampleRow> rows,
                       const SampleLayout& layout);

void write_obj(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
               const SampleLayout& layout);

/// Throws UserError(usage), like write_gltf(), for coordinates that a float does not hold.
void write_pcd(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
               const SampleTarget& target, const SampleLayout& layout);

/// Throws UserError(usage) for coordinates that a float does not hold.
void write_usd(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
               const SampleTarget& target, const SampleLayout& layout);

void write_npz(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
               const SampleLayout& layout);

/// Throws UserError(usage) for faces whose numbers a float does not hold.
void write_gltf(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
                const SampleTarget& target, const SampleLayout& layout);

} // namespace geodisk::tools
