#include "geodisk/reports/cell_report.hpp"

#include <algorithm>
#include <sstream>

#include <geodisk/version.hpp>

#include "geodisk/reports/json.hpp"
#include "geodisk/reports/mesh_report.hpp"
#include "geodisk/reports/run_report.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

double manifold_part(const DualReport& dual) {
    return dual.triangles == 0
               ? 1
               : static_cast<double>(dual.manifold) / static_cast<double>(dual.triangles);
}

Json angles_json(const CellReport& report) {
    const TriangleAngles& angles = report.result.angles;
    if (report.result.points.empty() || report.result.cells.triangles.empty()) {
        return nullptr;
    }
    return {{"least", angles.least},
            {"largest", angles.largest},
            {"part_30_to_120", angles.part_inside}};
}

Json dual_json(const CellReport& report) {
    if (report.dual.empty()) {
        return nullptr;
    }
    const DualReport& dual = report.result.cells.dual;
    return {{"file", report.dual},
            {"vertices", dual.vertices},
            {"edges", dual.edges},
            {"triangles", dual.triangles},
            {"manifold_triangles", dual.manifold},
            {"euler", dual.euler},
            {"mesh_euler", dual.mesh_euler},
            {"angles", angles_json(report)}};
}

std::string dual_lines(const CellReport& report) {
    const DualReport& dual = report.result.cells.dual;
    std::ostringstream out;
    out << "dual          " << counted(dual.triangles, "triangle", "triangles") << ", "
        << rounded(100 * manifold_part(dual), 4) << "% manifold; Euler characteristic "
        << dual.euler << ", of the mesh " << dual.mesh_euler << '\n';
    if (!angles_json(report).is_null()) {
        const TriangleAngles& angles = report.result.angles;
        out << "angles        " << rounded(angles.least, 3) << " to " << rounded(angles.largest, 3)
            << " degrees; " << rounded(100 * angles.part_inside, 4)
            << "% of the triangles within 30 to 120\n";
    }
    out << "dual file     " << one_line(report.dual) << '\n';
    return out.str();
}

} // namespace

std::string CellReport::json(double write_seconds) const {
    const SurfaceCells& cells = result.cells;
    const auto [least, largest] = std::ranges::minmax(cells.areas);
    Json document{{"version", GEODISK_VERSION_STRING},
                  {"mesh", mesh_json(mesh)},
                  {"warnings", warnings_json(warnings)},
                  {"samples", cells.areas.size()},
                  {"areas",
                   {{"least", least},
                    {"largest", largest},
                    {"error", cells.area_error},
                    {"unreached", cells.unreached}}},
                  {"error", cells.distance_error},
                  {"dual", dual_json(*this)},
                  {"labels", labels.empty() ? Json() : Json(labels)},
                  {"split", split.empty() ? Json(nullptr) : Json(split)},
                  {"outlines", outlines.empty() ? Json(nullptr) : Json(outlines)},
                  {"disks", cells.report.disks},
                  {"windows", cells.report.windows},
                  {"scene", scene_json(scene)},
                  {"output", output}};
    return search_json(std::move(document), mesh, result.done, write_seconds);
}

std::string CellReport::summary(double write_seconds) const {
    const SurfaceCells& cells = result.cells;
    const auto [least, largest] = std::ranges::minmax(cells.areas);
    std::ostringstream out;
    out << mesh_lines("mesh", mesh) << "cells         " << grouped(cells.areas.size())
        << ", with areas from " << rounded(least, 4) << " to " << rounded(largest, 4)
        << ", exact to " << rounded(cells.area_error, 2) << '\n';
    if (cells.unreached > 0) {
        out << "no sample     in parts of the mesh with an area of " << rounded(cells.unreached, 4)
            << '\n';
    }
    if (!dual.empty()) {
        out << dual_lines(*this);
    }
    if (!labels.empty()) {
        out << "labels file   " << one_line(labels) << '\n';
    }
    if (!split.empty()) {
        out << "split mesh    " << one_line(split) << '\n';
    }
    if (!outlines.empty()) {
        out << "outlines      " << one_line(outlines) << '\n';
    }
    out << search_text(mesh, result.done, write_seconds, output, "finding cells")
        << scene_line(scene);
    return out.str();
}

} // namespace geodisk::tools
