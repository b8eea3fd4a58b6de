// In place of the decompression, where geodisk is built without the libraries for images.
#include "files/archives/inflate.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {

std::optional<std::string> inflated(const Path& path, std::string_view /*compressed*/,
                                    std::size_t /*size*/, Wrapping /*wrapping*/) {
    fail_input(path, "is compressed, and this geodisk was built without zlib; save it "
                     "uncompressed, in numpy by savez");
}

} // namespace geodisk::tools
