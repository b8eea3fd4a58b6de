// A power spectrum as a picture.
#pragma once

#include "analysis/power_spectrum.hpp"
#include "picture/picture.hpp"

namespace geodisk::tools::picture {

/// Returns the picture of a box of two dimensions: a pixel per frequency, with 0 in the middle.
/// Black is no power, and white twice as much as white noise has.
Pixels power_picture(const analysis::PowerSpectrum& spectrum);

} // namespace geodisk::tools::picture
