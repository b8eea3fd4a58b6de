#include "files/output/block_writer.hpp"

#include <condition_variable>
#include <mutex>

#include "program/interrupt.hpp"

namespace geodisk::tools {

void write_rows(AtomicFile& file, std::size_t count, const AppendRows& append) {
    std::mutex mutex;
    std::condition_variable written;
    std::size_t next = 0; // The block to write.
    bool has_failed = false;
    const auto write_in_turn = [&](std::size_t block, const std::string& bytes) {
        std::unique_lock lock(mutex);
        written.wait(lock, [&] { return next == block || has_failed; });
        if (!has_failed) {
            check_interrupted();
            file.write(bytes);
            ++next;
        }
    };
    const auto make_worker = [&] {
        return [&, bytes = std::string()](std::size_t block, std::size_t begin,
                                          std::size_t end) mutable {
            try {
                bytes.clear();
                append(bytes, begin, end);
                write_in_turn(block, bytes);
            } catch (...) {
                {
                    const std::scoped_lock lock(mutex);
                    has_failed = true;
                }
                written.notify_all();
                throw;
            }
            written.notify_all();
        };
    };
    in_batches(count, kRowsPerBlock, make_worker, PartDone());
}

} // namespace geodisk::tools
