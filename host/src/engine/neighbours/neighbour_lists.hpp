// NeighbourLists: the neighbours of sources, from the records of their disks.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <geodisk/neighbours.hpp>
#include <geodisk/threads.hpp>

#include "records.h"

namespace geodisk {

class NeighbourLists {
  public:
    /// Distances of records are in multiples of `unit`. `query` must outlive it.
    NeighbourLists(const NeighbourQuery& query, double unit, const ThreadOptions& threads);

    /// Appends the neighbours of the next sources, so many, from their records: the shortest path
    /// to each target, if it is short enough. Records number the sources from 0 on and targets by
    /// `numbers`, or as they are if that is empty.
    void add(std::size_t sources, std::span<const gpu::HitRec> records,
             std::span<const std::uint32_t> numbers);
    /// Returns the pairs so far.
    std::uint64_t pairs() const { return lists_.indices.size(); }
    Neighbours take() { return std::move(lists_); }

  private:
    struct Hit {
        std::uint32_t target;
        float distance;
    };
    /// Sorts the hits of a source, keeps its neighbours, and returns their number.
    std::size_t reduce(std::size_t source, std::span<Hit> hits) const;

    const NeighbourQuery& query_;
    double unit_;
    ThreadOptions threads_;
    Neighbours lists_;
};

} // namespace geodisk
