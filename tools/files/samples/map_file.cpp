#include "files/samples/map_file.hpp"

#include <string>

#include "files/archives/npz_arrays.hpp"
#include "files/archives/zip_writer.hpp"
#include "files/input_file.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {

namespace {

std::string shape_of(const SampleMap& map) {
    return '(' + std::to_string(map.height) + ", " + std::to_string(map.width) + ')';
}

} // namespace

MapFormat map_format(const Path& path) {
    const std::string extension = lower_extension(path);
    if (extension == ".npz") {
        return MapFormat::npz;
    }
    if (extension == ".npy") {
        return MapFormat::npy;
    }
    if (extension == ".png") {
        return MapFormat::png;
    }
    fail_usage(path.string() + ": maps are written as .npz, .npy or .png" +
               (extension == ".exr" ? "; for distances as floats, write .npy" : ""));
}

void write_arrays(AtomicFile& file, const SampleMap& map) {
    const std::string shape = shape_of(map);
    ZipWriter zip(file);
    add_shaped<std::int32_t>(zip, "sample", "<i4", map.samples, shape);
    add_shaped<float>(zip, "distance", "<f4", map.distances, shape);
    add_shaped<std::uint32_t>(zip, "face", "<i4", map.faces, shape);
    zip.finish();
}

void write_distances(AtomicFile& file, const SampleMap& map) {
    file.write(shaped_array<float>("<f4", map.distances, shape_of(map)));
}

} // namespace geodisk::tools
