#include "files/samples/map_file.hpp"

#include <string>

#include "files/archives/npz_arrays.hpp"
#include "files/archives/zip_writer.hpp"
#include "files/input_file.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {

MapFormat map_format(const Path& path) {
    const std::string extension = lower_extension(path);
    if (extension != ".npz" && extension != ".png") {
        fail_usage(path.string() + ": maps are written as .npz or .png");
    }
    return extension == ".npz" ? MapFormat::npz : MapFormat::png;
}

void write_map(AtomicFile& file, const SampleMap& map) {
    const std::string shape =
        '(' + std::to_string(map.height) + ", " + std::to_string(map.width) + ')';
    ZipWriter zip(file);
    add_shaped<std::int32_t>(zip, "sample", "<i4", map.samples, shape);
    add_shaped<float>(zip, "distance", "<f4", map.distances, shape);
    add_shaped<std::uint32_t>(zip, "face", "<i4", map.faces, shape);
    zip.finish();
}

} // namespace geodisk::tools
