// A surface that tests edit, and whose samples follow.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include <geodisk/update.hpp>

#include "device_run.hpp"
#include "sets.hpp"
#include "support/meshes.hpp"
#include "support/radius_fields.hpp"

namespace geodisk::test {

/// The runner of all tests here.
inline Runner& runner() {
    static Runner made =
        expect(Runner::create(shared_context().device(), shared_context().queue()));
    return made;
}

inline Points points_of(std::span<const Sample> samples) {
    SampleSet set;
    set.samples.assign(samples.begin(), samples.end());
    return test::points_of(set);
}

/// A surface that is edited, and its samples.
class Scene {
  public:
    Scene(TestMesh shape, double count, std::uint64_t seed, double least = 1,
          bool has_density = false)
        : mesh(std::move(shape)), random(static_cast<std::uint32_t>(seed)),
          factors(mesh.vertex_count(), 1.0), min_factor(least), by_density(has_density) {
        if (min_factor < 1) {
            factors = wavy_factors(mesh, min_factor);
        }
        const PreparedMesh surface = prepare();
        params.seed = seed;
        params.min_distance = distance_for_count(effective_area(surface, params), count);
    }

    Scene(Scene&&) = default;

    /// Samples the surface as it is, and begins to follow it.
    void begin() {
        const PreparedMesh surface = prepare();
        const JobFrame frame = expect(frame_of(surface, params));
        const SampleSet set = expect(runner().sample_and_wait(surface, params));
        updater.emplace(expect(Updater::create(mesh.view(), params, frame, set.samples)));
        CHECK(decide_alike(updater->frame(), frame));
        CHECK(points_of(updater->samples()) == test::points_of(set));
    }

    /// Follows an edit as follow(), and also by an updater of the surfaces before and after. `edit`
    /// changes the scene and returns the faces that it changes.
    template <class Edit>
    UpdateReport follow_both(const Edit& edit) {
        const Scene before(*this);
        const std::vector<std::uint32_t> changed = edit();
        prepare();
        const auto own = updater->samples();
        auto other =
            expect(Updater::create({before.mesh.view(), before.job()}, {mesh.view(), params},
                                   updater->frame(), std::vector(own.begin(), own.end())));
        expect(other.update(runner(), mesh.view(), params, {}));
        const UpdateReport report = follow(changed);
        CHECK(points_of(other.samples()) == points_of(updater->samples()));
        CHECK(other.frame() == updater->frame());
        return report;
    }

    /// Follows an edit of some faces, and checks the samples against whole runs.
    UpdateReport follow(const std::vector<std::uint32_t>& changed) {
        const PreparedMesh surface = prepare();
        const UpdateReport report = expect(updater->update(runner(), mesh.view(), params, changed));
        const Points points = points_of(updater->samples());
        const Domain whole = expect(Domain::surface(surface, params, updater->frame()));
        CHECK(points == test::points_of(expect(runner().sample_and_wait(whole))));
        if (++edits % 5 == 0) { // In its own frame as well: steps of tolerances are the same.
            CHECK(points == test::points_of(expect(runner().sample_and_wait(surface, params))));
        }
        return report;
    }

    std::uint32_t below(std::uint32_t end) {
        return static_cast<std::uint32_t>(std::uint64_t{random()} * end >> 32);
    }
    double part() { return static_cast<double>(random()) * 0x1p-32; }

    std::vector<std::uint32_t> faces_at(std::uint32_t vertex) const {
        std::vector<std::uint32_t> faces;
        for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
            if (mesh.triangles[i] == vertex && (faces.empty() || faces.back() != i / 3)) {
                faces.push_back(i / 3);
            }
        }
        return faces;
    }
    /// Returns the faces near a random place.
    std::vector<std::uint32_t> stroke(double radius) {
        const Vec3 center = mesh.vertex(mesh.triangles[3 * below(mesh.face_count())]);
        std::vector<std::uint32_t> faces;
        for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
            const Vec3 corner = mesh.corner(f, 0);
            if (std::hypot(corner.x - center.x, corner.y - center.y, corner.z - center.z) <
                radius) {
                faces.push_back(f);
            }
        }
        return faces;
    }

    // Edits. Each returns the faces that it changes.

    std::vector<std::uint32_t> move_vertex(double by) {
        const std::uint32_t vertex = mesh.triangles[below(3 * mesh.face_count())];
        for (std::size_t axis = 0; axis < mesh.dimension; ++axis) {
            mesh.positions[mesh.dimension * vertex + axis] += by * (2 * part() - 1);
        }
        return faces_at(vertex);
    }
    std::vector<std::uint32_t> remove_face() {
        const std::uint32_t face = below(mesh.face_count());
        mesh.triangles[3 * face + 1] = mesh.triangles[3 * face];
        return {face};
    }
    std::vector<std::uint32_t> split_face() {
        const std::uint32_t face = below(mesh.face_count());
        const std::uint32_t a = mesh.triangles[3 * face], b = mesh.triangles[3 * face + 1],
                            c = mesh.triangles[3 * face + 2];
        const auto center = mesh.vertex_count();
        for (std::size_t axis = 0; axis < mesh.dimension; ++axis) {
            mesh.positions.push_back((mesh.positions[mesh.dimension * a + axis] +
                                      mesh.positions[mesh.dimension * b + axis] +
                                      mesh.positions[mesh.dimension * c + axis]) /
                                     3);
        }
        factors.push_back(factors[a]);
        mesh.triangles[3 * face + 2] = center;
        mesh.add_triangle(b, c, center);
        mesh.add_triangle(c, a, center);
        add_to_fields(2);
        return {face};
    }
    std::vector<std::uint32_t> mask_stroke(double radius) {
        mask.resize(mesh.face_count(), 1);
        const auto faces = stroke(radius);
        const auto takes = static_cast<std::uint8_t>(below(2));
        for (const std::uint32_t face : faces) {
            mask[face] = takes;
        }
        return faces;
    }
    std::vector<std::uint32_t> radius_stroke(double radius) {
        std::vector<bool> is_changed(mesh.vertex_count(), false);
        const double factor = min_factor + (1 - min_factor) * std::pow(part(), 2);
        for (const std::uint32_t face : stroke(radius)) {
            is_changed[mesh.triangles[3 * face]] = true;
            factors[mesh.triangles[3 * face]] = factor;
        }
        std::vector<std::uint32_t> changed;
        for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
            if (is_changed[mesh.triangles[i]]) {
                changed.push_back(i / 3);
            }
        }
        return changed;
    }
    /// Appends a copy of a face.
    std::vector<std::uint32_t> copy_face() {
        const std::uint32_t face = below(mesh.face_count());
        const std::uint32_t* const c = &mesh.triangles[3 * face];
        mesh.add_triangle(c[0], c[1], c[2]);
        add_to_fields(1);
        return {};
    }
    /// Appends a face at an edge, which may have two already. It reaches this far.
    std::vector<std::uint32_t> add_flap(double height) {
        const std::uint32_t face = below(mesh.face_count());
        const std::uint32_t a = mesh.triangles[3 * face], b = mesh.triangles[3 * face + 1];
        const Vec3 from = mesh.vertex(a), to = mesh.vertex(b);
        add_vertex({(from.x + to.x) / 2, (from.y + to.y) / 2, (from.z + to.z) / 2 + height}, a);
        mesh.add_triangle(a, b, mesh.vertex_count() - 1);
        add_to_fields(1);
        return {};
    }
    /// Splits a face at a point of an edge, and fills the slit with a flat triangle.
    std::vector<std::uint32_t> add_cap() {
        const std::uint32_t face = below(mesh.face_count());
        const std::uint32_t a = mesh.triangles[3 * face], b = mesh.triangles[3 * face + 1],
                            c = mesh.triangles[3 * face + 2];
        const Vec3 from = mesh.vertex(a), to = mesh.vertex(b);
        const double t = part();
        const std::uint32_t middle = mesh.vertex_count();
        add_vertex({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y),
                    from.z + t * (to.z - from.z)},
                   a);
        mesh.triangles[3 * face + 1] = middle;
        mesh.add_triangle(middle, b, c);
        mesh.add_triangle(a, b, middle);
        add_to_fields(2);
        return {face};
    }
    /// Appends a triangle that nothing else meets, of this length and height.
    std::vector<std::uint32_t> add_island(double length, double height) {
        const std::uint32_t first = mesh.vertex_count();
        for (const auto& [x, y] : {std::pair{0.0, 0.0}, {length, 0.0}, {length / 2, height}}) {
            add_vertex({30 + x, y, 0}, 0);
        }
        mesh.add_triangle(first, first + 1, first + 2);
        add_to_fields(1);
        return {};
    }
    /// Removes some faces, and reverses the order of faces and vertices.
    void reverse_without(std::uint32_t first, std::uint32_t end) {
        const TestMesh old = std::exchange(mesh, {});
        const std::vector<std::uint32_t> old_keys = std::exchange(keys, {});
        for (std::uint32_t v = old.vertex_count(); v-- > 0;) {
            mesh.add_vertex(old.vertex(v));
        }
        const std::uint32_t last = old.vertex_count() - 1;
        for (std::uint32_t f = old.face_count(); f-- > 0;) {
            if (f < first || f >= end) {
                const std::uint32_t* const c = &old.triangles[std::size_t{3} * f];
                mesh.add_triangle(last - c[0], last - c[1], last - c[2]);
                keys.push_back(old_keys[f]);
            }
        }
        std::ranges::reverse(factors);
    }
    std::vector<std::uint32_t> change_existing() {
        if (!existing.empty() && below(2) == 0) {
            existing.erase(existing.begin() + below(static_cast<std::uint32_t>(existing.size())));
            return {};
        }
        const std::uint32_t face = below(mesh.face_count());
        if (takes_part(face)) {
            existing.push_back({face, {0.5f, 0.25f, 0.25f}});
        }
        return {};
    }

    /// Adds or removes a point to avoid, with a radius of up to `most`.
    std::vector<std::uint32_t> change_avoided(double most) {
        if (avoid.size() > 3 || (!avoid.empty() && below(3) == 0)) {
            avoid.erase(avoid.begin() + below(static_cast<std::uint32_t>(avoid.size())));
            return {};
        }
        const std::uint32_t face = below(mesh.face_count());
        if (takes_part(face)) {
            avoid.push_back({{face, {0.5f, 0.25f, 0.25f}}, most * (0.01 + part())});
        }
        return {};
    }

    TestMesh mesh;
    std::mt19937 random;
    std::vector<double> factors;
    std::vector<std::uint8_t> mask;
    std::vector<std::uint32_t> keys;
    std::vector<Sample> existing;
    std::vector<KeepOut> avoid;
    double min_factor;
    bool by_density; ///< Densities are powers of the factors.
    SampleParams params;
    std::optional<RadiusField> radii;
    std::optional<Updater> updater;
    int edits = 0;

    /// Prepares the mesh, and brings the parameters up to date.
    PreparedMesh prepare() {
        PreparedMesh surface = prepared(mesh);
        if (std::ranges::any_of(factors, [](double g) { return g != 1; })) {
            radii =
                by_density ? density_field(surface, densities()) : radius_field(surface, factors);
        }
        // Existing samples and points to avoid go with their faces.
        std::erase_if(existing, [this](const Sample& sample) { return !takes_part(sample.face); });
        std::erase_if(avoid, [this](const KeepOut& one) { return !takes_part(one.center.face); });
        params = job();
        return surface;
    }

  private:
    /// Copies all but the updater.
    Scene(const Scene& other)
        : mesh(other.mesh), random(other.random), factors(other.factors), mask(other.mask),
          keys(other.keys), existing(other.existing), avoid(other.avoid),
          min_factor(other.min_factor), by_density(other.by_density), params(other.params),
          radii(other.radii) {}

    /// Returns the parameters of the surface as it is.
    SampleParams job() const {
        SampleParams own = params;
        own.radii = radii ? &*radii : nullptr;
        own.face_mask = mask;
        own.face_keys = keys;
        own.existing = existing;
        own.avoid = avoid;
        return own;
    }
    void add_vertex(Vec3 p, std::uint32_t like) {
        mesh.add_vertex(p);
        factors.push_back(factors[like]);
    }
    bool takes_part(std::uint32_t face) const {
        const std::uint32_t* const c = &mesh.triangles[3 * face];
        return c[0] != c[1] && c[1] != c[2] && c[2] != c[0];
    }
    std::vector<double> densities() const {
        std::vector<double> result;
        for (const double factor : factors) {
            result.push_back(std::pow(factor, 8));
        }
        return result;
    }
    void add_to_fields(std::uint32_t faces) {
        if (!mask.empty()) {
            mask.resize(mesh.face_count(), 1);
        }
        for (; !keys.empty() && faces > 0; --faces) {
            keys.push_back(1000000 + mesh.face_count() - faces);
        }
    }
};

} // namespace geodisk::test
