#include "geodisk/inputs/mesh_input.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <geodisk/checkpoint.hpp>
#include <geodisk/detail/fnv1a.hpp>

#include "files/meshes/mesh_file.hpp"
#include "files/samples/told_samples.hpp"
#include "geodisk/inputs/mask_input.hpp"
#include "geodisk/inputs/radii_input.hpp"
#include "geodisk/inputs/wall_input.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geometry/lift.hpp"
#include "geometry/surface_warnings.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"
#include "program/stopwatch.hpp"

namespace geodisk::tools {
namespace {

// A grey inside a face matters if it differs from what the corners tell by more than this part: of
// the largest grey for a density, of itself for a factor.
constexpr double kGreySteps = 32, kFactorSteps = 16;

/// Fills in the warnings of a mesh of the file `path`.
void collect_warnings(const std::string& path, MeshInput& mesh, bool has_normals) {
    mesh.warnings = std::move(mesh.file.warnings);
    if (!is_builtin(path) || has_normals) { // Those are one-sided by design.
        for (MeshWarning& warning : surface_warnings(mesh.file, mesh.prepared, has_normals)) {
            mesh.warnings.push_back(std::move(warning));
        }
    }
    for (MeshWarning& warning : mesh.warnings) {
        warning.file = path;
    }
}

PreparedMesh prepare_lengths(const std::string& path, const MeshFile& file) {
    const std::uint32_t vertices =
        1 + *std::max_element(file.triangles.begin(), file.triangles.end());
    return take(PreparedMesh::prepare({file.triangles, file.lengths, vertices}), path);
}

/// Coordinates of vertices.
struct Positions {
    std::span<const double> values;
    std::uint32_t dimension;
};

/// Returns the images that the density and the mask name, with what matters of them.
std::vector<ReadImage> images_of(const std::vector<DensitySource>& densities,
                                 const std::vector<MaskRule>& masks) {
    std::vector<ReadImage> images;
    for (const DensitySource& density : densities) {
        if (density.kind != DensitySource::Kind::map) {
            continue;
        }
        const auto image = std::make_shared<const GreyImage>(density.name);
        // Radii go by the square root of a density, so by the ratio of factors.
        const double step = image->largest() / kGreySteps;
        const bool is_density = density.is_density;
        const double floor = density.floor.value_or(RadiusField::kMinFactor);
        images.push_back({image, density.name, [=](double grey, double linear, const auto&) {
                              const double allowed =
                                  is_density
                                      ? step
                                      : std::max(floor, std::min(grey, linear)) / kFactorSteps;
                              return std::abs(grey - linear) > allowed;
                          }});
    }
    for (const MaskRule& rule : masks) {
        if (rule.is_map) {
            images.push_back({std::make_shared<const GreyImage>(rule.name), rule.name,
                              [rule](double grey, double, const std::array<double, 3>& corners) {
                                  const bool is_in = std::ranges::all_of(
                                      corners, [&](double corner) { return rule.holds(corner); });
                                  return rule.holds(grey) != is_in;
                              }});
        }
    }
    return images;
}

/// Splits faces for the images that the options name.
std::optional<SplitSurface> split_surface(const std::string& path, const MeshFile& file,
                                          const Positions& surface,
                                          const std::vector<ReadImage>& images,
                                          std::vector<MeshWarning>& warnings) {
    if (images.empty()) {
        return std::nullopt;
    }
    if (!file.lengths.empty()) {
        warnings.push_back({"fine_image", 1, "",
                            "is read at the vertices alone, since the mesh has edge lengths",
                            images.front().name});
        return std::nullopt;
    }
    std::optional<SplitFaces> faces = split_for_images(file, images, warnings);
    if (!faces) {
        return std::nullopt;
    }
    const std::vector<double> positions =
        faces->parts().extended(surface.values, surface.dimension);
    PreparedMesh prepared = take(
        PreparedMesh::prepare({positions, faces->parts().triangles(), surface.dimension, true}),
        path);
    return SplitSurface{std::move(*faces), std::move(prepared)};
}

/// Returns what the lifts, the density and the mask need of the mesh file.
MeshSources sources_of(const MeshOptions& options, std::span<const Lift> lifts,
                       const std::vector<DensitySource>& densities,
                       const std::vector<MaskRule>& masks) {
    using Kind = DensitySource::Kind;
    MeshSources sources;
    sources.mesh = options.mesh;
    sources.format = options.format;
    sources.coordinates = options.coordinates;
    sources.edge_lengths = options.edge_lengths;
    sources.weld = options.weld_distance();
    sources.keep_seams = options.keep_seams;
    sources.fields = options.fields;
    sources.allows_outside = options.allows_outside;
    WantedFields& fields = sources.fields;
    fields.numbers = lift_attributes(lifts);
    for (const MaskRule& rule : masks) {
        if (rule.is_map) {
            fields.uvs = true;
        } else if (!rule.axis()) {
            fields.numbers.push_back(rule.name);
        }
    }
    for (const DensitySource& density : densities) {
        if (density.kind == Kind::attribute) {
            fields.numbers.push_back(density.name);
        }
        fields.uvs = fields.uvs || density.kind == Kind::map;
    }
    return sources;
}

} // namespace

std::array<double, 8> MeshInput::point(std::uint32_t face, const float (&weights)[3]) const {
    std::array<double, 8> sum{};
    for (std::uint32_t corner = 0; corner < 3 && dimension() > 0; ++corner) {
        const auto position = vertex(face, corner);
        for (std::size_t axis = 0; axis < position.size(); ++axis) {
            sum[axis] += static_cast<double>(weights[corner]) * position[axis];
        }
    }
    return sum;
}

Vec3 MeshInput::normal(std::uint32_t face) const {
    if (dimension() != 3) {
        return {};
    }
    const auto corner = [&](std::size_t k) {
        return point_at(file.positions, file.triangles[std::size_t{3} * face + k]);
    };
    const Vec3 a = corner(0);
    // Edges of unit length first: products of very short or long ones leave the range of double.
    const Vec3 ab = corner(1) - a;
    const Vec3 ac = corner(2) - a;
    if (!(length(ab) > 0) || !(length(ac) > 0)) {
        return {};
    }
    const Vec3 n = cross(normalize(ab), normalize(ac));
    return length(n) > 0 ? normalize(n) : Vec3{};
}

void MeshInput::place(SampleRow& row) const {
    const std::array<double, 8> position = point(row.face, row.bary);
    std::copy(position.begin(), position.end(), row.position);
    const Vec3 n = normal(row.face);
    row.normal[0] = static_cast<float>(n.x);
    row.normal[1] = static_cast<float>(n.y);
    row.normal[2] = static_cast<float>(n.z);
    row.polygon = polygon(row.face);
}

bool MeshInput::has_walls() const {
    return std::ranges::any_of(additions, [](const auto& entry) { return entry.first == "walls"; });
}

std::string surface_digest_text(const MeshInput& mesh) {
    const bool has_mask =
        mesh.known ? mesh.known->triangles_for_samples.has_value() : !mesh.face_mask.empty();
    if (!mesh.has_walls() && !has_mask && !mesh.radii) {
        return "";
    }
    return detail::hexadecimal(
        mesh.known ? mesh.known->digest
                   : surface_digest(mesh.sampled(), mesh.with_fields(SampleParams())));
}

MeshInput load_silently(const MeshOptions& options, ProgressLine& progress,
                        const DensityOptions& density, const MaskOptions& mask,
                        const std::string& hint) {
    const std::string& path = options.mesh;
    const std::optional<DensitySource> source = density.source();
    const std::vector<Lift> lifts = options.parsed_lifts();
    const std::vector<WallRule> walls = wall_rules(options.walls);
    std::vector<DensitySource> densities;
    if (source) {
        densities.push_back(*source);
    }
    std::vector<MaskRule> masks = mask.mask_rules();
    for (const ClassPlace& place : mask.class_places()) {
        masks.insert(masks.end(), place.rules.begin(), place.rules.end());
        if (place.density) {
            densities.push_back(*place.density);
        }
    }
    progress.begin_stage("reading the mesh");
    Stopwatch watch;
    std::vector<MaskRule> compared = masks;
    const std::vector<MaskRule> compared_for_walls = mask_rules_of(walls);
    compared.insert(compared.end(), compared_for_walls.begin(), compared_for_walls.end());
    MeshSources sources = sources_of(options, lifts, densities, compared);
    for (const WallRule& wall : walls) {
        if (const auto* const edges = std::get_if<EdgeWalls>(&wall)) {
            sources.numbering = "--walls edges:" + edges->file;
        }
    }
    sources.progress = [&](double part) {
        check_interrupted();
        progress.update(part, "");
    };
    MeshFile file = read_unless_samples(path, hint, [&] { return read_mesh(sources); });
    if (!walls.empty()) {
        cut_walls(path, walls, file);
    }
    const double load_seconds = watch.seconds();
    check_interrupted();

    progress.begin_stage("preparing the mesh");
    watch = Stopwatch();
    const LiftedPositions lifted =
        lifts.empty() ? LiftedPositions{} : lifted_positions(path, file, lifts);
    const Positions surface = lifts.empty() ? Positions{file.positions, file.dimension}
                                            : Positions{lifted.positions, lifted.dimension};
    PreparedMesh prepared =
        file.lengths.empty()
            ? take(PreparedMesh::prepare({surface.values, file.triangles, surface.dimension, true}),
                   path)
            : prepare_lengths(path, file);
    std::vector<MeshWarning> density_warnings;
    std::optional<SplitSurface> split =
        split_surface(path, file, surface, images_of(densities, masks), density_warnings);
    const SplitFaces* const faces = split ? &split->faces : nullptr;
    std::optional<RadiusField> radii;
    double distance_part = 1;
    if (source) {
        LoadedRadii loaded =
            load_radii(*source, path, file, split ? split->prepared : prepared, faces);
        radii = std::move(loaded.field);
        distance_part = source->is_density ? radii->min_factor() : 1;
        for (std::optional<MeshWarning> warning : {density.warning(), loaded.warning}) {
            if (warning) {
                density_warnings.push_back(std::move(*warning));
            }
        }
    }
    LoadedMask loaded_mask = load_mask(mask, path, file, faces);
    LoadedShares loaded_shares =
        load_shares(mask, path, file, split ? split->prepared : prepared, faces);
    MeshInput mesh{std::move(file),  std::move(prepared),
                   std::move(radii), std::move(loaded_mask.faces),
                   distance_part,    {},
                   load_seconds,     watch.seconds()};
    mesh.split = std::move(split);
    mesh.path = path;
    mesh.additions = with_entries(density.added_to(options.additions()), mask);
    mesh.class_count = loaded_shares.count;
    mesh.class_shares = std::move(loaded_shares.shares);
    if (mesh.file.materials) {
        mesh.textures.emplace(mesh.file);
        mesh.file.materials->images.clear(); // They are decoded now.
        mesh.file.materials->images.shrink_to_fit();
    } else if (!options.texture.empty()) {
        mesh.textures.emplace(mesh.file, options.texture);
    }
    collect_warnings(path, mesh, lift_attributes(lifts).size() < lifts.size());
    mesh.warnings.insert(mesh.warnings.end(), density_warnings.begin(), density_warnings.end());
    mesh.warnings.insert(mesh.warnings.end(), loaded_mask.warnings.begin(),
                         loaded_mask.warnings.end());
    mesh.warnings.insert(mesh.warnings.end(), loaded_shares.warnings.begin(),
                         loaded_shares.warnings.end());
    check_interrupted();
    return mesh;
}

MeshInput load_mesh(const MeshOptions& options, ProgressLine& progress,
                    const DensityOptions& density, const MaskOptions& mask,
                    const std::string& hint) {
    MeshInput mesh = load_silently(options, progress, density, mask, hint);
    progress.clear();
    print_warnings(mesh.warnings);
    return mesh;
}

MeshInput load_masked_mesh(const MeshOptions& options, ProgressLine& progress,
                           const MaskOptions& mask) {
    MeshInput mesh = load_mesh(options, progress, {}, mask);
    if (mesh.split) {
        fail_usage(
            "--mask: the image shows more than the corners of faces; split the faces where it "
            "has detail");
    }
    mesh.additions = options.additions();
    return mesh;
}

double distance_on_mesh(const Length& length, const MeshStatistics& mesh) {
    if (length.is_percent && mesh.diagonal == 0) {
        fail_usage("a mesh of edge lengths has no bounding box to take % of; "
                   "give the distance in mesh units");
    }
    return length.in_mesh_units(mesh.diagonal);
}

} // namespace geodisk::tools
