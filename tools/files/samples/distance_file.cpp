#include "files/samples/distance_file.hpp"

#include <cmath>
#include <cstddef>
#include <string>

#include "files/archives/npz_arrays.hpp"
#include "files/archives/zip_writer.hpp"
#include "files/output/block_writer.hpp"
#include "program/exact_text.hpp"

namespace geodisk::tools {

void write_distances(AtomicFile& file, const SampleTarget& target, const DistanceTable& table) {
    const bool has_rows = table.nearest.empty();
    const std::size_t rows = has_rows ? table.sources.size() : 1;
    const std::size_t vertices = table.distances.size() / rows;
    if (target.format == SampleFormat::npz) {
        ZipWriter zip(file);
        add_array<std::uint32_t>(zip, "sources", "<u4", table.sources);
        add_array<double>(zip, "distances", "<f8", table.distances,
                          has_rows ? static_cast<std::uint32_t>(vertices) : 1);
        if (!has_rows) {
            add_array<std::uint32_t>(zip, "nearest", "<u4", table.nearest);
        }
        zip.finish();
        return;
    }
    file.write("vertex,distance,source\n");
    write_each(file, table.distances.size(), [&](std::string& bytes, std::size_t i) {
        if (std::isfinite(table.distances[i])) {
            append_number(bytes, i % vertices);
            bytes += ',';
            append_number(bytes, table.distances[i]);
            bytes += ',';
            append_number(bytes, has_rows ? table.sources[i / vertices] : table.nearest[i]);
            bytes += '\n';
        }
    });
}

} // namespace geodisk::tools
