// Threads that preparing a mesh may use: how many, whose, and that no result depends on them.
#include <cstddef>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

#include <doctest/doctest.h>

#include "support/blocks.hpp"
#include "support/meshes.hpp"
#include "support/same_mesh.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

using Work = void (*)(void* context, std::size_t block);

/// A caller's loop: backwards, on threads of its own, or leaving blocks out.
struct Loop {
    enum class Kind { backwards, threads, every_other, twice_and_beyond, idle } kind;
    std::size_t calls = 0;

    static void run(void* user, std::size_t blocks, Work work, void* context) {
        Loop& loop = *static_cast<Loop*>(user);
        ++loop.calls;
        std::vector<std::jthread> threads;
        for (std::size_t block = blocks; block-- > 0;) {
            switch (loop.kind) {
            case Kind::backwards:
                work(context, block);
                break;
            case Kind::threads:
                threads.emplace_back(work, context, block);
                break;
            case Kind::every_other:
                if (block % 2 == 0) {
                    work(context, block);
                }
                break;
            case Kind::twice_and_beyond:
                work(context, block);
                work(context, block);
                work(context, block + blocks);
                break;
            case Kind::idle:
                break;
            }
        }
    }
};

std::set<std::thread::id> threads_used(const ThreadOptions& options, std::size_t count) {
    std::set<std::thread::id> used;
    std::size_t elements = 0;
    std::mutex mutex;
    for_blocks(options, count, [&](std::size_t begin, std::size_t end) {
        const std::lock_guard lock(mutex);
        used.insert(std::this_thread::get_id());
        elements += end - begin;
    });
    CHECK(elements == count);
    return used;
}

} // namespace

TEST_CASE("threads: one is the calling one") {
    const std::set<std::thread::id> own{std::this_thread::get_id()};
    CHECK(threads_used({.max_threads = 1}, 10 * kBlock + 3) == own);
    CHECK(threads_used({}, kBlock) == own); // A single block.
    CHECK(threads_used({}, 0).empty());
    for (const std::uint32_t most : {2u, 3u, 100u}) {
        CHECK(threads_used({.max_threads = most}, 10 * kBlock).size() <= most);
    }
}

TEST_CASE("threads: a caller's loop starts none, and what it leaves is done") {
    const std::set<std::thread::id> own{std::this_thread::get_id()};
    for (const auto kind : {Loop::Kind::backwards, Loop::Kind::every_other,
                            Loop::Kind::twice_and_beyond, Loop::Kind::idle}) {
        Loop loop{kind};
        const ThreadOptions options{.parallel_for = Loop::run, .user = &loop};
        CHECK(threads_used(options, 10 * kBlock + 3) == own);
        CHECK(loop.calls == 1);
    }
}

TEST_CASE("threads: no result depends on them") {
    const TestMesh mesh = builtin("icosphere", 6); // 81,920 faces, several blocks.
    const PreparedMesh expected = prepared(mesh);
    const auto bytes = expected.save();
    REQUIRE(bytes);
    const auto check = [&](const ThreadOptions& options) {
        const auto found = PreparedMesh::prepare(mesh.view(), options);
        REQUIRE(found);
        CHECK(same_mesh(*found, expected));
        const auto loaded = PreparedMesh::load(*bytes, options);
        REQUIRE(loaded);
        CHECK(same_mesh(*loaded, expected));
    };
    check({.max_threads = 1});
    check({.max_threads = 5});
    for (const auto kind : {Loop::Kind::backwards, Loop::Kind::threads, Loop::Kind::every_other,
                            Loop::Kind::twice_and_beyond, Loop::Kind::idle}) {
        Loop loop{kind};
        check({.parallel_for = Loop::run, .user = &loop});
        CHECK(loop.calls > 0);
    }
}

TEST_CASE("threads: none is an error") {
    const TestMesh mesh = flat_grid(1, 1, 1, 1);
    const auto found = PreparedMesh::prepare(mesh.view(), {.max_threads = 0});
    REQUIRE(!found);
    CHECK(found.error().status == Status::invalid_argument);
    CHECK(!PreparedMesh::load({}, {.max_threads = 0}));
}
