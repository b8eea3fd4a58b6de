#include "files/samples/neighbour_file.hpp"

#include <algorithm>

#include "files/archives/npz_arrays.hpp"
#include "files/archives/zip_writer.hpp"
#include "files/input_file.hpp"
#include "files/output/block_writer.hpp"
#include "files/samples/sample_format.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {

SampleTarget neighbour_target(const Path& path, const std::string& format, const std::string& what,
                              const std::string& formats) {
    const auto wanted = find_format(path, format);
    if (!wanted || !facts_of(*wanted).is_for_programs) {
        fail_usage(
            (format.empty() ? path.string() : "--format: " + in_quotes(format)) + ": " + what +
            " are written as " + formats +
            (format.empty() && lower_extension(path).empty() ? "; give --format npz or csv" : ""));
    }
    return {path, *wanted};
}

void write_neighbours(AtomicFile& file, const SampleTarget& target, const NeighbourTable& table) {
    if (target.format == SampleFormat::npz) {
        ZipWriter zip(file);
        add_array<std::uint32_t>(zip, "sources", "<u4", table.sources);
        add_array<std::uint64_t>(zip, "offsets", "<u8", table.offsets);
        add_array<std::uint32_t>(zip, "targets", "<u4", table.targets);
        add_array<float>(zip, "distances", "<f4", table.distances);
        zip.finish();
        return;
    }
    file.write("source,target,distance\n");
    write_rows(
        file, table.targets.size(), [&](std::string& bytes, std::size_t begin, std::size_t end) {
            auto row = static_cast<std::size_t>(std::ranges::upper_bound(table.offsets, begin) -
                                                table.offsets.begin()) -
                       1;
            for (std::size_t i = begin; i < end; ++i) {
                while (table.offsets[row + 1] <= i) {
                    ++row;
                }
                append_number(bytes, table.sources[row]);
                bytes += ',';
                append_number(bytes, table.targets[i]);
                bytes += ',';
                append_number(bytes, table.distances[i]);
                bytes += '\n';
            }
        });
}

} // namespace geodisk::tools
