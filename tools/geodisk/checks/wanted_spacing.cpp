#include "geodisk/checks/wanted_spacing.hpp"

#include <cmath>

#include "files/samples/sample_columns.hpp"
#include "geodisk/checks/sample_checks.hpp"
#include "geodisk/checks/sample_classes.hpp"
#include "program/arguments.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

/// Returns the distance of two samples with the largest radius.
double distance_of(const VerifyOptions& options, const SampleFile& samples, const MeshInput& mesh) {
    const double given =
        options.min_distance.empty()
            ? header_distance(samples)
            : distance_on_mesh(parse_length("--min-distance", options.min_distance),
                               mesh.prepared.statistics());
    return given / mesh.distance_part;
}

/// Returns the classes that the options say, or else the header; none if a distance is given alone.
ClassTable classes_of(const VerifyOptions& options, const SampleFile& samples) {
    if (!options.classes.empty()) {
        return parse_classes(options.classes);
    }
    return options.min_distance.empty() ? classes_in_header(samples) : ClassTable{};
}

constexpr double kSame = 1e-6; // Radii that other programs rounded.

/// Returns true if a row has a radius other than the right one.
bool is_wrong(const SampleRow& row, double radius) {
    return row.radius > 0 && !(std::abs(row.radius - radius) <= kSame * radius);
}

} // namespace

WantedSpacing wanted_spacing(const VerifyOptions& options, const SampleFile& samples,
                             const MeshInput& mesh) {
    WantedSpacing spacing;
    spacing.classes = classes_of(options, samples);
    if (spacing.classes.is_given()) {
        check_classes(samples, spacing.classes.count);
        spacing.min_distance = spacing.classes.distances.empty()
                                   ? distance_of(options, samples, mesh)
                                   : spacing.classes.largest() / mesh.distance_part;
        const auto classes = samples.extra_values(kClassColumn);
        for (std::size_t i = 0; i < samples.rows.size(); ++i) {
            spacing.radii.push_back(spacing.classes.radius(classes[i], spacing.min_distance));
            spacing.wrong += is_wrong(samples.rows[i], spacing.radii.back());
        }
        return spacing;
    }
    spacing.radii_vary = mesh.radii || (has_radii(samples.rows) && options.min_distance.empty());
    spacing.is_known = spacing.radii_vary || !options.min_distance.empty() ||
                       samples.header.find("min_distance") != nullptr;
    if (!spacing.is_known) {
        return spacing;
    }
    if (mesh.radii || !spacing.radii_vary) {
        spacing.min_distance = distance_of(options, samples, mesh);
    }
    for (const SampleRow& row : samples.rows) {
        const double radius = mesh.radii ? mesh.radius(row.face, row.bary, spacing.min_distance)
                              : spacing.radii_vary ? row.radius
                                                   : spacing.min_distance / 2;
        spacing.wrong += mesh.radii && is_wrong(row, radius);
        spacing.radii.push_back(radius);
    }
    return spacing;
}

} // namespace geodisk::tools
