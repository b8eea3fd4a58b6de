// The writers of single formats, for write_samples().
#pragma once

#include <span>

#include "files/sample_layout.hpp"

namespace geodisk::tools {

void write_obj(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
               const SampleLayout& layout);

/// Throws UserError(usage), like write_gltf(), for coordinates that a float does not hold.
void write_pcd(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
               const SampleTarget& target, const SampleLayout& layout);

void write_npz(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
               const SampleLayout& layout);

/// Throws UserError(usage) for faces whose numbers a float does not hold.
void write_gltf(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
                const SampleTarget& target, const SampleLayout& layout);

} // namespace geodisk::tools
