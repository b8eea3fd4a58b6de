// Pairs of samples that a check of distances takes note of, found in double precision by the
// reference implementation: on a mesh, or on a part of it by one of several processes.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <geodisk/mesh.hpp>
#include <geodisk/sample.hpp>

#include "geodisk/checks/spacing.hpp"
#include "geodisk/outputs/progress.hpp"
#include "lib/frame.hpp"

namespace geodisk::tools {

/// Search for pairs: those closer than they should be, and the closest of all.
struct PairSearch {
    const PreparedMesh& mesh;    ///< The whole, or what surrounds the sources of a part.
    ref::Frame frame;            ///< Frame of the whole; its unit is that of all lengths.
    double longest = 0;          ///< Maximum length of a path on the whole, in mesh units.
    std::vector<Sample> samples; ///< By row, on faces of `mesh`.
    /// Distances that samples must keep; none to look for the closest pair by its distance alone.
    std::optional<PairDistances> distances{};
    /// Pairs are found up to this part of the distance they must have, or up to this distance.
    double cut = 0;
    std::span<const std::uint32_t> existing{}; ///< Other than 0 if so; empty if none are.
    std::span<const std::uint8_t> sources{};   ///< 0 where no pairs are looked for; or empty.

    /// Returns how far from a sample others are looked for.
    double reach(std::uint32_t row) const { return distances ? cut * distances->reach(row) : cut; }
    bool is_source(std::uint32_t row) const { return sources.empty() || sources[row] != 0; }
    /// Returns true for pairs whose distance is the user's.
    bool is_existing(const ClosePair& pair) const {
        return !existing.empty() && existing[pair.row_a] != 0 && existing[pair.row_b] != 0;
    }
    bool is_violation(const ClosePair& pair) const { return distances && pair.is_violation(); }
};

/// Returns the search of all pairs of some rows on a mesh. Distances are in units of about
/// `distance`.
PairSearch search_on(const PreparedMesh& mesh, std::span<const SampleRow> rows, double distance);

/// A pair found from one of its samples.
struct NotedPair {
    std::uint32_t source; ///< Its row.
    ClosePair pair;
};

/// Returns the pairs that are too close, and those closer than all found before, in the order in
/// which sources are looked at. A pair may be found from both of its samples. The last source is
/// the one with which too many are too close. Throws UserError for a surface whose paths do not
/// end, and when interrupted.
std::vector<NotedPair> note_pairs(const PairSearch& search, ProgressLine& progress);

/// Puts together what was noted for disjoint sources of a search, as note_pairs() notes it.
std::vector<NotedPair> merged_pairs(const PairSearch& search, std::vector<NotedPair> noted);

/// Does what note_pairs() does.
using NotePairs = std::function<std::vector<NotedPair>(const PairSearch&, ProgressLine&)>;

/// Computes the geodesic distances of all pairs that are not farther apart than a cut somewhat
/// beyond the distance that they must keep, which is positive. Rows with `existing` other than 0
/// existed before; if it is empty, none did. Every row's face must be one of the mesh. Throws
/// UserError when interrupted.
ExistingSpacing check_spacing(const MeshInput& mesh, std::span<const SampleRow> rows,
                              const PairDistances& distances,
                              std::span<const std::uint32_t> existing, ProgressLine& progress,
                              const NotePairs& note = note_pairs);

/// Returns the closest pair of all, by distance, however far apart; none if no path joins any two
/// samples. Conditions and errors are those of check_spacing().
std::optional<ClosePair> find_closest(const MeshInput& mesh, std::span<const SampleRow> rows,
                                      ProgressLine& progress, const NotePairs& note = note_pairs);

} // namespace geodisk::tools
