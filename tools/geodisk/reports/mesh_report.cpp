#include "geodisk/reports/mesh_report.hpp"

#include <optional>

#include "geodisk/reports/json.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

std::string size_text(const MeshInput& input, std::uint64_t components_without_samples) {
    const MeshStatistics& mesh = input.prepared.statistics();
    std::string text = counted(mesh.triangles, "triangle", "triangles") + ", " +
                       counted(mesh.components, "component", "components");
    if (components_without_samples > 0) {
        text += " (" + grouped(components_without_samples) + " without a sample)";
    }
    if (mesh.boundary_edges > 0) {
        text += ", " + counted(mesh.boundary_edges, "boundary edge", "boundary edges");
    }
    if (mesh.coinciding_border_edges > 0) {
        text += ", " + grouped(mesh.coinciding_border_edges) + " of them on others";
    }
    if (const auto& weld = input.file.weld) {
        text +=
            weld->joined_edges > 0
                ? ", " + grouped(weld->joined_edges) + " edges joined along seams"
                : ", " + counted(weld->merged_vertices, "vertex", "vertices") + " joined to others";
        if (weld->degenerate_faces > 0) {
            text += " and " + counted(weld->degenerate_faces, "triangle", "triangles") +
                    " dropped by it";
        }
    }
    return text + ", area " + rounded(mesh.area, 6);
}

/// Returns how many triangles the mask leaves; nothing without one.
std::optional<std::uint64_t> triangles_for_samples(const MeshInput& input) {
    if (input.known) {
        return input.known->triangles_for_samples;
    }
    if (input.face_mask.empty()) {
        return std::nullopt;
    }
    std::uint64_t count = 0;
    std::uint32_t last = ~std::uint32_t{0};
    for (std::uint32_t t = 0; t < input.face_mask.size(); ++t) {
        const std::uint32_t face = input.split ? input.split->faces.parts().parts()[t].face : t;
        if (input.face_mask[t] != 0 && face != last) { // Parts of a face follow each other.
            ++count;
            last = face;
        }
    }
    return count;
}

} // namespace

std::string mesh_lines(const std::string& label, const MeshInput& input,
                       std::uint64_t components_without_samples) {
    constexpr std::size_t kColumn = 14; // Where values begin in all summaries.
    std::string lines =
        label + std::string(kColumn - label.size(), ' ') + one_line(input.path) + '\n';
    const auto add = [&](const std::string& text) {
        lines += std::string(kColumn, ' ') + text + '\n';
    };
    for (const auto& [name, value] : input.additions) {
        add(name + ' ' + one_line(value));
    }
    add(size_text(input, components_without_samples));
    if (const auto left = triangles_for_samples(input)) {
        add("samples on " + grouped(*left) + " of the triangles only");
    }
    return lines;
}

Json mesh_json(const MeshInput& input) {
    const MeshStatistics& mesh = input.prepared.statistics();
    const std::optional<WeldCounts>& weld = input.file.weld;
    const bool has_box = mesh.diagonal > 0; // Edge lengths have none.
    Json json{{"path", input.path}};
    for (const auto& [name, value] : input.additions) {
        if (name == "lift" || name == "walls" || name == "only" || name.ends_with("mask") ||
            name == "class_density") { // There may be several.
            json[name].push_back(value);
        } else {
            json[name] = value;
        }
    }
    json.update(
        {{"vertices", mesh.vertices},
         {"triangles", mesh.triangles},
         {"polygons", input.file.polygons.empty() ? Json(nullptr) : Json(input.file.polygon_count)},
         {"merged_vertices", weld ? Json(weld->merged_vertices) : Json(nullptr)},
         {"joined_edges", weld ? Json(weld->joined_edges) : Json(0)},
         {"welded_triangles", weld ? Json(weld->degenerate_faces) : Json(nullptr)},
         {"dropped_triangles", mesh.repeated_index_faces},
         {"components", mesh.components},
         {"boundary_edges", mesh.boundary_edges},
         {"coinciding_border_edges", mesh.coinciding_border_edges},
         {"nonmanifold_edges", mesh.nonmanifold_edges},
         {"area", mesh.area},
         {"diagonal", has_box ? Json(mesh.diagonal) : Json(nullptr)}});
    if (const auto left = triangles_for_samples(input)) {
        json["triangles_for_samples"] = *left;
    }
    return json;
}

std::string avoided_text(std::size_t points, double length) {
    std::string text = points > 0 ? counted(points, "point", "points") : "";
    if (length > 0) {
        text += (text.empty() ? "" : ", ") + std::string("lines of length ") + rounded(length, 6);
    }
    return text;
}

} // namespace geodisk::tools
