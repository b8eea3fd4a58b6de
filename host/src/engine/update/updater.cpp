#include <geodisk/update.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/domain/check_frame.hpp"
#include "engine/domain/given.hpp"
#include "engine/domain/stages.hpp"
#include "engine/update/dart_set.hpp"
#include "engine/update/face_set.hpp"
#include "engine/update/live_mesh.hpp"
#include "engine/update/region.hpp"
#include "mesh/checks.hpp"
#include "support/guard.hpp"
#include "support/invalid.hpp"

namespace geodisk {
namespace {

/// Checks that a job is one whose samples can be updated.
Result<Done> check_kind(const SampleParams& params) {
    const auto refuse = [](const std::string& what) {
        return invalid(what + " cannot be updated; sample the surface again");
    };
    if (params.throws != 0) {
        return refuse("a number of darts");
    }
    if (params.stop_count != 0) {
        return refuse("samples up to a count");
    }
    if (!params.class_factors.empty()) {
        return refuse("samples of classes");
    }
    if (!params.avoid.empty()) {
        return refuse("samples with points to avoid");
    }
    if (params.maximal) {
        return refuse("a maximal set");
    }
    return Done{};
}

/// Checks the sizes of what the parameters say of faces, and the given samples.
Result<Done> check_sizes(const MeshView& mesh, const SampleParams& params) {
    const std::size_t faces = mesh.face_count();
    const auto check = [&](const char* what, std::size_t count) -> Result<Done> {
        return count == 0 || count == faces
                   ? Result<Done>(Done{})
                   : invalid(std::string("there are ") + what + " of " + std::to_string(count) +
                             " faces for a mesh of " + std::to_string(faces));
    };
    if (auto checked = check("keys", params.face_keys.size()); !checked) {
        return checked;
    }
    if (auto checked = check("mask bytes", params.face_mask.size()); !checked) {
        return checked;
    }
    const std::size_t radii = params.radii != nullptr ? params.radii->face_count() : 0;
    return check("radii", radii);
}

Result<Done> check_given_faces(const LiveMesh& faces, std::span<const Sample> given) {
    for (std::size_t i = 0; i < given.size(); ++i) {
        if (given[i].face >= faces.face_count() || !faces.takes_part(given[i].face)) {
            return invalid("given sample " + std::to_string(i) + " is in face " +
                               std::to_string(given[i].face) + ", which there is not",
                           i);
        }
    }
    return Done{};
}

auto order_of(const Sample& sample) {
    const auto [second, third] = rounded_weights(sample.weights);
    return std::tuple(sample.face, second, third);
}

/// Returns the faces of given samples that only one of two lists has.
std::vector<std::uint32_t> faces_of_difference(std::vector<Sample> a, std::vector<Sample> b) {
    std::ranges::sort(a, {}, order_of);
    std::ranges::sort(b, {}, order_of);
    std::vector<Sample> difference;
    std::ranges::set_symmetric_difference(a, b, std::back_inserter(difference), {}, order_of,
                                          order_of);
    std::vector<std::uint32_t> faces;
    for (const Sample& sample : difference) {
        faces.push_back(sample.face);
    }
    return faces;
}

} // namespace

struct Updater::Impl {
    JobFrame frame;
    ThreadOptions threads;
    std::uint64_t seed;
    bool has_keys;
    double least_density; ///< RadiusField::least_density().
    std::uint32_t dimension;
    std::size_t vertices; ///< Number of vertices.
    LiveMesh faces;
    DartSet darts;
    std::vector<Sample> given;
    std::vector<Sample> samples{};
    // Edits that are not yet decided.
    std::vector<std::uint32_t> undecided{}; ///< Faces that have changed.
    FaceSet sources{};                      ///< Those, and their neighbours before and after.

    Result<Done> check_same_job(const MeshView& mesh, const SampleParams& params,
                                std::span<const std::uint32_t> changed) const;
    /// Connects the changed faces, and adds them and their neighbours to `sources`.
    void connect(const MeshView& mesh);
    void set_samples();
};

Result<Done> Updater::Impl::check_same_job(const MeshView& mesh, const SampleParams& params,
                                           std::span<const std::uint32_t> changed) const {
    if (auto checked = check_kind(params); !checked) {
        return checked;
    }
    if (params.seed != seed) {
        return invalid("the samples have the seed " + std::to_string(seed) + ", not " +
                       std::to_string(params.seed));
    }
    if (auto checked = check_job(frame, params); !checked) {
        return checked;
    }
    if (params.face_keys.empty() == has_keys) {
        return invalid(has_keys ? "the faces of the samples have keys, these have none"
                                : "the faces of the samples have no keys, these have");
    }
    if (params.radii != nullptr && params.radii->least_density() != least_density) {
        return invalid("the edit changes the density at which radii are largest, and so all "
                       "radii; sample the surface again");
    }
    if (auto checked = check_sizes(mesh, params); !checked) {
        return checked;
    }
    if (mesh.dimension != dimension) {
        return invalid("the surface had " + std::to_string(dimension) +
                       " coordinates per vertex, not " + std::to_string(mesh.dimension));
    }
    if (mesh.vertex_count() < vertices) {
        return invalid("there are " + std::to_string(mesh.vertex_count()) +
                       " vertices, fewer than the " + std::to_string(vertices) + " before");
    }
    if (mesh.face_count() < faces.face_count()) {
        return invalid("there are " + std::to_string(mesh.face_count()) +
                       " faces, fewer than the " + std::to_string(faces.face_count()) +
                       " before; to remove one, let it name a vertex twice");
    }
    for (const std::uint32_t face : changed) {
        if (face >= mesh.face_count()) {
            return invalid("changed face " + std::to_string(face) + " does not exist", face);
        }
    }
    return check_faces(mesh, changed);
}

void Updater::Impl::connect(const MeshView& mesh) {
    vertices = mesh.vertex_count();
    faces.grow(static_cast<std::uint32_t>(mesh.face_count()));
    sources.grow(faces.face_count());
    const auto add = [this](std::uint32_t face) { sources.insert(face); };
    for (const std::uint32_t face : undecided) {
        faces.for_faces_around(face, add);
    }
    for (const std::uint32_t face : undecided) {
        faces.set(face, mesh.triangles.face(face));
    }
    for (const std::uint32_t face : undecided) {
        add(face);
        faces.for_faces_around(face, add);
    }
}

void Updater::Impl::set_samples() {
    samples.clear();
    for (const Sample& sample : given) {
        const auto [second, third] = rounded_weights(sample.weights);
        samples.push_back({sample.face, {1 - second - third, second, third}});
    }
    for (const DrawnCandidate& dart : darts.in_order()) {
        samples.push_back(to_sample(dart.point));
    }
}

Updater::Updater(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
Updater::Updater(Updater&&) noexcept = default;
Updater& Updater::operator=(Updater&&) noexcept = default;
Updater::~Updater() = default;

Result<Updater> Updater::create(const MeshView& mesh, const SampleParams& params,
                                const JobFrame& frame, std::span<const Sample> samples,
                                const ThreadOptions& threads) noexcept {
    return guarded([&]() -> Result<Updater> {
        if (auto checked = check_threads(threads); !checked) {
            return checked.error();
        }
        if (auto checked = check_mesh(mesh); !checked) {
            return checked.error();
        }
        if (auto checked = check_kind(params); !checked) {
            return checked.error();
        }
        if (auto checked = check_sizes(mesh, params); !checked) {
            return checked.error();
        }
        if (auto checked = check_job(frame, params); !checked) {
            return checked.error();
        }
        if (frame.unit < frame.min_distance) {
            return invalid("the minimum distance exceeds the surface, so an edit may change all "
                           "samples; sample the surface again");
        }
        JobFrame own = frame;
        own.longest_edge = std::ceil(own.longest_edge); // All tolerances go by it.
        LiveMesh faces(mesh);
        if (auto checked = check_given_faces(faces, params.given); !checked) {
            return checked.error();
        }
        const std::size_t given = params.given.size();
        if (samples.size() < given ||
            !std::ranges::equal(samples.first(given), params.given, {}, order_of, order_of)) {
            return invalid("the samples must begin with the " + std::to_string(given) +
                           " given ones");
        }
        auto darts = DartSet::find(mesh, params, own, samples.subspan(given), given, threads);
        if (!darts) {
            return darts.error();
        }
        auto impl = std::make_unique<Impl>(
            Impl{.frame = own,
                 .threads = threads,
                 .seed = params.seed,
                 .has_keys = !params.face_keys.empty(),
                 .least_density = params.radii != nullptr ? params.radii->least_density() : 0,
                 .dimension = mesh.dimension,
                 .vertices = mesh.vertex_count(),
                 .faces = std::move(faces),
                 .darts = std::move(*darts),
                 .given = {params.given.begin(), params.given.end()}});
        impl->sources.grow(impl->faces.face_count());
        impl->set_samples();
        return Updater(std::move(impl));
    });
}

Result<UpdateReport> Updater::update(Runner& runner, const MeshView& mesh,
                                     const SampleParams& params,
                                     std::span<const std::uint32_t> changed) noexcept {
    return guarded([&]() -> Result<UpdateReport> {
        Impl& own = *impl_;
        std::vector<std::uint32_t> edited = own.undecided;
        edited.insert(edited.end(), changed.begin(), changed.end());
        for (std::size_t face = own.faces.face_count(); face < mesh.face_count(); ++face) {
            edited.push_back(static_cast<std::uint32_t>(face));
        }
        if (auto checked = own.check_same_job(mesh, params, edited); !checked) {
            return checked.error();
        }
        own.undecided = std::move(edited);
        own.connect(mesh);
        if (auto checked = check_given_faces(own.faces, params.given); !checked) {
            return checked.error();
        }
        std::vector<Sample> given(params.given.begin(), params.given.end());
        for (const std::uint32_t face : faces_of_difference(own.given, given)) {
            own.sources.insert(face);
        }
        UpdateReport report;
        Region region(runner, {mesh, params, own.frame, own.faces, own.darts, own.threads});
        const auto changes = region.decide(own.sources.members(), report);
        if (!changes) {
            return changes.error();
        }
        report.removed = static_cast<std::uint32_t>(changes->removed.size());
        report.added = static_cast<std::uint32_t>(changes->added.size());
        own.darts.replace(changes->removed, changes->added, own.has_keys);
        own.given = std::move(given);
        own.set_samples();
        own.undecided.clear();
        own.sources.clear(own.faces.face_count());
        return report;
    });
}

std::span<const Sample> Updater::samples() const noexcept {
    return impl_->samples;
}

std::size_t Updater::given() const noexcept {
    return impl_->given.size();
}

const JobFrame& Updater::frame() const noexcept {
    return impl_->frame;
}

} // namespace geodisk
