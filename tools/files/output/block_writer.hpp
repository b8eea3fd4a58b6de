// Writing large files: several threads make blocks of them.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "files/output/output_file.hpp"
#include "program/batches.hpp"

namespace geodisk::tools {

/// Rows per block: hundreds of kilobytes of text, and much more work than the start of a thread.
inline constexpr std::size_t kRowsPerBlock = 2048;

/// Appends rows `begin` to `end` to `bytes`.
using AppendRows = std::function<void(std::string& bytes, std::size_t begin, std::size_t end)>;

/// Writes rows 0 to `count` in order. Threads call `append` for blocks of them, in any order. Holds
/// one block per thread in memory. Throws what `append` and AtomicFile throw, and UserError on a
/// signal.
void write_rows(AtomicFile& file, std::size_t count, const AppendRows& append);

/// Does this with `append(bytes, row)`, which appends one row.
template <class Append>
void write_each(AtomicFile& file, std::size_t count, const Append& append) {
    write_rows(file, count, [&](std::string& bytes, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            append(bytes, i);
        }
    });
}

/// Calls `work(i)` for each row below `count`, on several threads.
template <class Work>
void for_rows(std::size_t count, const Work& work) {
    const auto make_worker = [&] {
        return [&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                work(i);
            }
        };
    };
    in_batches(count, kRowsPerBlock, make_worker, PartDone());
}

} // namespace geodisk::tools
