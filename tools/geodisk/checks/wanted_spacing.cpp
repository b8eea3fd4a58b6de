#include "geodisk/checks/wanted_spacing.hpp"

#include <cmath>
#include <string>

#include "files/sample_columns.hpp"
#include "geodisk/checks/sample_checks.hpp"
#include "program/arguments.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

/// Of two samples with the largest radius.
double distance_of(const VerifyOptions& options, const SampleFile& samples, const MeshInput& mesh) {
    const double given =
        options.min_distance.empty()
            ? header_distance(options.samples, samples.header)
            : distance_on_mesh(parse_length("--min-distance", options.min_distance),
                               mesh.prepared.statistics());
    return given / mesh.distance_part;
}

/// Returns the classes that the options say, or else the header; none if a distance is given alone.
ClassTable classes_of(const VerifyOptions& options, const SampleFile& samples) {
    if (!options.classes.empty()) {
        return parse_classes(options.classes);
    }
    const std::string* const entry = samples.header.find("classes");
    if (entry == nullptr || !options.min_distance.empty()) {
        return {};
    }
    if (names_class_file(*entry)) {
        fail_input(options.samples, "its header has the classes " + in_quotes(*entry) +
                                        ", which are none; give --classes");
    }
    return parse_classes(*entry);
}

/// Checks that every sample has one of the classes.
void check_classes(const std::string& path, const SampleFile& samples, std::size_t count) {
    const auto values = samples.extra_values(kClassColumn);
    if (values.size() != samples.rows.size()) {
        fail_input(path, "has no column class, so its classes cannot be verified; give "
                         "--min-distance to check one distance for all");
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (values[i] >= count) {
            fail_input(path, "sample " + std::to_string(i) + ": its class is " +
                                 std::to_string(values[i]) + ", but there are " +
                                 std::to_string(count) + ", numbered from 0");
        }
    }
}

} // namespace

WantedSpacing wanted_spacing(const VerifyOptions& options, const SampleFile& samples,
                             const MeshInput& mesh) {
    WantedSpacing spacing;
    spacing.classes = classes_of(options, samples);
    if (spacing.classes.is_given()) {
        check_classes(options.samples, samples, spacing.classes.count);
        spacing.min_distance = spacing.classes.distances.empty()
                                   ? distance_of(options, samples, mesh)
                                   : spacing.classes.largest() / mesh.distance_part;
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
    constexpr double kSame = 1e-6; // Of radii that other programs rounded.
    for (const SampleRow& row : samples.rows) {
        const double radius = mesh.radii ? mesh.radius(row.face, row.bary, spacing.min_distance)
                              : spacing.radii_vary ? row.radius
                                                   : spacing.min_distance / 2;
        if (mesh.radii && row.radius > 0 && !(std::abs(row.radius - radius) <= kSame * radius)) {
            ++spacing.wrong;
        }
        spacing.radii.push_back(radius);
    }
    return spacing;
}

} // namespace geodisk::tools
