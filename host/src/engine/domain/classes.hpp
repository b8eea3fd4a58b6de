// The classes of a job: SampleParams::class_factors, checked, and as the device takes them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <geodisk/export.hpp>
#include <geodisk/params.hpp>
#include <geodisk/status.hpp>

#include "constants.h"
#include "engine/domain/upload_parts.hpp"

namespace geodisk {

/// The table of classes, as kernels read it.
using ClassWords = std::array<std::uint32_t, gpu::kClassWords>;

/// Returns the number of classes; 1 if samples have none.
GEODISK_API std::uint32_t class_count(const SampleParams& params) noexcept;

/// Returns how many times as many samples fit as with the minimum distance for all: each class has
/// those of its own distance.
double class_density(const SampleParams& params) noexcept;

/// Returns how many candidates conflict with one of the class that has the most, per candidate that
/// conflicts if there are no classes.
double class_crowding(const SampleParams& params) noexcept;

/// Returns the grid cells per unit of length: a cell is at most half as wide as the shortest of the
/// largest distances that the classes have, and more than a quarter.
float class_cells_per_unit(const SampleParams& params) noexcept;

/// Checks the table, the classes of existing samples and of disks to avoid, the shares for a mesh
/// of so many faces, and that nothing contradicts them.
Result<Done> check_classes(const SampleParams& params, std::uint32_t faces);

/// Returns the table, for samples with classes.
ClassWords class_table(const SampleParams& params);

/// Returns the priority of a candidate with its class in the lowest bits, which a random word
/// stands for: class_of_random() and with_class() of the shaders.
std::uint32_t priority_with_class(const ClassWords& table, std::uint32_t priority,
                                  std::uint32_t random) noexcept;

/// Returns the bytes of the table of classes and of their shares, whole rows; 0 if samples have
/// none.
std::size_t class_bytes(const SampleParams& params);
/// Appends the table and the shares.
void add_classes(const SampleParams& params, UploadParts& parts);

} // namespace geodisk
