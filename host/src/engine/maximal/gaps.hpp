// Gaps: the cells of a surface where a sample may still fit.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <geodisk/threads.hpp>

#include "engine/domain/listed.hpp"
#include "engine/maximal/lit_faces.hpp"

namespace geodisk {

class Gaps {
  public:
    /// Begins with all faces that take samples. `params` and `lit` must outlive it.
    Gaps(const LitFaces& lit, const PreparedMesh& mesh, const SampleParams& params,
         const ThreadOptions& threads);

    /// Drops what the lights cover, of which those in LitFaces::lights_of() are new. Splits all
    /// other cells until they reach no farther than `goal`, in minimum distances.
    void refine(double goal);

    /// Returns darts thrown evenly over the cells that are left, as many as there are cells of
    /// `goal` on their area, but at most `most`. Leaves out those that are covered. They are in the
    /// order of their random priorities, a pure function of seed, round, and cells.
    std::vector<ListedCandidate> darts(std::uint32_t round, double goal, double most) const;

    bool empty() const { return cells_.empty(); }
    std::size_t size() const { return cells_.size(); }
    /// Returns true if no cell can be split any more.
    bool are_smallest() const;
    /// Returns the number of cells tested so far.
    std::uint64_t tested() const { return tested_; }
    /// Returns a bound on how far a point of the cells is beyond the nearest limit.
    double largest_excess() const;

  private:
    /// A cell with the lights that may cover a part of it: `count` of a part's lists.
    struct Living {
        GapCell cell;
        std::uint32_t part;
        std::uint32_t first, count;
    };
    struct Part {
        std::vector<Living> cells;
        std::vector<std::uint32_t> lights;
        std::uint64_t tested = 0;
    };
    class Splitter;
    void split(std::span<const Living> cells, double goal, Part& part) const;
    std::span<const std::uint32_t> lights_of(const Living& living) const {
        return std::span(lists_[living.part]).subspan(living.first, living.count);
    }

    const LitFaces& lit_;
    const SampleParams& params_;
    ThreadOptions threads_;
    std::vector<Living> cells_;
    std::vector<std::vector<std::uint32_t>> lists_;
    std::uint64_t tested_ = 0;
};

} // namespace geodisk
