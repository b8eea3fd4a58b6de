// Text and bars on a picture.
#pragma once

#include <string_view>

#include <glm/vec3.hpp>

#include "picture/picture.hpp"

namespace geodisk::tools::picture {

/// Pixels that `text` is wide; `size` is that of an em in pixels. Characters beyond ASCII are drawn
/// as boxes.
double text_width(std::string_view text, double size);

/// Pixels of the font above and below the line that letters stand on.
double ascent(double size);
double descent(double size);

/// Draws `text` from x on, standing on the line y. Colours are sRGB, from 0 to 1. Clips at the
/// edges of the picture.
void draw_text(Pixels& pixels, double x, double y, std::string_view text, double size,
               glm::vec3 color);

/// Fills the rectangle from (left, top) up to (right, bottom).
void fill(Pixels& pixels, double left, double top, double right, double bottom, glm::vec3 color);

} // namespace geodisk::tools::picture
