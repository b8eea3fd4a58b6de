// SearchJobs and PartSizes: the jobs of a search within given distances, each for some of its
// sources.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <geodisk/domain.hpp>
#include <geodisk/job_frame.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/neighbours.hpp>
#include <geodisk/params.hpp>

#include "engine/domain/listed.hpp"

namespace geodisk {

/// Data that the jobs of a search share. Mesh, query and bounds must outlive it.
class SearchJobs {
  public:
    /// `bounds` as for search_within(), where all sources have one distance. On a part of a mesh
    /// `whole` is the frame of the jobs on the whole. Errors: `invalid_argument` for edges that are
    /// too long for the distances of a checked query; `job_too_large` for more pairs than it
    /// allows.
    static Result<SearchJobs> create(const PreparedMesh& mesh, const NeighbourQuery& query,
                                     std::span<const double> bounds = {},
                                     const JobFrame* whole = nullptr);

    const JobFrame& frame() const { return frame_; }
    /// Returns the points to find, in the order of their numbers; empty for vertices.
    const std::vector<ListedCandidate>& targets() const { return targets_; }
    /// Returns the records that a source is expected to have.
    double records_per_source() const;
    /// Makes the job of so many sources from one on, with room for so many records.
    Result<Domain> job(std::size_t first, std::size_t sources, std::uint32_t room) const;

  private:
    SearchJobs(const PreparedMesh& mesh, const NeighbourQuery& query,
               std::span<const double> bounds);

    /// Returns the targets that a disk of the largest distance has, where it is about flat.
    double targets_per_source() const;

    const PreparedMesh* mesh_;
    const NeighbourQuery* query_;
    std::span<const double> bounds_;
    SampleParams params_;
    JobFrame frame_;
    std::vector<ListedCandidate> targets_;
};

/// Records of a job: at least, and at most.
inline constexpr double kMinRecords = 4096;
inline constexpr double kMaxRecords = 0x1p22;

/// Number of sources that the next job takes, by the records of those before.
class PartSizes {
  public:
    /// `each`: the records to expect of a source, at first.
    explicit PartSizes(double each) : each_(each) {}

    /// Returns the number of sources, of those left, whose records probably fit.
    std::size_t sources(double max_records, std::size_t done, std::size_t left) const;
    /// Returns the room to provide for the records of so many sources. One takes what it needs.
    std::uint32_t room(std::size_t sources, double max_records) const;
    /// Notes that so many sources had so many records.
    void note(double records, std::size_t sources);
    /// Returns the records to expect of a source, by all that is known.
    double each() const { return each_; }

  private:
    double each_;
};

/// Checks that no edge is too long for the largest distance.
Result<Done> check_edges(const PreparedMesh& mesh, double largest);

/// Checks that a query with distances allows the pairs to expect, by some sources all over the
/// list, before the search. Errors: `job_too_large`.
Result<Done> check_ahead(const PreparedMesh& mesh, const NeighbourQuery& query);

/// Checks that the query allows so many pairs. Errors: `job_too_large`.
Result<Done> check_expected(const NeighbourQuery& query, double pairs);

/// Checks that no more pairs are to be expected than the query allows, by those of the first
/// sources. Errors: `job_too_large`.
Result<Done> check_pairs(const NeighbourQuery& query, std::size_t done, std::uint64_t pairs);

} // namespace geodisk
