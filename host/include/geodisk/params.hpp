// SampleParams: the parameters of a sampling job on a surface, and figures that follow from them.
// Stable.
#pragma once

#include <cstdint>
#include <span>
#include <type_traits>

#include "geodisk/export.hpp"
#include "geodisk/mesh.hpp"
#include "geodisk/radius_field.hpp"
#include "geodisk/sample.hpp"
#include "geodisk/status.hpp"

namespace geodisk {

/// Mean packing density (paper section 5.2) of dart throwing from a pool of the default ratio.
/// Converts between a count and a distance.
inline constexpr double kExpectedRho = 0.725;
/// Samples that a border adds, per minimum distance along it (measured).
inline constexpr double kBorderSamples = 0.174;
/// Default of SampleParams::pool_ratio.
inline constexpr double kDefaultPoolRatio = 20;
/// Maximum of candidates of a job.
inline constexpr std::uint32_t kMaxCandidates = 0xffffffff;
/// Candidates of a stage per expected sample, see Stages.
inline constexpr double kStageRatio = 5;
/// Maximum of stages of a pool.
inline constexpr std::uint32_t kMaxPoolStages = 15;
/// Maximum of classes of samples.
inline constexpr std::uint32_t kMaxClasses = 8;
/// In SampleParams::avoid_classes, for a disk that keeps out all classes.
inline constexpr std::uint8_t kAllClasses = 255;
/// Minimum of SampleParams::class_factors, but for 0.
inline constexpr float kMinClassFactor = 0.01f;
/// Maximum of candidates that one face may expect in one stage.
inline constexpr double kMaxPerFace = 0x1p24;

/// A sampling job. Lengths are in mesh units.
struct SampleParams {
    double min_distance = 0; ///< D > 0: no two samples are closer along the surface.
    std::uint64_t seed = 0;
    double pool_ratio = kDefaultPoolRatio; ///< Candidates per expected sample, 1 to 10,000.
    /// Number of darts to throw (paper section 4.1), instead of a pool by `pool_ratio`; 0 for a
    /// pool.
    std::uint32_t darts = 0;
    /// Stop after this many samples, if not 0. They are the first samples of the run without it.
    /// There are fewer if no more fit or the candidates end.
    std::uint32_t stop_count = 0;
    /// Radii that vary over the surface, or null for min_distance / 2 everywhere. Samples p and q
    /// are at least (g(p) + g(q)) * min_distance / 2 apart, so min_distance is that of two samples
    /// with the largest radius. Must belong to the same mesh and outlive the run.
    const RadiusField* radii = nullptr;
    /// Keys by which the candidates of each face are drawn, besides the seed: a triangle with the
    /// same key has the same candidates in every mesh. Empty for the indices of faces; otherwise
    /// one key per face, all different. Must outlive the run.
    std::span<const std::uint32_t> face_keys{};
    /// One byte per face: a face with 0 gets no samples, but paths cross it. Empty if all faces
    /// take samples. Must outlive the run.
    std::span<const std::uint8_t> face_mask{};
    /// Samples to keep. They come first in the result, in this order, and new samples keep the
    /// minimum distance from them. Distances among them are not checked. They count towards
    /// `stop_count`. Weights are rounded to multiples of 2^-24.
    std::span<const Sample> existing{};
    /// Disks that new samples must avoid. Existing samples may lie inside. No new sample is within
    /// the geodesic radius of the center. The radius may be larger or smaller than `min_distance`;
    /// much larger disks take long. Not for distances through space. A recorded job has the centers
    /// before the first sample in its samples buffer, as records with `gpu::kKeepsOut` in their
    /// face.
    std::span<const KeepOut> avoid{};
    /// Distances of K classes of samples, 2 to 8, as parts of `min_distance`: a symmetric table,
    /// row by row, of factors from kMinClassFactor to 1. Samples of the classes a and b are at
    /// least class_factors[K * a + b] * min_distance apart; 0 for two classes that keep no
    /// distance from each other. Each class has the candidates of a run
    /// with its own distance. Empty if samples have no classes. Only for one surface with geodesic
    /// distances, whose radii do not vary. Must outlive the run.
    std::span<const float> class_factors{};
    /// Class of each existing sample; empty if all have class 0. Must outlive the run.
    std::span<const std::uint8_t> existing_classes{};
    /// Class that each disk to avoid keeps out, kAllClasses for all of them; empty if all keep out
    /// all. Must outlive the run.
    std::span<const std::uint8_t> avoid_classes{};
    /// Share of its samples that each class has at the corners of faces, from 0 for none to 1 for
    /// all that fit: that of class a at corner k of face f is class_shares[3 * (F * a + f) + k],
    /// with F faces. Linear in a face, and rounded to multiples of 1 / 512, but to none above 0.
    /// A class has fewer candidates there (candidates_for_share), and `darts` counts those that it
    /// lacks. Empty if all classes may lie everywhere. Must outlive the run.
    std::span<const float> class_shares{};
    /// Goes on after the pool until no further sample fits anywhere: the set is maximal. Only
    /// Runner does, in several rounds; see RunReport::maximal and host/docs/maximal.md. The samples
    /// begin with those of the pool. Not with `darts`, `stop_count`, a density, classes, several
    /// surfaces or distances through space.
    bool maximal = false;
};

/// Calls `visit(name, value)` for each field of SampleParams, in their order, for whoever writes,
/// reads, sends or compares them. A field that is forgotten here does not compile. Experimental.
template <class Params, class Visitor>
constexpr void for_each_field(Params& params, Visitor&& visit) {
    static_assert(std::is_same_v<std::remove_const_t<Params>, SampleParams>);
    auto& [min_distance, seed, pool_ratio, darts, stop_count, radii, face_keys, face_mask, existing,
           avoid, class_factors, existing_classes, avoid_classes, class_shares, maximal] = params;
    visit("min_distance", min_distance);
    visit("seed", seed);
    visit("pool_ratio", pool_ratio);
    visit("darts", darts);
    visit("stop_count", stop_count);
    visit("radii", radii);
    visit("face_keys", face_keys);
    visit("face_mask", face_mask);
    visit("existing", existing);
    visit("avoid", avoid);
    visit("class_factors", class_factors);
    visit("existing_classes", existing_classes);
    visit("avoid_classes", avoid_classes);
    visit("class_shares", class_shares);
    visit("maximal", maximal);
}

/// Calls `visit(name, value)` for the fields that are numbers, and no data of the caller's.
/// Experimental.
template <class Params, class Visitor>
constexpr void for_each_number(Params& params, Visitor&& visit) {
    for_each_field(params, [&]<class Field>(const char* name, Field& value) {
        if constexpr (std::is_arithmetic_v<std::remove_const_t<Field>>) {
            visit(name, value);
        }
    });
}

/// Returns a job with the same numbers, which refers to no data. Experimental.
constexpr SampleParams numbers_of(SampleParams params) {
    for_each_field(params, []<class Field>(const char*, Field& value) {
        if constexpr (!std::is_arithmetic_v<Field>) {
            value = Field{};
        }
    });
    return params;
}

/// Source of a job's candidates.
enum class CandidateSource : std::uint8_t {
    pool,    ///< Drawn from the seed, about SampleParams::pool_ratio per expected sample.
    darts,   ///< Drawn from the seed, exactly SampleParams::darts.
    list,    ///< Points that the host gives.
    targets, ///< Points that disks look for, or none. No candidate is decided.
};

/// Returns the source of candidates that parameters ask for.
constexpr CandidateSource source_of(std::uint32_t darts) noexcept {
    return darts != 0 ? CandidateSource::darts : CandidateSource::pool;
}

/// The candidates of a job. Those that are drawn come in stages. Each is a Poisson process of its
/// own, drawn face by face. All candidates of a stage precede those of the next
/// (host/docs/determinism.md). A list is a single stage.
struct Stages {
    double samples = 0;      ///< Expected samples of the job.
    double ratio = 0;        ///< Candidates of a pool per expected sample.
    std::uint32_t darts = 0; ///< Number of darts. Stages go on until there are as many.
    CandidateSource source = source_of(darts);
    /// For several surfaces, each with its own stages: the maximum of stages of one surface, and
    /// the candidates that all first stages expect together. 0 for one surface.
    std::uint32_t max_stages = 0;
    double max_expected = 0;
    /// For several surfaces: a bound on the variance of the candidates of all first stages. Those
    /// with the same seed draw alike, so that their deviations add up.
    double max_variance = 0;
    /// For several surfaces: how many have the same seed, at most.
    std::uint32_t max_alike = 0;
    /// For a part of a surface in the frame of the whole: the expected samples of the whole, which
    /// tell how darts grow. 0 for `samples`.
    double of_whole = 0;

    /// Returns the number of stages of a pool: its ratio over kStageRatio, rounded up, at most
    /// kMaxPoolStages.
    GEODISK_API std::uint32_t pool_stages() const noexcept;
    /// Returns the candidates of a stage per expected sample. All stages of a pool are alike. The
    /// first stage of darts has kStageRatio, halved until it expects at most 2^23 in all. Each
    /// later one has twice as many as the one before, up to 640 per sample and 2^23 in all. No
    /// stage expects fewer than 64 in all.
    GEODISK_API double per_sample(std::uint32_t stage) const noexcept;

    /// Returns true if just `darts` candidates take part, however many the stages have.
    bool is_counted() const noexcept { return source == CandidateSource::darts; }
    /// Returns true if kernels draw the candidates, and the host does not upload them.
    bool is_drawn() const noexcept {
        return source == CandidateSource::pool || source == CandidateSource::darts;
    }
    /// Returns how many stages may be drawn at once: all of a pool, one of darts.
    std::uint32_t max_at_once() const noexcept { return is_counted() ? 1 : pool_stages(); }
    /// Returns how many stages are left after the first `done` with `drawn` candidates. For darts
    /// 1, and 0 once there are enough.
    GEODISK_API std::uint32_t left(std::uint32_t done, std::uint64_t drawn) const noexcept;
    /// Returns the maximum of candidates that still take part after the first `drawn`; for a pool
    /// no bound.
    GEODISK_API std::uint64_t still_wanted(std::uint64_t drawn) const noexcept;

    /// Returns the candidates that a stage expects; for several surfaces an upper bound.
    double expected(std::uint32_t stage) const noexcept {
        return max_expected > 0 ? max_expected : per_sample(stage) * samples;
    }
    /// Returns the maximum of candidates that so many stages expect, drawn at once.
    GEODISK_API double expected_at_once(std::uint32_t stages) const noexcept;
    /// Returns a bound on the variance of the candidates of so many stages, drawn at once.
    double variance_at_once(std::uint32_t stages) const noexcept {
        return max_variance > 0 ? stages * max_variance : expected_at_once(stages);
    }
    /// Returns the candidates that a pool expects.
    double pool() const noexcept { return ratio * samples; }
    /// Returns the candidates of the job: its darts, or else its pool.
    double candidates() const noexcept { return is_counted() ? darts : pool(); }
};

/// Returns the area that a run fills: the mesh's, or RadiusField::effective_area() if radii vary.
/// With a face mask, that of the faces that take samples; takes time linear in the mesh then. With
/// classes, as many times that as their distances let fit more samples.
GEODISK_API double effective_area(const PreparedMesh& mesh, const SampleParams& params) noexcept;

/// Returns the expected number of samples for a distance: rho^2 A / (2 sqrt(3) r^2), r = D / 2.
GEODISK_API double expected_count(double area, double min_distance) noexcept;

/// Returns the distance that should give about `count` samples on a surface without borders.
GEODISK_API double distance_for_count(double area, double count) noexcept;

/// Returns the distance that should give about `count` samples on a mesh, with the radii and the
/// face mask of `params`. More samples fit beside a border: kBorderSamples per distance along it.
GEODISK_API double distance_for_count(const PreparedMesh& mesh, const SampleParams& params,
                                      double count) noexcept;

/// Returns the distance of a mesh for which others know the effective_area() and the length of all
/// borders, in multiples of the largest radius if radii vary.
GEODISK_API double distance_for_count(double area, double borders, double count) noexcept;

/// Returns the packing density r * sqrt(2 sqrt(3) N / A) of a result (paper section 5.2).
GEODISK_API double packing_density(double area, double min_distance, double count) noexcept;

/// Returns the candidates of a job: `darts`, or the pool_ratio times the expected count, at least
/// 64.
///
/// Errors: `invalid_argument` for a parameter out of range; for radii, face keys or a face mask of
/// another number of faces; for a mask that leaves no area for samples; for an existing sample,
/// naming it, in a face that does not exist or repeats a vertex, or with weights that are negative
/// or do not sum to 1, likewise for a disk to avoid, or with a radius that is not positive and
/// finite; for a table of classes that is not symmetric or has factors out of range, a class that
/// there is not, or classes with radii that vary; for more existing samples than `stop_count`; for
/// a pool of more than 2^32 candidates, naming their number; for an edge longer than 4,000
/// distances, where rounding would matter too much; for a face, `Error::element`, that expects more
/// than kMaxPerFace candidates in a stage.
GEODISK_API Result<std::uint32_t> pool_size(const PreparedMesh& mesh,
                                            const SampleParams& params) noexcept;

} // namespace geodisk
