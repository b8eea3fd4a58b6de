// Steps of `geodisk verify`, by one process or many.
#pragma once

#include "geodisk/checks/near_pairs.hpp"
#include "geodisk/options/verify_options.hpp"

namespace geodisk::tools {

/// Checks samples and publishes what it finds; pairs of samples on a mesh are found by `note`.
/// Throws UserError, that of violations among them.
void verify_samples(const VerifyOptions& options, const NotePairs& note = note_pairs);

} // namespace geodisk::tools
