// Bytes and files that geodisk keeps for itself or shares between processes, and lists for it.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <geodisk/domain.hpp>
#include <geodisk/job_frame.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/radius_field.hpp>

#include "files/byte_order.hpp"
#include "files/meshes/mesh_file.hpp"
#include "files/output/line_log.hpp"
#include "files/samples/job_frame_text.hpp"
#include "fuzz/reader.hpp"
#include "geodisk/batch/batch_log.hpp"
#include "geodisk/inputs/manifest.hpp"
#include "geodisk/options/class_options.hpp"
#include "geodisk_mpi/checkpoint_file.hpp"
#include "geodisk_mpi/ply_range.hpp"
#include "gpu/threads_exchange.hpp"
#include "kernels/pool.hpp"
#include "owned/pipeline_file.hpp"
#include "program/failure.hpp"
#include "support/meshes.hpp"
#include "unit/test_files.hpp"

namespace geodisk::test {
namespace {

using namespace geodisk::tools;

constexpr std::uint32_t kMaxCandidatesDrawn = 2000;

std::string text_of(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::span<const std::byte> bytes_in(std::string_view text) {
    return std::as_bytes(std::span(text));
}

const PreparedMesh& cube() {
    static const PreparedMesh mesh = prepared(builtin("cube", 2));
    return mesh;
}

/// Fields of both kinds on the cube.
const std::array<RadiusField, 2>& cube_fields() {
    static const std::array<RadiusField, 2> fields = [] {
        std::vector<double> values;
        for (std::uint32_t v = 0; v < cube().fans().size(); ++v) {
            values.push_back((1 + v % 8) / 8.0);
        }
        return std::array{RadiusField::prepare(cube(), values).value(),
                          RadiusField::from_density(cube(), values).value()};
    }();
    return fields;
}

SampleParams cube_params() {
    SampleParams params;
    params.min_distance = cube().statistics().diagonal / 8;
    return params;
}

/// A frame is the one that was written, and one of the cube makes a domain or is refused.
void read_as_job_frame(const FuzzedFile& file) {
    const auto frame = frame_from_bytes(bytes_in(file.bytes));
    if (!frame) {
        require_in_fuzzer(!frame.error().message.empty());
        job_frame_of_text(std::string(file.bytes), file.path.string());
        return;
    }
    const std::string again = text_of(to_bytes(*frame));
    require_in_fuzzer(again.substr(0, kJobFrameBytes - 4) ==
                      file.bytes.substr(0, kJobFrameBytes - 4));
    require_in_fuzzer(job_frame_of_text(job_frame_text(*frame), "") == *frame);
    SampleParams params = cube_params();
    params.min_distance = frame->min_distance;
    params.radii = frame->radii_vary ? cube_fields().data() : nullptr;
    const auto domain = Domain::surface(cube(), params, *frame);
    require_in_fuzzer(domain || !domain.error().message.empty());
}

std::vector<std::string> job_frame_seeds(const std::string&) {
    std::vector<std::string> seeds;
    for (const RadiusField* radii : {static_cast<const RadiusField*>(nullptr), &cube_fields()[0]}) {
        SampleParams params = cube_params();
        params.radii = radii;
        const JobFrame frame = frame_of(cube(), params).value();
        seeds.push_back(text_of(to_bytes(frame)));
        seeds.push_back(job_frame_text(frame));
    }
    return seeds;
}

/// A field is saved as it was read, and one of the cube can be sampled by.
void read_as_saved_radii(const FuzzedFile& file) {
    const auto field = RadiusField::load(bytes_in(file.bytes));
    if (!field) {
        require_in_fuzzer(!field.error().message.empty());
        return;
    }
    // Without a face, neither kind of radii is told from the other.
    require_in_fuzzer(field->face_count() == 0 || text_of(field->save().value()) == file.bytes);
    SampleParams params = cube_params();
    params.radii = &*field;
    const auto domain = Domain::surface(cube(), params);
    if (!domain) {
        require_in_fuzzer(!domain.error().message.empty());
        return;
    }
    require_in_fuzzer(bool(field->reach_bounds(cube(), params.min_distance)));
    for (std::uint32_t face = 0; face < field->face_count(); ++face) {
        const double factor = field->factor_at(face, {0.5, 0.25, 0.25});
        require_in_fuzzer(factor > 0 && factor <= 1 && field->samples_in(face) >= 0);
        require_in_fuzzer(field->share_at(std::size_t{3} * face) >= 0);
    }
    // Only the mesh tells whether the area is right.
    double area = 0;
    for (std::uint32_t face = 0; face < field->face_count(); ++face) {
        area += field->samples_in(face) * cube().statistics().area / field->face_count();
    }
    const bool is_right = std::abs(area - field->effective_area()) < 1e-3 * area;
    const auto size = pool_size(cube(), params);
    if (is_right && size && *size <= kMaxCandidatesDrawn) {
        ref::draw_pool(ref::Surface<float>(cube(), params), params);
    }
}

std::vector<std::string> saved_radii_seeds(const std::string&) {
    std::vector<std::string> seeds;
    for (const RadiusField& field : cube_fields()) {
        seeds.push_back(text_of(field.save().value()));
    }
    return seeds;
}

VkPipelineCacheHeaderVersionOne pipeline_header() {
    VkPipelineCacheHeaderVersionOne header{};
    header.headerSize = sizeof header;
    header.headerVersion = VK_PIPELINE_CACHE_HEADER_VERSION_ONE;
    return header;
}

/// Requires that what is loaded begins as Vulkan wants it.
void read_as_pipelines(const FuzzedFile& file) {
    static const PipelineFile pipelines = [&] {
        PipelineFile linked(file.path.parent_path(), {});
        std::filesystem::create_symlink(file.path, linked.path());
        return linked;
    }();
    const std::vector<std::byte> contents = pipelines.load();
    if (!contents.empty()) {
        VkPipelineCacheHeaderVersionOne header{};
        require_in_fuzzer(contents.size() >= sizeof header);
        std::memcpy(&header, contents.data(), sizeof header);
        require_in_fuzzer(header.headerSize <= contents.size() && header.vendorID == 0 &&
                          header.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE);
    }
}

std::vector<std::string> pipelines_seeds(const std::string&) {
    const TemporaryFolder folder;
    const PipelineFile pipelines(folder / ".", {});
    const auto header = pipeline_header();
    std::vector<std::byte> contents(sizeof header + 8);
    std::memcpy(contents.data(), &header, sizeof header);
    pipelines.store(contents);
    return {bytes_of(pipelines.path())};
}

constexpr JobDigests kJobOfFuzzer{1, 2};

void read_as_checkpoint(const FuzzedFile& file) {
    const Checkpoint checkpoint = read_checkpoint(file.path, kJobOfFuzzer);
    require_in_fuzzer(checkpoint.samples.size() <= file.bytes.size());
}

std::vector<std::string> checkpoint_seeds(const std::string&) {
    const TemporaryFolder folder;
    Checkpoint checkpoint;
    checkpoint.first_stage = 3;
    checkpoint.candidates = 40;
    checkpoint.samples.resize(2);
    write_checkpoint(folder / "checkpoint", kJobOfFuzzer, checkpoint);
    return {bytes_of(folder / "checkpoint")};
}

/// Two processes read the mesh that one reads as a whole.
void read_as_ply_range(const FuzzedFile& file) {
    ply_faces(file.path);
    RangeWants wanted;
    wanted.density = DensitySource{"a", true, DensitySource::Kind::attribute, "a", 0.25};
    wanted.mask = {{false, "m", MaskRule::Comparison::at_least, 0.5},
                   {false, "z", MaskRule::Comparison::less, 0.5}};
    for (const RangeWants& wants : {RangeWants{}, wanted}) {
        std::array<std::optional<MeshRange>, 2> ranges;
        run_threads(ranges.size(), [&](Exchange& exchange) {
            if (auto range = read_ply_range(exchange, file.path, wants)) {
                ranges[exchange.rank()] = std::move(*range);
            }
        });
        require_in_fuzzer(ranges[0].has_value() == ranges[1].has_value());
        if (!ranges[0]) {
            continue;
        }
        std::vector<std::uint32_t> triangles;
        std::vector<double> positions;
        for (const auto& range : ranges) {
            triangles.insert(triangles.end(), range->triangles.begin(), range->triangles.end());
            positions.insert(positions.end(), range->positions.begin(), range->positions.end());
        }
        MeshSources sources;
        sources.mesh = file.path.string();
        sources.keep_seams = true;
        const MeshFile whole = read_mesh(sources);
        require_in_fuzzer(triangles.size() == whole.triangles.size() &&
                          positions.size() == whole.positions.size());
        for (std::size_t i = 0; i < triangles.size(); ++i) { // But for copies of triangles.
            const bool takes_part = whole.takes_part(static_cast<std::uint32_t>(i / 3));
            require_in_fuzzer(!takes_part || triangles[i] == whole.triangles[i]);
        }
        for (std::size_t i = 0; i < positions.size(); ++i) { // Unused vertices may have any.
            require_in_fuzzer(positions[i] == whole.positions[i] || std::isnan(positions[i]));
        }
    }
}

std::vector<std::string> ply_range_seeds(const std::string&) {
    std::string with_values = "ply\nformat binary_little_endian 1.0\nelement vertex 4\n"
                              "property float x\nproperty float y\nproperty float z\n"
                              "property float a\nelement face 2\nproperty uchar m\n"
                              "property list uchar int vertex_indices\nend_header\n";
    for (const char digit : std::string_view("0001100011120101")) { // Four numbers a vertex.
        append_little_endian(with_values, static_cast<float>(digit - '0'));
    }
    for (const std::uint32_t third : {2u, 3u}) {
        with_values += "\1\3";
        for (const std::uint32_t corner : {0u, third - 1, third}) {
            append_little_endian(with_values, corner);
        }
    }
    const TemporaryFolder folder;
    write_mesh(folder / "cube.ply", read_mesh("builtin:cube:1"));
    return {with_values, bytes_of(folder / "cube.ply")};
}

/// Lists of meshes, tables of classes and logs of batches are lines of text.
void read_as_lists(const FuzzedFile& file) {
    commands_done(file.path.parent_path().string());
    try {
        parse_classes(file.path.string());
    } catch (const UserError&) {
    }
    for (const ManifestLine& line : read_manifest(file.path)) {
        require_in_fuzzer(!line.words.empty());
    }
}

std::vector<std::string> list_seeds(const std::string&) {
    const TemporaryFolder folder;
    {
        LineLog log(folder / "batch.jsonl");
        append_entry(log, {"a.obj", "a.ply", "sample a.obj", 0, "", 5, 0.5, 1, "cpu", {"odd"}});
        append_entry(log, {"b.obj", "b.ply", "sample b.obj", 3, "is no mesh", 0, 0, 0, "", {}});
    }
    return {bytes_of(folder / "batch.jsonl"), "1, 0.5\n0.5; 1 # two classes\n",
            "a.obj --count 5\n'b c.obj' --min-distance=1% # one\n\n\"d\".ply -o e.ply\n"};
}

constexpr Reader kByteReaders[] = {
    {"job_frame", "frame", read_as_job_frame, job_frame_seeds},
    {"saved_radii", "radii", read_as_saved_radii, saved_radii_seeds},
    {"pipelines", "pipelines", read_as_pipelines, pipelines_seeds},
    {"checkpoint", "checkpoint", read_as_checkpoint, checkpoint_seeds},
    {"ply_range", "range.ply", read_as_ply_range, ply_range_seeds},
    {"lists", "batch.jsonl", read_as_lists, list_seeds},
};

} // namespace

const std::span<const Reader> kReaders = kByteReaders;

} // namespace geodisk::test
