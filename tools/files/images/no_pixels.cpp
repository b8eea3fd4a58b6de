// In place of the decoders, where geodisk is built without the libraries for images.
#include "files/images/image_pixels.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {

ImagePixels decode_png(const Path& path, const std::string& /*bytes*/, PixelKind /*kind*/) {
    fail_input(path, "this geodisk was built without libpng, which PNG images need");
}

ImagePixels decode_jpeg(const Path& path, const std::string& /*bytes*/, PixelKind /*kind*/) {
    fail_input(path, "this geodisk was built without libjpeg, which JPEG images need");
}

ImagePixels decode_plain(const Path& path, const std::string& /*bytes*/, PixelKind /*kind*/) {
    fail_input(path, "this geodisk was built without images");
}

} // namespace geodisk::tools
