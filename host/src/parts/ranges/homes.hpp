// Homes of vertices and faces: the process that read one keeps what belongs to it for all others.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <geodisk/mesh_range.hpp>

#include "parts/ranges/talk.hpp"

namespace geodisk {

/// Divides ascending numbers among their homes.
ByProcess<std::uint32_t> by_home(const MeshBlocks& blocks, std::span<const std::uint32_t> numbers);

/// Returns in how many turns all processes send records of their numbers.
std::uint64_t turns_of(Talk& talk, std::size_t numbers, std::size_t record_size);

/// Passes the records of ascending numbers to `take`, in order, from their homes. All processes
/// call it. `own(at)` returns the record at a place of this process's block.
template <class Record, class Own, class Take>
void fetch(Talk& talk, const MeshBlocks& blocks, std::span<const std::uint32_t> numbers,
           const Own& own, const Take& take) {
    const std::uint64_t first = blocks.first(talk.rank());
    const std::uint64_t turns = turns_of(talk, numbers.size(), sizeof(Record));
    for (std::uint64_t turn = 0; turn < turns; ++turn) {
        const std::size_t begin = numbers.size() * turn / turns;
        const std::size_t end = numbers.size() * (turn + 1) / turns;
        const auto asked = talk.all_to_all(by_home(blocks, numbers.subspan(begin, end - begin)));
        ByProcess<Record> told(talk.size());
        for (std::uint32_t other = 0; other < talk.size(); ++other) {
            told[other].reserve(asked[other].size());
            for (const std::uint32_t number : asked[other]) {
                told[other].push_back(own(static_cast<std::size_t>(number - first)));
            }
        }
        for (const auto& heard : talk.all_to_all(std::move(told))) {
            std::ranges::for_each(heard, take);
        }
    }
}

/// Passes records of ascending numbers to their homes, the other way round: `record(i)` of the
/// number at i to `take(at, record)` there.
template <class Record, class RecordAt, class Take>
void tell_homes(Talk& talk, const MeshBlocks& blocks, std::span<const std::uint32_t> numbers,
                const RecordAt& record, const Take& take) {
    struct Told {
        std::uint32_t number;
        Record record;
    };
    const std::uint64_t first = blocks.first(talk.rank());
    const std::uint64_t turns = turns_of(talk, numbers.size(), sizeof(Told));
    for (std::uint64_t turn = 0; turn < turns; ++turn) {
        ByProcess<Told> told(talk.size());
        const std::size_t end = numbers.size() * (turn + 1) / turns;
        for (std::size_t i = numbers.size() * turn / turns; i < end; ++i) {
            told[blocks.owner(numbers[i])].push_back({numbers[i], record(i)});
        }
        for (const auto& heard : talk.all_to_all(std::move(told))) {
            for (const Told& one : heard) {
                take(static_cast<std::size_t>(one.number - first), one.record);
            }
        }
    }
}

/// Returns the coordinates of vertices, in ascending order, from their homes: three each. All
/// processes call it. `own` are the coordinates of this process's block.
std::vector<double> fetch_positions(Talk& talk, const MeshBlocks& blocks,
                                    std::span<const double> own,
                                    std::span<const std::uint32_t> vertices);

} // namespace geodisk
