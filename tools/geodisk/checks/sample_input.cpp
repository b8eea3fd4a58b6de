#include "geodisk/checks/sample_input.hpp"

#include <algorithm>
#include <utility>

#include "files/meshes/line_file.hpp"
#include "files/samples/sample_columns.hpp"
#include "geodisk/options/distance_options.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geometry/nearest_face.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"

namespace geodisk::tools {
namespace {

void put_on(SampleRow& row, const SurfacePoint& place, const MeshInput& mesh) {
    row.face = place.face;
    for (std::size_t corner = 0; corner < 3; ++corner) {
        row.bary[corner] = static_cast<float>(place.weights[corner]);
    }
    mesh.place(row);
}

/// Distances that points were moved by.
struct Moves {
    std::size_t count = 0;
    double farthest = 0, sum = 0;

    void add(double distance) {
        ++count;
        farthest = std::max(farthest, distance);
        sum += distance;
    }
    double mean() const { return sum / static_cast<double>(count); }
};

void warn_of_moves(const SampleFile& samples, const MeshInput& mesh, const Moves& moves,
                   double tolerance, std::vector<MeshWarning>& warnings) {
    warnings.push_back({"points_moved", moves.count, "",
                        counted(moves.count, "point", "points") + " without faces put on the " +
                            "nearest face of " + mesh.path + ", from up to " +
                            rounded(moves.farthest, 3) + " away, " + rounded(moves.mean(), 3) +
                            " on average (tolerance " + rounded(tolerance, 3) + ")",
                        samples.path});
}

/// Gives each point the nearest face. Returns those that are too far away.
std::vector<StrayRow> put_on_faces(const MeshInput& mesh, const std::string& given,
                                   SampleFile& samples, std::vector<MeshWarning>& warnings,
                                   ProgressLine& progress) {
    progress.begin_stage("projecting the points onto the mesh");
    const NearestFace faces(mesh.file);
    const double tolerance = tolerance_on(given, faces.diagonal());
    std::vector<StrayRow> strays;
    Moves moves;
    for (std::uint32_t i = 0; i < samples.rows.size(); ++i) {
        if (i % 1024 == 0) {
            check_interrupted();
            progress.update(i / static_cast<double>(samples.rows.size()), "");
        }
        SampleRow& row = samples.rows[i];
        const SurfacePoint place = faces.find(std::span(row.position).first(mesh.dimension()));
        if (place.distance <= tolerance) {
            moves.add(place.distance);
        } else {
            strays.push_back({i, place.distance});
        }
        put_on(row, place, mesh);
    }
    progress.clear();
    if (moves.count > 0) {
        warn_of_moves(samples, mesh, moves, tolerance, warnings);
    }
    return strays;
}

/// Checks that columns hold what the header says. Warns of those that it does not name.
void check_columns(const SampleFile& samples, const std::string& noun,
                   std::vector<MeshWarning>& warnings) {
    for (const auto& [name, row] : samples.wrong_columns) {
        const std::string_view key = key_of_column(name);
        std::string fault = noun + " " + std::to_string(row) + " has no " +
                            (largest_in_column(name) == 1 ? "0 or 1" : "whole number") +
                            " in the column ";
        fault += name;
        if (!key.empty() && samples.header.find(key) != nullptr) {
            fail_input(samples.path, fault);
        }
        if (!key.empty()) {
            warnings.push_back(
                {"wrong_column", 1, "", "ignoring the column: " + fault, samples.path});
        }
    }
}

/// As read_samples_on(), but prints nothing.
SampleInput read_silently(const std::string& path, const MeshInput& mesh,
                          const std::string& tolerance, std::vector<MeshWarning>& warnings,
                          ProgressLine& progress, const ReadAs& as) {
    progress.begin_stage("reading the samples");
    SampleInput input{as.has_lines ? read_points_and_lines(path, as.numbers, as.allows_outside)
                                   : read_samples(path, as.numbers),
                      {}};
    input.file.path = path;
    progress.clear();
    put_on_mesh(mesh, tolerance, input, warnings, progress, as);
    return input;
}

} // namespace

void put_on_mesh(const MeshInput& mesh, const std::string& tolerance, SampleInput& input,
                 std::vector<MeshWarning>& warnings, ProgressLine& progress, const ReadAs& as) {
    for (MeshWarning& warning : input.file.warnings) {
        warning.file = input.file.path;
        warnings.push_back(std::move(warning));
    }
    input.file.warnings.clear();
    check_columns(input.file, as.noun, warnings);
    if (const std::string other = other_sampling_text(input.file.header); !other.empty()) {
        warnings.push_back({"other_sampling", 1, "", other, input.file.path});
    }
    check_dimensions(input.file, mesh);
    if (!input.file.has_faces) {
        input.strays = put_on_faces(mesh, tolerance, input.file, warnings, progress);
        return;
    }
    check_rows(input.file, mesh, as.noun);
    if (as.compares_surface && !input.file.header.entries.empty()) {
        warn_of_other_surface(input.file, mesh, warnings);
    }
    input.strays = find_strays(input.file, mesh);
}

SampleFile without_strays(const MeshInput& mesh, SampleInput input, const ReadAs& as) {
    if (input.strays.empty()) {
        return std::move(input.file);
    }
    const StrayRow& first = input.strays.front();
    const std::string sample = as.noun + " " + std::to_string(first.row) + " is ";
    if (input.file.has_faces) {
        fail_input(input.file.path, sample + offset_text(first) + " on " + mesh.path +
                                        "; are these " + as.noun + "s of another mesh?");
    }
    fail_input(input.file.path,
               counted(input.strays.size(), "point lies", "points lie") + " farther off " +
                   mesh.path + " than --tolerance allows; " + sample + rounded(first.offset, 3) +
                   " away. Give the mesh that the points were made on, or raise --tolerance" +
                   (mesh.has_walls() ? "; faces that are walls take no points" : ""));
}

SampleInput read_samples_on(const std::string& path, const MeshInput& mesh,
                            const std::string& tolerance, std::vector<MeshWarning>& warnings,
                            ProgressLine& progress, const ReadAs& as) {
    std::vector<MeshWarning> found;
    SampleInput input = read_silently(path, mesh, tolerance, found, progress, as);
    print_warnings(found);
    warnings.insert(warnings.end(), found.begin(), found.end());
    return input;
}

void warn_of_no_samples(const SampleFile& file, std::vector<MeshWarning>& warnings) {
    if (file.rows.empty()) {
        warnings.push_back({"no_samples", 1, "", "has no samples", file.path});
        print_warning(file.path + ": " + warnings.back().message);
    }
}

SampleFile read_samples_exactly_on(const std::string& path, const MeshInput& mesh,
                                   const std::string& tolerance, std::vector<MeshWarning>& warnings,
                                   ProgressLine& progress, const ReadAs& as) {
    return without_strays(mesh, read_samples_on(path, mesh, tolerance, warnings, progress, as), as);
}

SampleFile read_samples_silently_on(const std::string& path, const MeshInput& mesh,
                                    const std::string& tolerance,
                                    std::vector<MeshWarning>& warnings, ProgressLine& progress,
                                    const ReadAs& as) {
    return without_strays(mesh, read_silently(path, mesh, tolerance, warnings, progress, as), as);
}

} // namespace geodisk::tools
