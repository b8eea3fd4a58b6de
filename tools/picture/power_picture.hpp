// A power spectrum as a picture.
#pragma once

#include "analysis/power_spectrum.hpp"
#include "picture/picture.hpp"

namespace geodisk::tools::picture {

/// Of a box of two dimensions: a pixel per frequency, with 0 in the middle: black for no power,
/// white for twice as much as white noise has.
Pixels power_picture(const analysis::PowerSpectrum& spectrum);

} // namespace geodisk::tools::picture
