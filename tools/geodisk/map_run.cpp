#include "geodisk/map_run.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <geodisk/cells.hpp>
#include <geodisk/nearest.hpp>

#include "files/samples/map_padding.hpp"
#include "geodisk/cell_run.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"
#include "program/stopwatch.hpp"

namespace geodisk::tools {
namespace {

// Texels that are looked up at once: some 60 bytes each.
constexpr std::size_t kTexelsAtOnce = std::size_t{1} << 18;

void check_range(const std::string& path, const MeshFile& mesh, TextureSize size) {
    const double most = Texels::kFarthest / std::max(size.width, size.height) - 1;
    const std::vector<double>& values = mesh.texture_uvs->values;
    const auto far = std::ranges::find_if(values, [&](double x) { return !(std::abs(x) <= most); });
    if (far != values.end()) {
        fail_input(path, "has the texture coordinate " + rounded(*far, 6) +
                             ", too far from 0 for a map of this size: at most " +
                             rounded(std::floor(most), 6));
    }
}

/// Looks up the texels from `begin` to `end`.
void look_up(const NearestSamples& nearest, const Texels& texels, std::size_t begin,
             std::size_t end, MapResult& result) {
    std::vector<Sample> points;
    std::vector<std::size_t> places;
    for (std::size_t texel = begin; texel < end; ++texel) {
        if (const std::uint32_t face = texels.faces()[texel]; face != Texels::kNone) {
            const auto [first, second, third] = texels.weights(texel);
            points.push_back({face, {first, second, third}});
            places.push_back(texel);
        }
    }
    const std::vector<NearestSample> found = take(nearest.of(points));
    SampleMap& map = result.map;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const auto [sample, distance] = found[i];
        map.distances[places[i]] = distance;
        if (sample == NearestSample::kNone) {
            ++result.unreached;
        } else {
            map.samples[places[i]] = static_cast<std::int32_t>(sample);
            result.largest_distance = std::max(result.largest_distance, distance);
        }
    }
}

/// Returns the pairs of samples whose cells touch.
std::vector<std::array<std::uint32_t, 2>> find_touching(const NearestSamples& disks,
                                                        ProgressLine& progress) {
    progress.begin_stage("finding colours");
    auto cells = disks.cells(search_progress(progress, "samples"));
    progress.clear();
    check_interrupted();
    return take(std::move(cells)).edges;
}

/// Finds the texels that faces cover.
Texels texels_of(const MeshFile& mesh, TextureSize size, const std::string& path,
                 ProgressLine& progress) {
    check_range(path, mesh, size);
    progress.begin_stage("finding texels");
    Texels texels(mesh, size);
    if (texels.covered() == 0) {
        fail_input(path, "no face covers the centre of a texel; give a larger --size");
    }
    return texels;
}

MapResult look_up_all(Texels texels, std::uint32_t padding, const NearestSamples& disks,
                      ProgressLine& progress) {
    const TextureSize size = texels.size();
    MapResult result;
    progress.begin_stage("finding nearest samples");
    result.map = {size.width,
                  size.height,
                  std::vector<std::int32_t>(size.texels(), SampleMap::kNone),
                  std::vector<float>(size.texels(), std::numeric_limits<float>::quiet_NaN()),
                  {}};
    for (std::size_t begin = 0; begin < size.texels(); begin += kTexelsAtOnce) {
        check_interrupted();
        look_up(disks, texels, begin, std::min(begin + kTexelsAtOnce, size.texels()), result);
        progress.update(static_cast<double>(begin) / static_cast<double>(size.texels()), "");
    }
    progress.clear();
    static_assert(SampleMap::kNoFace == Texels::kNone);
    result.covered = texels.covered();
    result.overlapping = texels.overlapping();
    result.repeating = texels.repeating();
    result.map.faces = std::move(texels).take_faces();
    result.padded = pad(result.map, padding);
    result.error = disks.error();
    return result;
}

} // namespace

MapResult look_up_map(const MeshFile& mesh, MapSize size, const std::string& path,
                      const NearestSamples& disks, ProgressLine& progress) {
    return look_up_all(texels_of(mesh, size.texture, path, progress), size.padding, disks,
                       progress);
}

MapResult run_map(std::span<const SampleRow> rows, MapSize size, const MeshInput& mesh,
                  bool has_touching, RunDevice& device, std::uint64_t bytes,
                  ProgressLine& progress) {
    Texels texels = texels_of(mesh.file, size.texture, mesh.path, progress);
    DeviceRun done = device.begin_search(progress);
    const NearestSamples disks = find_nearest(rows, mesh, device, bytes, progress);
    std::vector<std::array<std::uint32_t, 2>> touching;
    if (has_touching) {
        touching = find_touching(disks, progress);
    }
    const Stopwatch watch;
    MapResult result = look_up_all(std::move(texels), size.padding, disks, progress);
    result.touching = std::move(touching);
    result.done = std::move(done);
    result.done.run = disks.report();
    result.done.run.seconds.sample += watch.seconds();
    return result;
}

} // namespace geodisk::tools
