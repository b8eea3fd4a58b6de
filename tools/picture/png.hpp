// PNG files.
#pragma once

#include "files/output/output_file.hpp"
#include "picture/picture.hpp"

namespace geodisk::tools::picture {

/// Writes RGBA, or RGB where nothing is transparent. Throws UserError(bad_output), or
/// `out_of_memory`.
void write_png(AtomicFile& file, const Pixels& pixels);

} // namespace geodisk::tools::picture
