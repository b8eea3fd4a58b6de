#include "ref/distance_check.hpp"
#include "lib/frame.hpp"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

namespace geodisk::test {
namespace {

struct Worst {
    double error = 0;
    double found = 0, truth = 0;
    std::size_t target = 0;
};

/// The largest difference. Within the band around the reach a target may be hit or not.
Worst worst_error(const std::vector<double>& found, const std::vector<double>& truth, double reach,
                  double band) {
    Worst worst;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const bool near_reach = std::abs(truth[i] - reach) <= band;
        const bool missed = found[i] == kUnreachable;
        if (missed && (truth[i] > reach || near_reach)) {
            continue;
        }
        const double error = std::abs(found[i] - truth[i]);
        if (!(error <= worst.error)) {
            worst = {error, found[i], truth[i], i};
        }
    }
    return worst;
}

void report(const DistanceCase& c, const char* kind, const Point& source, const Worst& worst,
            double bound) {
    const Point& target = c.targets[worst.target];
    const std::string title = c.name + ", " + kind;
    CHECK_MESSAGE(worst.error <= bound, title, ": face ", source.face, " (", source.weight1, ", ",
                  source.weight2, ") to face ", target.face, " (", target.weight1, ", ",
                  target.weight2, "): found ", worst.found, ", truth ", worst.truth, ", error ",
                  worst.error, " > ", bound);
}

/// Checks what a query in the precision and with the tolerances of a run has found.
template <class Real>
void check_documented(const DistanceCase& c, const char* kind, const PreparedMesh& mesh,
                      const GeodesicQuery<Real>& query, const Point& source,
                      const std::vector<double>& found, const std::vector<double>& truth) {
    // A chain longer than provided widens the promise, as the program does.
    const ref::Frame model = ref::frame_of(mesh, c.reach);
    const double error = std::max(model.first_error(), model.error_of(query.count().chain));
    const double bound = model.guard_for(error) * c.reach;
    report(c, kind, source, worst_error(found, truth, c.reach, 3 * bound), bound);
}

} // namespace

void check_distances(const DistanceCase& c, const Truth& truth) {
    const PreparedMesh mesh = prepared(c.mesh);
    const ref::Tolerances documented = ref::frame_of(mesh, c.reach).tolerances();
    GeodesicQuery<double> exact(mesh, c.reach, c.targets, tight_tolerances());
    GeodesicQuery<double> reference(mesh, c.reach, c.targets, documented);
    GeodesicQuery<float> twin(mesh, c.reach, c.targets, documented);
    const double bound = c.exactness * c.reach;
    for (const Point& source : c.sources) {
        std::vector<double> expected(c.targets.size());
        for (std::size_t i = 0; i < expected.size(); ++i) {
            expected[i] = truth(source, i);
        }
        report(c, "tight double", source,
               worst_error(exact.from(source), expected, c.reach, 3 * bound), bound);
        check_documented(c, "double", mesh, reference, source, reference.from(source), expected);
        check_documented(c, "float", mesh, twin, source, twin.from(source), expected);
        if (const auto found = library_distances(mesh, c.reach, source, c.targets)) {
            report(c, "the library's double", source,
                   worst_error(*found, expected, c.reach, 3 * bound), bound);
        }
        if (const auto found = exact.by_group_from(source)) {
            report(c, "tight double, by a group", source,
                   worst_error(*found, expected, c.reach, 3 * bound), bound);
        }
        if (const auto found = twin.by_group_from(source)) {
            check_documented(c, "float, by a group", mesh, twin, source, *found, expected);
        }
    }
}

void check_straight(const DistanceCase& c) {
    check_distances(c, [&](const Point& source, std::size_t i) {
        return length(c.mesh.position(c.targets[i]) - c.mesh.position(source));
    });
}

} // namespace geodisk::test
