// The mesh of a command, read and prepared, with all that is odd about it told to the user.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <geodisk/mesh.hpp>
#include <geodisk/params.hpp>
#include <geodisk/radius_field.hpp>
#include <geodisk/sample.hpp>

#include "files/images/textures.hpp"
#include "files/samples/sample_file.hpp"
#include "geodisk/inputs/split_faces.hpp"
#include "geodisk/options/density_options.hpp"
#include "geodisk/options/mask_options.hpp"
#include "geodisk/options/mesh_options.hpp"
#include "geodisk/outputs/progress.hpp"
#include "geometry/mesh.hpp"
#include "geometry/vec.hpp"
#include "program/arguments.hpp"

namespace geodisk::tools {

/// Returns the point of its mesh that a row names.
inline Sample sample_of(const SampleRow& row) {
    return {row.face, {row.bary[0], row.bary[1], row.bary[2]}};
}
/// Returns those of all rows.
inline std::vector<Sample> samples_of(std::span<const SampleRow> rows) {
    std::vector<Sample> samples(rows.size());
    std::ranges::transform(rows, samples.begin(), sample_of);
    return samples;
}

/// The surface of a mesh whose faces are split for images.
struct SplitSurface {
    SplitFaces faces;
    PreparedMesh prepared; ///< Mesh of the parts.
};

struct MeshInput {
    MeshFile file;
    PreparedMesh prepared;            ///< Mesh of the lifted positions or edge lengths, if given.
    std::optional<RadiusField> radii; ///< Radii on sampled(), if the options say that they vary.
    /// SampleParams::face_mask on sampled(), where options give one.
    std::vector<std::uint8_t> face_mask;
    /// Distances given and told, as a part of that of two samples with the largest radius: with
    /// --density they are those of the smallest.
    double distance_part = 1;
    std::vector<MeshWarning> warnings; ///< For the user.
    double load_seconds = 0;
    double prepare_seconds = 0;
    std::optional<Textures> textures = std::nullopt; ///< Whose colours samples get.
    /// Facts about a mesh that no process holds whole, and that `prepared` stands for.
    struct Known {
        double area, borders; ///< As effective_area() and distance_for_count() take them.
        std::optional<std::uint64_t> triangles_for_samples; ///< With a mask.
        std::uint64_t digest;                               ///< surface_digest().
    };
    std::optional<Known> known = std::nullopt;
    std::optional<SplitSurface> split = std::nullopt; ///< Set if images show more than corners.
    /// SampleParams::class_shares of so many classes on sampled(), where options give some.
    std::size_t class_count = 0;
    std::vector<float> class_shares{};
    std::string path{}; ///< Names the mesh in messages and reports.
    /// Options that shape the surface, its radii and where samples may lie, as headers name them.
    HeaderEntries additions{};

    /// Returns the mesh that samples are drawn on, and that radii and masks are of.
    const PreparedMesh& sampled() const { return split ? split->prepared : prepared; }
    /// Returns the point of sampled() that a point of a face of the file is.
    Sample on_sampled(const Sample& sample) const {
        return split ? split->faces.parts().part(sample) : sample;
    }
    Sample sampled_of(const SampleRow& row) const { return on_sampled(sample_of(row)); }
    /// Returns the point of the file's face that a point of sampled() is of.
    Sample in_file(const Sample& sample) const {
        return split ? split->faces.parts().whole(sample) : sample;
    }
    /// Returns true if options gave walls.
    bool has_walls() const;
    /// Returns true if there are places without samples, or without those of a class.
    bool leaves_out() const { return !face_mask.empty() || class_count > 0; }
    /// Returns false for a point of sampled() where a class has no samples.
    bool has_room(std::size_t of_class, const Sample& at) const {
        if (of_class >= class_count) {
            return true;
        }
        const std::size_t faces = sampled().face_count();
        const float* const shares = &class_shares[3 * (of_class * faces + at.face)];
        return shares[0] * at.weights[0] + shares[1] * at.weights[1] + shares[2] * at.weights[2] >
               0;
    }
    /// Returns the view of sampled() for distances through space.
    MeshView sampled_view() const {
        return split ? MeshView{split->faces.parts().positions(), split->faces.parts().triangles(),
                                file.dimension, true}
                     : MeshView{file.positions, file.triangles, file.dimension, true};
    }
    /// Coordinates of a sample: those of the file, 0 for a mesh of edge lengths without any.
    std::uint32_t dimension() const { return file.positions.empty() ? 0 : file.dimension; }
    std::span<const double> vertex(std::uint32_t face, std::uint32_t corner) const {
        const std::uint32_t v = file.triangles[std::size_t{3} * face + corner];
        return std::span(file.positions).subspan(std::size_t{v} * file.dimension, file.dimension);
    }
    /// The point of `face` with the given weights of its corners; zero beyond the dimension.
    std::array<double, 8> point(std::uint32_t face, const float (&weights)[3]) const;
    /// Returns the radius of a sample there, in mesh units, if radii vary; else 0.
    double radius(std::uint32_t face, const float (&weights)[3], double min_distance) const {
        if (!radii) {
            return 0;
        }
        const Sample at = on_sampled({face, {weights[0], weights[1], weights[2]}});
        return radii->factor_at(at.face, at.weights) * min_distance / 2;
    }
    /// The file's face that triangle `face` is of, where that is another number.
    std::optional<std::uint32_t> polygon(std::uint32_t face) const {
        return file.polygons.empty() ? std::nullopt : std::optional(file.polygons[face]);
    }
    /// Returns the normal of unit length; zero for a face without area and for a mesh that is not
    /// in space.
    Vec3 normal(std::uint32_t face) const;
    /// Returns geodisk::effective_area() for parameters of with_fields().
    double effective_area(const SampleParams& params) const {
        return known ? known->area : geodisk::effective_area(sampled(), params);
    }
    /// Returns geodisk::distance_for_count() likewise.
    double distance_for_count(const SampleParams& params, double count) const {
        return known ? geodisk::distance_for_count(known->area, known->borders, count)
                     : geodisk::distance_for_count(sampled(), params, count);
    }
    /// Returns `params` for sampled(), with the radii and the mask.
    SampleParams with_fields(SampleParams params) const {
        params.radii = radii ? &*radii : nullptr;
        params.face_mask = face_mask;
        params.class_shares = class_shares;
        if (split) {
            params.face_keys = split->faces.keys();
        }
        return params;
    }
    /// Sets position, normal and polygon of `row` by its face and weights.
    void place(SampleRow& row) const;
};

/// Returns surface_digest() of sampled() as it is written, by which changed files of walls, masks
/// and radii are noticed; "" without any of them.
std::string surface_digest_text(const MeshInput& mesh);

/// Reads and prepares a mesh. Throws UserError as read_mesh(), lifted_positions(), load_radii() and
/// load_mask(), or bad_input when the mesh is rejected. The error for samples in its place ends
/// with `hint`, unless that is "".
MeshInput load_silently(const MeshOptions& options, ProgressLine& progress,
                        const DensityOptions& density, const MaskOptions& mask,
                        const std::string& hint = "");

/// The same, and writes warnings to standard error.
MeshInput load_mesh(const MeshOptions& options, ProgressLine& progress,
                    const DensityOptions& density = {}, const MaskOptions& mask = {},
                    const std::string& hint = "give MESH SAMPLES in this order");

/// The same for who takes whole faces. Throws UserError(usage) if an image shows more of the mask
/// than corners of faces.
MeshInput load_masked_mesh(const MeshOptions& options, ProgressLine& progress,
                           const MaskOptions& mask);

/// `length` in mesh units. Throws UserError(usage) for % of a mesh that has no bounding box.
double distance_on_mesh(const Length& length, const MeshStatistics& mesh);

} // namespace geodisk::tools
