// SampleRequest: all that a set of samples on a surface depends on, and the runs that make the set.
// Stable.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <geodisk/box.hpp>
#include <geodisk/domain.hpp>
#include <geodisk/export.hpp>
#include <geodisk/farthest.hpp>
#include <geodisk/features.hpp>
#include <geodisk/job_frame.hpp>
#include <geodisk/levels.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/mesh_view.hpp>
#include <geodisk/params.hpp>
#include <geodisk/request_rules.hpp>
#include <geodisk/runner.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// Order of the samples of a set.
enum class SampleOrder : std::uint8_t {
    dart,        ///< As sequential dart throwing accepts them.
    progressive, ///< Coarse levels first, see Levels.
    /// Each one as far as possible from all before it, see FarthestOrder. Existing ones come first,
    /// as they are, at infinite distances.
    farthest,
};

/// A set of samples to make on a surface. All that it points to must outlive the run.
struct SampleRequest {
    /// The run at one distance. With `count`, its distance is the first one to try, at most that
    /// for one sample, or 0 for distance_for_count().
    SampleParams params{};
    /// Number of samples, at least 1, for which a distance is found by trial (CountSearch); 0 if
    /// `params` tell the distance.
    double count = 0;
    /// Return exactly `count` samples, the first ones of a run that has up to 1 % more.
    bool is_exact = false;
    /// Sample corners first, then edges whose faces meet at more than this angle in degrees, 1 to
    /// 180, borders and edges of more than two faces, then the faces. 0 for no features.
    double features = 0;
    /// Sample at vertices alone: each is a candidate, drawn by its share of the area, a third of
    /// each of its faces that take samples. The pool ratio has no effect, and no set has more
    /// samples than there are vertices.
    bool at_vertices = false;
    /// Number of samples of each class to keep, the first ones of each; empty for all. Existing
    /// samples count, and are kept. If a class has fewer, it has what the run gave.
    std::span<const std::uint32_t> class_counts{};
    SampleOrder order = SampleOrder::dart;
    /// For SampleOrder::progressive; a count of 0 is that of levels_for().
    Levels levels{0};
    /// For SampleOrder::farthest: number of samples to keep, existing ones among them; 0 for all.
    std::uint32_t keep = 0;
    /// Distances through space instead of along the surface, to compare with other methods.
    std::optional<Metric> metric{};
    /// Coordinates of the mesh, for `features` and `metric`.
    const MeshView* view = nullptr;
    /// Sample in the frame of another mesh; null for the mesh's own.
    const JobFrame* frame = nullptr;
    /// Mesh that the sampled one was split from, on whose faces samples will be told; or null. The
    /// guard then allows for the steps of weights there.
    const PreparedMesh* split_from = nullptr;
};

/// A set of samples to make in a box.
struct BoxRequest {
    /// The run at one distance. With `count`, its distance is the first one to try, or 0 for
    /// distance_for_count().
    BoxParams params;
    double count = 0;      ///< As SampleRequest::count.
    bool is_exact = false; ///< As SampleRequest::is_exact.
};

/// Samples that a request asked for.
struct RequestedSet {
    /// The samples, and the report of the run that made them: with the work of all its levels, and
    /// with the seconds of all runs. `existing` are those of the request.
    SampleSet set;
    double min_distance = 0;         ///< As asked for, or as found for the count.
    std::uint32_t tries = 0;         ///< Distances tried.
    std::uint64_t cut = 0;           ///< Samples of the run that a count left out.
    Levels levels{0};                ///< Count 0 without levels.
    std::vector<std::size_t> ends{}; ///< Number of samples at the end of each level, or of the run.
    /// Where each sample lies, for a request of features. Existing samples count as on faces.
    std::vector<FeatureKind> features{};
    std::size_t corners = 0;   ///< Corners on faces that take samples.
    double feature_length = 0; ///< Length of all curves, in mesh units.
    /// The request asked for features, and there are none on faces that take samples.
    bool lacks_features = false;
    /// For SampleOrder::farthest, in which `set` then is.
    std::optional<FarthestOrder> farthest{};
    std::size_t unkept = 0; ///< Samples that `keep` leaves out.
};

/// One run of a request.
struct RequestStep {
    Domain domain;
    SampleParams params{}; ///< Of a surface. Refer to the request, or to its run.
    /// Mesh of the domain, if it is one surface by distances along it; else null.
    const PreparedMesh* surface = nullptr;
    bool may_share = false;      ///< Domain::surfaces() may join it with others.
    double expected = 0;         ///< About how many samples there will be.
    std::uint32_t attempt = 0;   ///< Number of the distance that is tried.
    std::uint32_t level = 0;     ///< Level that it samples.
    bool is_on_features = false; ///< Samples the features alone, before the faces.
};

/// The runs that a request takes, one after another: features, levels, and trials for a count.
/// Whoever has a device samples each step, in any way that gives the samples of its domain:
///
///     while (const RequestStep* step = run.step()) {
///         auto set = runner.sample_and_wait(step->domain);
///         ...
///         run.take(std::move(set).value());
///     }
///     auto found = std::move(run).finish();
///
/// Does not order samples by distance: farthest_order() needs a device. StartedRequests and
/// sample() do all that a request asks for.
class GEODISK_API RequestRun {
  public:
    /// Makes the first step. The mesh and what the request refers to must outlive the run.
    ///
    /// Errors: those of Domain::surface() and what else the request needs; `invalid_argument` for
    /// fields out of range, and for two that exclude each other, naming both.
    static Result<RequestRun> create(const PreparedMesh& mesh,
                                     const SampleRequest& request) noexcept;

    /// Makes the first step of a set in a box. Errors: as above, and those of Domain::box().
    static Result<RequestRun> create(const BoxRequest& request) noexcept;

    /// Makes the step at a distance, for what is neither a single surface nor a box.
    using StepAt = std::function<Result<RequestStep>(double min_distance)>;
    /// Makes the run of another domain, at this distance, or at one found for a count, from this
    /// one on.
    static Result<RequestRun> create(StepAt step_at, double min_distance, double count = 0,
                                     bool is_exact = false) noexcept;

    RequestRun(RequestRun&&) noexcept;
    RequestRun& operator=(RequestRun&&) noexcept;
    ~RequestRun();

    /// Returns what to sample next, valid until take(); null if all is done.
    const RequestStep* step() const noexcept;
    /// Takes the samples of the step.
    ///
    /// Errors: as create(); `invalid_argument` if there is no room for so many samples, or an exact
    /// count is not reached. The run has then ended.
    Result<Done> take(SampleSet set) noexcept;
    /// Returns the samples. All steps must have been taken.
    RequestedSet finish() && noexcept;

    struct Impl; ///< Internal.

  private:
    explicit RequestRun(std::unique_ptr<Impl> impl) noexcept;
    std::unique_ptr<Impl> impl_;
};

/// A request, and the mesh that it is for. Both must outlive the run.
struct MeshRequest {
    const PreparedMesh* mesh = nullptr;
    SampleRequest request{};
};

/// The runs of several requests. Runs along surfaces share jobs (Domain::surfaces()) where that
/// changes no set: with one guard, with disks of about as many faces, and as far as any device has
/// room for. All others are jobs of their own. Used as RequestRun is:
///
///     while (const Domain* job = runs.job()) {
///         auto set = runner.sample_and_wait(*job);
///         ...
///         runs.take(std::move(set).value());
///     }
///     auto found = std::move(runs).finish().value();
class GEODISK_API RequestRuns {
  public:
    /// Makes the first job. Errors: those of RequestRun, naming the mesh by its place if there are
    /// several; `invalid_argument` for a mesh that is null.
    static Result<RequestRuns> create(std::span<const MeshRequest> requests) noexcept;
    /// Makes the first job of a set in a box. Errors: those of RequestRun.
    static Result<RequestRuns> create(const BoxRequest& request) noexcept;

    RequestRuns(RequestRuns&&) noexcept;
    RequestRuns& operator=(RequestRuns&&) noexcept;
    ~RequestRuns();

    /// Returns what to sample next, valid until take(); null if all is done.
    const Domain* job() const noexcept;
    /// Takes the samples of the job. Errors: as create(). The runs have then ended.
    Result<Done> take(SampleSet set) noexcept;
    /// Returns the error of sampling the job with its mesh named, if it is of one of several.
    Error named(Error error) const noexcept;
    /// Returns the samples of each request. Reports are of whole jobs. All must have been taken.
    Result<std::vector<RequestedSet>> finish() && noexcept;

    struct Impl; ///< Internal.

  private:
    static Result<RequestRuns> begin(std::vector<RequestRun> runs);
    explicit RequestRuns(std::unique_ptr<Impl> impl) noexcept;
    std::unique_ptr<Impl> impl_;
};

/// Requests that a runner samples without waiting, as Runner::start() and Runner::poll() sample a
/// domain:
///
///     auto started = StartedRequests::start(runner, requests).value();
///     while (!(found = started.poll(std::chrono::milliseconds(10)).value())) {
///         ...
///     }
///
/// The runner must outlive it, and may neither move nor do anything else meanwhile. Destroying it
/// ends what is in progress.
class GEODISK_API StartedRequests {
  public:
    /// Begins. Meshes and what the requests refer to must outlive it. `progress` is called by
    /// poll(), for each run anew. Errors: those of RequestRuns and Runner::start();
    /// `job_too_large` as check_farthest_order().
    static Result<StartedRequests> start(Runner& runner, std::span<const MeshRequest> requests,
                                         const ProgressCallback& progress = {}) noexcept;
    /// Begins with a set in a box.
    static Result<StartedRequests> start(Runner& runner, const BoxRequest& request,
                                         const ProgressCallback& progress = {}) noexcept;

    StartedRequests(StartedRequests&&) noexcept;
    StartedRequests& operator=(StartedRequests&&) noexcept;
    ~StartedRequests();

    /// Goes on, as Runner::poll(). Returns the samples of each request once all are there, else
    /// nothing. Errors: those of RequestRuns::take(), Runner::poll() and farthest_order(), naming
    /// the mesh by its place if there are several. Once it has returned samples or an error, the
    /// requests have ended.
    Result<std::optional<std::vector<RequestedSet>>>
    poll(std::chrono::milliseconds patience = {}) noexcept;

    struct Impl; ///< Internal.

  private:
    static Result<StartedRequests> begin(Runner& runner, std::span<const MeshRequest> requests,
                                         Result<RequestRuns> runs,
                                         const ProgressCallback& progress);
    explicit StartedRequests(std::unique_ptr<Impl> impl) noexcept;
    std::unique_ptr<Impl> impl_;
};

/// Samples what the request asks for, and waits. `progress` is called for each run anew.
///
/// Errors: those of RequestRun, Runner::sample_and_wait() and farthest_order().
GEODISK_API Result<RequestedSet> sample(Runner& runner, const PreparedMesh& mesh,
                                        const SampleRequest& request,
                                        const ProgressCallback& progress = {}) noexcept;

/// Samples what the request asks for in a box, and waits. Errors: those of RequestRun and
/// Runner::sample_and_wait().
GEODISK_API Result<RequestedSet> sample(Runner& runner, const BoxRequest& request,
                                        const ProgressCallback& progress = {}) noexcept;

/// Samples what several requests ask for, each as if alone, and waits. Much faster than one after
/// another if the sets are small. `progress` is called for each job anew.
///
/// Errors: those of RequestRuns, Runner::sample_and_wait() and farthest_order().
GEODISK_API Result<std::vector<RequestedSet>>
sample(Runner& runner, std::span<const MeshRequest> requests,
       const ProgressCallback& progress = {}) noexcept;

} // namespace geodisk
