#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <geodisk/domain.hpp>
#include <geodisk/update.hpp>
#include <geodisk/weld.hpp>

#include "engine/domain/check_frame.hpp"
#include "engine/domain/existing.hpp"
#include "engine/domain/listed.hpp"
#include "engine/update/dart_set.hpp"
#include "engine/update/face_set.hpp"
#include "engine/update/live_mesh.hpp"
#include "engine/update/match.hpp"
#include "engine/update/mesh_part.hpp"
#include "engine/update/region.hpp"
#include "engine/update/update_checks.hpp"
#include "mesh/checks.hpp"
#include "support/guard.hpp"
#include "support/invalid.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

/// Returns what only one of two lists has: of existing samples, or of points to avoid.
template <class Place, class Order>
std::vector<Place> difference_of(std::vector<Place> a, std::vector<Place> b, const Order& order) {
    std::ranges::sort(a, {}, order);
    std::ranges::sort(b, {}, order);
    std::vector<Place> difference;
    std::ranges::set_symmetric_difference(a, b, std::back_inserter(difference), {}, order, order);
    return difference;
}

/// A view whose seams are joined, unless it keeps them.
struct JoinedView {
    std::vector<std::uint32_t> triangles;
    MeshView view;

    static Result<JoinedView> of(const MeshView& mesh) {
        JoinedView joined{{}, mesh};
        if (mesh.keep_seams) {
            return joined;
        }
        auto welded = join_seams(mesh);
        GEODISK_TRY(welded);
        joined.triangles = std::move(welded->triangles);
        joined.view = {mesh.positions, joined.triangles, mesh.dimension, true};
        return joined;
    }
};

} // namespace

Result<JobFrame> frame_for_edit(const JobFrame& frame, const PreparedMesh& edited,
                                const SampleParams& params) noexcept {
    JobFrame own = frame;
    own.longest_edge = std::ceil(frame.longest_edge); // All tolerances go by it.
    return fits(own, edited.statistics()) ? Result<JobFrame>(own) : frame_of(edited, params);
}

struct Updater::Impl {
    JobFrame frame;
    ThreadOptions threads;
    std::uint64_t seed;
    bool has_keys;
    double min_density; ///< RadiusField::min_density().
    std::uint32_t dimension;
    std::size_t vertices; ///< Number of vertices.
    LiveMesh faces;
    DartSet darts;
    std::vector<Sample> existing{};
    std::vector<KeepOut> avoid{};
    std::vector<Sample> samples{};
    // Edits that are not yet decided.
    std::vector<std::uint32_t> undecided{}; ///< Faces that have changed.
    FaceSet sources{};                      ///< Those, and their neighbours before and after.
    std::size_t dropped = 0;                ///< Samples of those faces that are gone already.
    double avoided = 0; ///< Largest radius of the points to avoid there that are gone.
    /// Largest radius factors on faces when samples were last decided, and of those that are
    /// undecided. Empty where radii are one.
    std::vector<float> factors{};
    double old_factor = 0;

    /// Makes the state of a surface whose samples, but for the existing ones, are found.
    static Result<std::unique_ptr<Impl>> make(const SurfaceJob& job, const JobFrame& frame,
                                              std::vector<NumberedSample> samples,
                                              const ThreadOptions& threads);
    Result<Done> check_same_job(const MeshView& mesh, const SampleParams& params,
                                std::span<const std::uint32_t> changed) const;
    /// Connects the changed faces, and adds them and their neighbours to `sources`.
    void connect(const MeshView& mesh);
    /// Returns true if the edited surface fits the frame.
    Result<bool> fits_frame(const MeshView& mesh, const SampleParams& params) const;
    /// Decides all candidates of the edited surface in a frame that it fits.
    Result<Changes> decide_all(Runner& runner, const MeshView& mesh, const SampleParams& params,
                               const ProgressCallback& progress, UpdateReport& report);
    void set_samples();
    /// Keeps the radius factors of faces that are decided.
    void set_factors(const SampleParams& params, std::span<const std::uint32_t> of);
};

Result<std::unique_ptr<Updater::Impl>> Updater::Impl::make(const SurfaceJob& job,
                                                           const JobFrame& frame,
                                                           std::vector<NumberedSample> samples,
                                                           const ThreadOptions& threads) {
    JobFrame own = frame;
    own.longest_edge = std::ceil(frame.longest_edge); // All tolerances go by it.
    const auto& [mesh, params] = job;
    auto darts = DartSet::find(mesh, params, own, std::move(samples), threads);
    GEODISK_TRY(darts);
    auto impl = std::make_unique<Impl>(Impl{.frame = own,
                                            .threads = threads,
                                            .seed = params.seed,
                                            .has_keys = !params.face_keys.empty(),
                                            .min_density = density_of(params),
                                            .dimension = mesh.dimension,
                                            .vertices = mesh.vertex_count(),
                                            .faces = LiveMesh(mesh),
                                            .darts = std::move(*darts)});
    impl->sources.grow(impl->faces.face_count());
    std::vector<std::uint32_t> all(impl->faces.face_count());
    std::iota(all.begin(), all.end(), 0u);
    impl->set_factors(params, all);
    return impl;
}

Result<Done> Updater::Impl::check_same_job(const MeshView& mesh, const SampleParams& params,
                                           std::span<const std::uint32_t> changed) const {
    GEODISK_TRY(check_same(params, frame, seed, has_keys, min_density));
    GEODISK_TRY(check_sizes(mesh, params));
    if (mesh.dimension != dimension) {
        return other_dimension(dimension, mesh.dimension);
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

Result<bool> Updater::Impl::fits_frame(const MeshView& mesh, const SampleParams& params) const {
    if (undecided.empty() || frame.unit < frame.min_distance) {
        return frame.unit == frame.min_distance;
    }
    // A new edge of more than two faces is at a changed face, and so are the other faces there.
    std::vector<std::uint32_t> near = sources.members();
    std::ranges::sort(near);
    const auto part = MeshPart::prepare(mesh, params, std::move(near), threads);
    GEODISK_TRY(part);
    return fits(frame, part->mesh().statistics());
}

Result<Changes> Updater::Impl::decide_all(Runner& runner, const MeshView& mesh,
                                          const SampleParams& params,
                                          const ProgressCallback& progress, UpdateReport& report) {
    const auto surface = PreparedMesh::prepare(mesh, threads);
    GEODISK_TRY(surface);
    const auto other = frame_for_edit(frame, *surface, params);
    GEODISK_TRY(other);
    const auto domain = Domain::surface(*surface, params, *other);
    GEODISK_TRY(domain);
    const auto set = runner.sample_and_wait(*domain, progress);
    GEODISK_TRY(set);
    std::vector<NumberedSample> found;
    for (std::size_t i = set->existing; i < set->samples.size(); ++i) {
        found.push_back({set->samples[i], i});
    }
    const auto all = DartSet::find(mesh, params, *other, std::move(found), threads);
    GEODISK_TRY(all);
    frame = *other;
    frame.longest_edge = std::ceil(frame.longest_edge);
    report.run = set->report;
    report.rounds = 1;
    report.faces = report.uploaded = surface->face_count();
    return changes_between(darts.in_order(), all->in_order(), has_keys);
}

void Updater::Impl::set_samples() {
    samples.clear();
    for (const Sample& sample : existing) {
        const auto [second, third] = rounded_weights(sample.weights);
        samples.push_back({sample.face, {1 - second - third, second, third}});
    }
    for (const DrawnCandidate& dart : darts.in_order()) {
        samples.push_back(to_sample(dart.point));
    }
}

void Updater::Impl::set_factors(const SampleParams& params, std::span<const std::uint32_t> of) {
    if (params.radii == nullptr) {
        return;
    }
    factors.resize(faces.face_count());
    for (const std::uint32_t face : of) {
        factors[face] = largest_factor(*params.radii, face);
    }
}

Updater::Updater(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
Updater::Updater(Updater&&) noexcept = default;
Updater& Updater::operator=(Updater&&) noexcept = default;
Updater::~Updater() = default;

Result<Updater> Updater::create(const MeshView& given, const SampleParams& params,
                                const JobFrame& frame, std::span<const Sample> samples,
                                const ThreadOptions& threads) noexcept {
    return guarded([&]() -> Result<Updater> {
        const auto joined = JoinedView::of(given);
        GEODISK_TRY(joined);
        const MeshView& mesh = joined->view;
        GEODISK_TRY(check_start({mesh, params}, frame, samples, threads));
        std::vector<NumberedSample> found;
        for (std::size_t i = params.existing.size(); i < samples.size(); ++i) {
            if (samples[i].face >= mesh.face_count()) {
                return no_face(i, samples[i].face, mesh.face_count());
            }
            found.push_back({samples[i], i});
        }
        auto impl = Impl::make({mesh, params}, frame, std::move(found), threads);
        GEODISK_TRY(impl);
        (*impl)->existing.assign(params.existing.begin(), params.existing.end());
        (*impl)->avoid.assign(params.avoid.begin(), params.avoid.end());
        (*impl)->set_samples();
        return Updater(std::move(*impl));
    });
}

Result<Updater> Updater::create(const SurfaceJob& given_before, const SurfaceJob& given_after,
                                const JobFrame& frame, std::span<const Sample> samples,
                                const ThreadOptions& threads) noexcept {
    return guarded([&]() -> Result<Updater> {
        const auto joined_before = JoinedView::of(given_before.mesh);
        GEODISK_TRY(joined_before);
        const auto joined_after = JoinedView::of(given_after.mesh);
        GEODISK_TRY(joined_after);
        const SurfaceJob before{joined_before->view, given_before.params};
        const SurfaceJob after{joined_after->view, given_after.params};
        GEODISK_TRY(check_start(before, frame, samples, threads));
        GEODISK_TRY(check_edit(before, after, frame));
        FaceMatch match = match_faces(before, after);
        std::vector<Sample> existing;
        std::vector<NumberedSample> kept;
        std::size_t dropped = 0;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            Sample sample = samples[i];
            if (sample.face >= match.kept.size()) {
                return no_face(i, sample.face, match.kept.size());
            }
            const bool is_given = i < before.params.existing.size();
            sample.face = match.kept[sample.face];
            if (sample.face == kNoFace) {
                dropped += is_given ? 0 : 1;
            } else if (is_given) {
                existing.push_back(sample);
            } else {
                kept.push_back({sample, i});
            }
        }
        auto impl = Impl::make(after, frame, std::move(kept), threads);
        GEODISK_TRY(impl);
        for (std::uint32_t face = 0; face < match.kept.size() && before.params.radii; ++face) {
            if (match.kept[face] == kNoFace) {
                const float own = largest_factor(*before.params.radii, face);
                (*impl)->old_factor = std::max((*impl)->old_factor, double{own});
            }
        }
        for (KeepOut one : before.params.avoid) {
            one.center.face =
                one.center.face < match.kept.size() ? match.kept[one.center.face] : kNoFace;
            if (one.center.face != kNoFace) {
                (*impl)->avoid.push_back(one);
            } else {
                (*impl)->avoided = std::max((*impl)->avoided, one.radius);
            }
        }
        (*impl)->existing = std::move(existing);
        (*impl)->undecided = std::move(match.changed);
        (*impl)->dropped = dropped;
        (*impl)->set_samples();
        return Updater(std::move(*impl));
    });
}

Result<UpdateReport> Updater::update(Runner& runner, const MeshView& given,
                                     const SampleParams& params,
                                     std::span<const std::uint32_t> changed,
                                     const ProgressCallback& progress) noexcept {
    return guarded([&]() -> Result<UpdateReport> {
        const auto joined = JoinedView::of(given);
        GEODISK_TRY(joined);
        const MeshView& mesh = joined->view;
        Impl& own = *impl_;
        std::vector<std::uint32_t> edited = own.undecided;
        edited.insert(edited.end(), changed.begin(), changed.end());
        for (std::size_t face = own.faces.face_count(); face < mesh.face_count(); ++face) {
            edited.push_back(static_cast<std::uint32_t>(face));
        }
        // A seam that opens or closes also changes the faces on its other side.
        const auto faces = static_cast<std::uint32_t>(mesh.face_count());
        for (std::uint32_t face = 0; !given.keep_seams && face < faces; ++face) {
            if (face < own.faces.face_count() &&
                own.faces.corners(face) != mesh.triangles.face(face)) {
                edited.push_back(face);
            }
        }
        GEODISK_TRY(own.check_same_job(mesh, params, edited));
        own.undecided = std::move(edited);
        own.connect(mesh);
        GEODISK_TRY(check_places(own.faces, params));
        std::vector<Sample> existing(params.existing.begin(), params.existing.end());
        for (const Sample& sample : difference_of(own.existing, existing, order_of)) {
            own.sources.insert(sample.face);
        }
        std::vector<KeepOut> avoid(params.avoid.begin(), params.avoid.end());
        for (const KeepOut& one : difference_of(own.avoid, avoid, order_of_avoided)) {
            own.sources.insert(one.center.face);
            own.avoided = std::max(own.avoided, one.radius);
        }
        double old_factor = own.old_factor;
        for (const std::uint32_t face : own.undecided) {
            old_factor =
                std::max(old_factor, face < own.factors.size() ? double{own.factors[face]} : 0);
        }
        const auto fits = own.fits_frame(mesh, params);
        GEODISK_TRY(fits);
        UpdateReport report;
        Region region(runner, {mesh, params, own.frame, own.faces, own.darts, old_factor,
                               own.threads, progress});
        const auto changes = *fits ? region.decide(own.sources.members(), own.avoided, report)
                                   : own.decide_all(runner, mesh, params, progress, report);
        GEODISK_TRY(changes);
        report.removed = static_cast<std::uint32_t>(changes->removed.size() + own.dropped);
        own.dropped = 0;
        report.added = static_cast<std::uint32_t>(changes->added.size());
        own.darts.replace(changes->removed, changes->added, own.has_keys);
        own.existing = std::move(existing);
        own.avoid = std::move(avoid);
        own.avoided = own.old_factor = 0;
        own.set_factors(params, own.undecided);
        own.set_samples();
        own.undecided.clear();
        own.sources.clear(own.faces.face_count());
        return report;
    });
}

std::span<const Sample> Updater::samples() const noexcept {
    return impl_->samples;
}

std::size_t Updater::existing() const noexcept {
    return impl_->existing.size();
}

const JobFrame& Updater::frame() const noexcept {
    return impl_->frame;
}

} // namespace geodisk
