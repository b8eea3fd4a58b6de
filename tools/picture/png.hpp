// PNG files.
#pragma once

#include <string>

#include "files/output/output_file.hpp"
#include "picture/picture.hpp"

namespace geodisk::tools::picture {

/// Returns a file of RGBA, or RGB where nothing is transparent. Throws UserError(out_of_memory).
std::string png_of(const Pixels& pixels);

/// Returns a file of grey in 16 bits, with alpha unless nothing is transparent. Throws the same.
std::string png_of(const DeepPixels& pixels);

/// Writes it. Throws UserError(bad_output), or `out_of_memory`.
void write_png(AtomicFile& file, const Pixels& pixels);

} // namespace geodisk::tools::picture
