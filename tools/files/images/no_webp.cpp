// In place of the decoder, where geodisk is built without the library for WebP.
#include "files/images/image_pixels.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {

ImagePixels decode_webp(const Path& path, const std::string& /*bytes*/, PixelKind /*kind*/) {
    fail_input(path, "this geodisk was built without libwebp, which WebP images need");
}

} // namespace geodisk::tools
