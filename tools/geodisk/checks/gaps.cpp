#include "geodisk/checks/gaps.hpp"

#include <string>
#include <vector>

#include "geodisk/reports/json.hpp"
#include "lib/frame.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"

namespace geodisk::tools {
namespace {

constexpr std::uint32_t kFacesPerUpdate = 256;

/// Returns the radii at the corners of all faces, with `largest` the largest one; none if they do
/// not vary.
std::vector<double> corner_radii(const MeshInput& mesh, double largest) {
    std::vector<double> radii;
    if (mesh.radii) {
        for (const float g : mesh.radii->factors()) {
            radii.push_back(largest * double{g});
        }
    }
    return radii;
}

bool takes_samples(const MeshInput& mesh, std::uint32_t face) {
    const HalfEdge& edge = mesh.sampled().half_edges()[std::size_t{3} * face];
    return edge.length * edge.apex_y > 0 && (mesh.face_mask.empty() || mesh.face_mask[face] != 0);
}

} // namespace

GapCheck find_gaps(const MeshInput& mesh, std::span<const SampleRow> rows,
                   std::span<const double> radii, double min_distance,
                   std::span<const KeepOut> avoided, ProgressLine& progress) {
    SampleParams params = mesh.with_fields({});
    params.min_distance = min_distance;
    const double allowed = 1 + 2 * ref::frame_of(mesh.sampled(), params).tolerances().guard;
    ref::Surface<double> surface(mesh.sampled(), min_distance);
    const double unit = surface.frame.unit;
    surface.one_cell_each = true; // They hold no points.
    ref::CoverageCheck check(surface, corner_radii(mesh, min_distance / 2 / unit), allowed);
    progress.begin_stage("looking for gaps");
    try {
        for (std::size_t i = 0; i < rows.size(); ++i) {
            check_interrupted();
            progress.update(static_cast<double>(i) / static_cast<double>(rows.size()) / 2,
                            grouped(i) + " samples");
            const Sample at = mesh.sampled_of(rows[i]);
            check.add_sample({at.face, at.weights[1], at.weights[2]}, radii[i] / unit);
        }
        for (const auto& [center, radius] : avoided) {
            check_interrupted();
            check.add_avoided({center.face, center.weights[1], center.weights[2]}, radius / unit);
        }
    } catch (const ref::EndlessDisk& error) {
        throw UserError(ExitCode::bad_input, error.what());
    }
    check.sort();
    const std::uint32_t faces = mesh.sampled().face_count();
    for (std::uint32_t face = 0; face < faces; ++face) {
        if (face % kFacesPerUpdate == 0) {
            check_interrupted();
            progress.update(0.5 + 0.5 * face / faces, grouped(face) + " triangles");
        }
        if (takes_samples(mesh, face)) {
            check.test(face);
        }
    }
    progress.clear();
    return {check.result(), allowed, min_distance * mesh.distance_part, mesh.radii.has_value()};
}

std::string uncovered_text(const GapCheck& gaps, const MeshInput& mesh) {
    const auto& [part, weight1, weight2] = *gaps.found.uncovered;
    const auto [face, weights] =
        mesh.in_file({part,
                      {static_cast<float>(1 - weight1 - weight2), static_cast<float>(weight1),
                       static_cast<float>(weight2)}});
    std::string text = "triangle " + std::to_string(face) + ", weights";
    for (const float weight : weights) {
        text += ' ' + rounded(double{weight}, 6);
    }
    const auto at = mesh.point(face, weights);
    for (std::uint32_t axis = 0; axis < mesh.dimension(); ++axis) {
        text += (axis == 0 ? ", position " : " ") + rounded(at[axis], 6);
    }
    return text;
}

std::string gap_text(const GapCheck& gaps, const MeshInput& mesh) {
    const ref::Coverage& found = gaps.found;
    const std::string size = gaps.radii_vary
                                 ? rounded(found.largest, 6) + " of the sum of two radii"
                                 : rounded(found.largest * gaps.distance, 6);
    return (found.is_beyond ? "more than " : "") + size +
           (gaps.is_maximal() ? ", every point is covered" : ", in " + uncovered_text(gaps, mesh));
}

Json gap_json(const std::optional<GapCheck>& gaps) {
    if (!gaps) {
        return nullptr;
    }
    const auto& [found, allowed, distance, radii_vary] = *gaps;
    Json point = nullptr;
    if (found.uncovered) {
        point = {{"face", found.uncovered->face},
                 {"weights",
                  {1 - found.uncovered->weight1 - found.uncovered->weight2,
                   found.uncovered->weight1, found.uncovered->weight2}}};
    }
    return {{"certificate", !found.uncovered.has_value()},
            {"largest_gap", radii_vary ? Json(nullptr) : Json(found.largest * distance)},
            {"largest_ratio", found.largest},
            {"allowed_ratio", allowed},
            {"is_beyond", found.is_beyond},
            {"cells", found.cells},
            {"uncovered", std::move(point)}};
}

} // namespace geodisk::tools
