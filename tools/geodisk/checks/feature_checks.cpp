#include "geodisk/checks/feature_checks.hpp"

#include <algorithm>
#include <optional>
#include <span>

#include <geodisk/features.hpp>

#include "files/samples/sample_columns.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

Features features_in(const std::string& path, const std::string& text, const MeshInput& mesh) {
    const std::optional<double> angle = parse_real(text);
    if (!angle || !(*angle >= 1 && *angle <= 180)) {
        fail_input(path, "its header has features of " + in_quotes(text) +
                             ", not an angle of 1 to 180 degrees");
    }
    const MeshView view{mesh.file.positions, mesh.file.triangles, mesh.file.dimension};
    return take(Features::find(view, mesh.prepared, *angle));
}

/// Tells where samples lie among the features of a mesh.
class FeaturePlaces {
  public:
    FeaturePlaces(const Features& features, const PreparedMesh& mesh)
        : edges_(mesh.half_edges()), on_curve_(edges_.size()), at_curve_(mesh.fans().size()) {
        for (const std::uint32_t first : features.edges()) {
            std::uint32_t h = first;
            do {
                on_curve_[h] = true;
                at_curve_[edges_[h].origin] = true;
                at_curve_[edges_[next_in_face(h)].origin] = true;
                h = around_half_edge(edges_[h].around);
            } while (h != first);
        }
    }

    FeatureKind of(const SampleRow& row) const {
        const Sample sample = sample_of(row);
        const std::uint32_t corner = 3 * row.face;
        const FeatureKind kind = feature_of(sample);
        if (kind == FeatureKind::corner) {
            const auto k = static_cast<std::uint32_t>(std::ranges::max_element(sample.weights) -
                                                      sample.weights);
            return at_curve_[edges_[corner + k].origin] ? kind : FeatureKind::face;
        }
        if (kind == FeatureKind::curve) { // Opposite of the corner without weight.
            const auto k = static_cast<std::uint32_t>(std::ranges::min_element(sample.weights) -
                                                      sample.weights);
            return on_curve_[corner + (k + 1) % 3] ? kind : FeatureKind::face;
        }
        return kind;
    }

  private:
    std::span<const HalfEdge> edges_;
    std::vector<bool> on_curve_, at_curve_; ///< Indexed by half-edge and by vertex.
};

} // namespace

std::vector<std::uint32_t> wrong_features(const SampleFile& samples, const MeshInput& mesh) {
    std::vector<std::uint32_t> wrong;
    const std::string* const text = samples.header.find("features");
    const auto marks = samples.extra_values(kFeatureColumn);
    if (text == nullptr || marks.size() != samples.rows.size() || !samples.has_faces ||
        mesh.dimension() == 0) {
        return wrong;
    }
    const FeaturePlaces places(features_in(samples.path, *text, mesh), mesh.prepared);
    const auto existing = samples.extra_values(kExistingColumn);
    bool marks_follow = false;
    for (std::size_t i = samples.rows.size(); i-- > 0;) {
        if (!existing.empty() && existing[i] != 0) {
            continue;
        }
        const FeatureKind kind = places.of(samples.rows[i]);
        // A dart on a face may end on a curve by chance.
        const bool may_be_unmarked =
            kind == FeatureKind::face || (kind == FeatureKind::curve && !marks_follow);
        if (marks[i] != static_cast<std::uint32_t>(kind) && !(marks[i] == 0 && may_be_unmarked)) {
            wrong.push_back(static_cast<std::uint32_t>(i));
        }
        marks_follow = marks_follow || marks[i] != 0;
    }
    std::ranges::reverse(wrong);
    return wrong;
}

} // namespace geodisk::tools
