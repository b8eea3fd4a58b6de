#include "geodisk/reports/verify_report.hpp"

#include <algorithm>
#include <sstream>
#include <utility>

#include <geodisk/params.hpp>
#include <geodisk/version.hpp>

#include "files/samples/sample_columns.hpp"
#include "geodisk/reports/json.hpp"
#include "geodisk/reports/mesh_report.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr std::size_t kNamedStrays = 10;

std::string smallest_text(const SampleCheck& check) {
    const SpacingResult& result = check.result;
    if (!check.spacing.is_known) {
        return closest_text(result.closest);
    }
    if (check.spacing.radii_vary || check.spacing.classes.is_given()) {
        return (result.closest ? rounded(result.closest->ratio, 9)
                               : "> " + rounded(result.cut, 6)) +
               (check.spacing.radii_vary ? " of the sum of two radii"
                                         : " of the distance of two classes");
    }
    return smallest_text(result, check.spacing.min_distance);
}

/// The first `known` points are those of files, the others lie along lines.
Json intrusions_json(const std::vector<Intrusion>& intrusions, std::size_t known) {
    Json rows = Json::array(), points = Json::array(), distances = Json::array();
    for (const Intrusion& one : intrusions) {
        rows.push_back(one.row);
        points.push_back(one.point < known ? Json(one.point) : Json(nullptr));
        distances.push_back(one.distance);
    }
    return {{"count", intrusions.size()},
            {"rows", std::move(rows)},
            {"points", std::move(points)},
            {"distances", std::move(distances)}};
}

} // namespace

std::size_t SampleCheck::existing() const {
    const auto values = samples.extra_values(kExistingColumn);
    return static_cast<std::size_t>(std::ranges::count_if(values, [](auto v) { return v != 0; }));
}

double SampleCheck::rho() const {
    SampleParams params = mesh.with_fields({});
    const std::vector<float> factors = spacing.classes.factors();
    params.class_factors = factors;
    return packing_density(mesh.effective_area(params), spacing.min_distance,
                           static_cast<double>(samples.rows.size()));
}

std::vector<std::size_t> SampleCheck::class_counts() const {
    std::vector<std::size_t> counts(spacing.classes.count);
    const auto values = samples.extra_values(kClassColumn);
    for (std::size_t i = 0; i < values.size() && !counts.empty(); ++i) {
        ++counts[values[i]];
    }
    return counts;
}

std::string SampleCheck::min_text() const {
    return spacing.classes.is_given() ? "the distance of their classes"
           : spacing.radii_vary       ? "the sum of their radii"
                                      : rounded(spacing.min_distance, 9);
}

std::string report_text(const SampleCheck& check) {
    const WantedSpacing& spacing = check.spacing;
    const std::vector<StrayRow>& strays = check.strays;
    std::ostringstream out;
    out << mesh_lines("mesh", check.mesh) << "samples       " << grouped(check.samples.rows.size())
        << " in " << one_line(check.options.samples) << '\n';
    if (spacing.min_distance > 0) {
        out << "min distance  " << rounded(spacing.min_distance * check.mesh.distance_part, 9)
            << " in mesh units\n"
            << "rho           " << rounded(check.rho(), 3) << '\n';
    }
    if (spacing.radii_vary && !spacing.radii.empty()) {
        const auto [least, most] = std::minmax_element(spacing.radii.begin(), spacing.radii.end());
        out << "radii         " << rounded(*least, 9) << " to " << rounded(*most, 9)
            << (check.mesh.radii ? "" : ", as the file has them") << '\n';
    }
    out << "smallest      " << smallest_text(check)
        << (spacing.is_known && check.existing() > 1 ? ", pairs of existing samples aside\n"
                                                     : "\n");
    if (spacing.classes.is_given()) {
        std::string counts;
        for (const std::size_t count : check.class_counts()) {
            counts += (counts.empty() ? "" : ", ") + grouped(count);
        }
        out << "classes       " << counts << " samples\n";
    }
    const bool has_ratios = spacing.radii_vary || spacing.classes.is_given();
    if (spacing.is_known) {
        print_violations(out, check.samples, check.result, has_ratios ? check.min_text() : "");
    }
    out << level_lines(check.levels, check.existing() > 1);
    if (const std::size_t existing = check.existing(); existing > 0) {
        const SpacingResult& pairs = check.among_existing;
        out << "existing      " << grouped(existing) << " of them"
            << (pairs.violations.empty()
                    ? ""
                    : "; " + pairs.pairs_text() + " among these too close, no violation")
            << '\n';
    }
    if (check.avoids()) {
        out << "avoided       " << avoided_text(check.avoided, check.avoided_length) << "; "
            << counted(check.intrusions.size(), "sample", "samples") << " within the radii\n";
    }
    for (std::size_t i = 0; i < std::min(check.intrusions.size(), kNamedStrays); ++i) {
        const Intrusion& one = check.intrusions[i];
        out << "              "
            << "sample " << one.row << ": " << rounded(one.distance, 9) << " from "
            << (one.point < check.avoided ? "point " + std::to_string(one.point) : "a line")
            << '\n';
    }
    if (check.gaps) {
        out << "largest gap   " << gap_text(*check.gaps, check.mesh) << '\n';
    }
    if (spacing.wrong > 0) {
        out << "wrong radii   " << grouped(spacing.wrong) << '\n';
    }
    if (!check.wrong_features.empty()) {
        out << "features      " << grouped(check.wrong_features.size())
            << " with a wrong mark, first sample " << check.wrong_features.front() << '\n';
    }
    if (!check.masked.empty()) {
        out << "masked        " << grouped(check.masked.size()) << " on faces that "
            << check.options.mask.names() << " left out, first sample " << check.masked.front()
            << '\n';
    }
    if (!strays.empty()) {
        out << "off the mesh  " << grouped(strays.size()) << '\n';
    }
    for (std::size_t i = 0; i < std::min(strays.size(), kNamedStrays); ++i) {
        out << "              "
            << "sample " << strays[i].row << ": "
            << (check.samples.has_faces ? offset_text(strays[i])
                                        : rounded(strays[i].offset, 3) + " away from the surface")
            << '\n';
    }
    return out.str();
}

std::string report_json(const SampleCheck& check) {
    const auto& [options, samples, mesh, warnings, spacing, strays, result, among_existing, masked,
                 avoided, avoided_length, intrusions, gaps, levels, features] = check;
    const std::size_t existing = check.existing();
    const bool has_distance = spacing.min_distance > 0;
    return text_of(Json{
        {"version", GEODISK_VERSION_STRING},
        {"mesh", mesh_json(mesh)},
        {"warnings", warnings_json(warnings)},
        {"samples_file", options.samples},
        {"samples", samples.rows.size()},
        {"min_distance",
         has_distance ? Json(spacing.min_distance * check.mesh.distance_part) : Json(nullptr)},
        {"rho", has_distance ? Json(check.rho()) : Json(nullptr)},
        {"radii_vary", spacing.radii_vary},
        {"classes", spacing.classes.is_given() ? Json(check.class_counts()) : Json(nullptr)},
        {"cut", spacing.radii_vary || !spacing.is_known ? Json(nullptr)
                                                        : Json(result.cut * spacing.min_distance)},
        {"smallest", pair_json(result.closest)},
        {"smallest_ratio",
         result.closest && spacing.is_known ? Json(result.closest->ratio) : Json(nullptr)},
        {"violations", spacing.is_known ? violations_json(result) : Json(nullptr)},
        {"existing", existing == 0 ? Json(nullptr)
                                   : Json{{"samples", existing},
                                          {"violations", violations_json(among_existing)}}},
        {"avoided", check.avoids() ? Json{{"points", avoided},
                                          {"length", avoided_length},
                                          {"intrusions", intrusions_json(intrusions, avoided)}}
                                   : Json(nullptr)},
        {"maximal", gap_json(gaps)},
        {"levels", levels_json(levels)},
        {"wrong_radii", spacing.wrong},
        {"wrong_features", features.size()},
        {"masked", mesh.leaves_out() ? Json(masked.size()) : Json(nullptr)},
        {"off_the_mesh", strays.size()}});
}

std::string fault_text(const SampleCheck& check) {
    const WantedSpacing& spacing = check.spacing;
    std::string message = violation_text(check.result, check.min_text());
    const auto add = [&message](std::size_t count, const std::string& one, const std::string& many,
                                const char* what) {
        if (count > 0) {
            message += (message.empty() ? "" : ", and ") + counted(count, one, many) + what;
        }
    };
    if (const std::string fault = level_fault(check.levels);
        !fault.empty() && check.result.violations.empty()) {
        message = fault;
    }
    if (check.samples.has_faces) {
        add(check.strays.size(), "position does", "positions do",
            " not agree with face and weights");
    } else {
        add(check.strays.size(), "point lies", "points lie",
            " farther off the mesh than --tolerance allows");
    }
    add(check.intrusions.size(), "sample is", "samples are",
        " within the radius of a point or line to avoid");
    add(spacing.wrong, "radius is", "radii are",
        spacing.classes.is_given() ? " not that of the class"
                                   : " not what the density options give");
    add(check.wrong_features.size(), "sample has", "samples have",
        " a wrong mark in the column feature");
    add(check.masked.size(), "sample is", "samples are",
        (" on faces that " + check.options.mask.names() + " left out").c_str());
    if (check.gaps && !check.gaps->is_maximal()) {
        message += (message.empty() ? "" : ", and ") +
                   std::string("the set is not maximal, a sample fits in ") +
                   uncovered_text(*check.gaps, check.mesh);
    }
    if (!check.strays.empty() && !check.samples.has_faces) {
        message += ". Give the mesh that the points were made on, or raise --tolerance";
    }
    return message;
}

} // namespace geodisk::tools
