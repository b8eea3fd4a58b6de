// Neighbours that stay on the device, recorded into an engine's frames.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <geodisk/frame_neighbours.hpp>
#include <geodisk/weld.hpp>

#include "app_device.hpp"
#include "arena.hpp"
#include "engine_job.hpp"
#include "gpu/device_run.hpp"
#include "gpu/sets.hpp"
#include "records.h"
#include "support/meshes.hpp"
#include "workshop.hpp"

namespace geodisk::test {
namespace {

constexpr std::uint32_t kMaxCallsOfSearch = 20'000;

/// Leaves the nearest of each row, nearest first; of vertices that are joined, the lowest.
Neighbours nearest_of(const Neighbours& all, std::uint32_t count,
                      std::span<const std::uint32_t> joined) {
    Neighbours nearest = all;
    nearest.offsets = {0};
    nearest.indices.clear();
    nearest.distances.clear();
    for (std::size_t i = 0; i + 1 < all.offsets.size(); ++i) {
        std::vector<std::pair<float, std::uint32_t>> row;
        for (std::size_t at = all.offsets[i]; at < all.offsets[i + 1]; ++at) {
            const std::uint32_t index = all.indices[at];
            if (joined.empty() || joined[index] == index) {
                row.emplace_back(all.distances[at], index);
            }
        }
        std::ranges::sort(row);
        row.resize(std::min<std::size_t>(row.size(), count));
        for (const auto& [distance, index] : row) {
            nearest.indices.push_back(index);
            nearest.distances.push_back(distance);
        }
        nearest.offsets.push_back(nearest.indices.size());
    }
    return nearest;
}

struct SearchBench : Workshop {
    explicit SearchBench(const Context& on)
        : Workshop(on), context(on),
          sampler(std::make_shared<const Sampler>(expect(Sampler::create(on.device())))) {
        cut({});
    }

    /// Finds all neighbours by a run, and leaves the nearest: find_neighbours() takes smaller disks
    /// for these, which differ in rounding.
    Neighbours wanted(const PreparedMesh& mesh, NeighbourQuery query) const {
        Runner runner = expect(Runner::create(sampler, context.queue()));
        const std::uint32_t nearest = std::exchange(query.nearest, 0);
        const Neighbours all = expect(find_neighbours(runner, mesh, query));
        const bool by_place = query.kind == NeighbourKind::vertices;
        const auto joined = query.joined.empty() ? mesh.joined_vertices() : query.joined;
        return nearest == 0
                   ? all
                   : nearest_of(all, nearest, by_place ? joined : std::span<const std::uint32_t>());
    }
    FrameNeighbours frames(const PreparedMesh& mesh, const NeighbourQuery& query,
                           const FrameNeighbourOptions& options = {}) const {
        return expect(FrameNeighbours::create(sampler, mesh, query, options));
    }

    const Context& context;
    std::shared_ptr<const Sampler> sampler;
};

std::string refusal(const SearchBench& bench, const PreparedMesh& mesh, const NeighbourQuery& query,
                    const FrameNeighbourOptions& options = {}) {
    const auto made = FrameNeighbours::create(bench.sampler, mesh, query, options);
    REQUIRE_FALSE(made);
    CHECK(made.error().status == Status::invalid_argument);
    return made.error().message;
}

template <class T>
std::vector<T> words(SearchBench& bench, VkBuffer buffer, VkDeviceSize offset, std::size_t count) {
    std::vector<T> read(count);
    if (count > 0) {
        const VkDeviceSize bytes = count * sizeof(T);
        bench.frame(0, [&](VkCommandBuffer commands) {
            bench.record_download(commands, {buffer, offset, bytes}, bytes);
        });
        std::memcpy(read.data(), bench.download_bytes().data(), bytes);
    }
    return read;
}

/// Records a frame at a time; how many that took.
std::uint32_t record_all(SearchBench& bench, FrameNeighbours& frames) {
    std::uint32_t calls = 0;
    for (bool is_complete = false; !is_complete; ++calls) {
        REQUIRE(calls < kMaxCallsOfSearch);
        bench.frame(calls, [&](VkCommandBuffer commands) {
            is_complete = expect(frames.record(commands));
        });
    }
    return calls;
}

/// Checks the lists of the sources that are ready.
void check(SearchBench& bench, const FrameNeighbourLists& lists, const Neighbours& wanted) {
    const std::size_t ready = lists.ready;
    REQUIRE(lists.sources + 1 == wanted.offsets.size());
    REQUIRE(lists.pairs == wanted.offsets[ready]);
    REQUIRE(lists.pairs <= lists.capacity);
    const auto offsets =
        words<std::uint32_t>(bench, lists.buffer, lists.offsets_offset, lists.sources + 2);
    CHECK(std::equal(offsets.begin(), offsets.begin() + static_cast<std::ptrdiff_t>(ready) + 1,
                     wanted.offsets.begin()));
    CHECK(offsets.back() >= ready);
    CHECK(words<std::uint32_t>(bench, lists.buffer, lists.indices_offset, lists.pairs) ==
          std::vector(wanted.indices.begin(), wanted.indices.begin() + lists.pairs));
    CHECK(words<float>(bench, lists.buffer, lists.distances_offset, lists.pairs) ==
          std::vector(wanted.distances.begin(), wanted.distances.begin() + lists.pairs));
}

void check_complete(SearchBench& bench, const FrameNeighbours& frames, const Neighbours& wanted) {
    const FrameNeighbourLists lists = frames.lists();
    CHECK(lists.is_complete);
    CHECK(lists.ready == lists.sources);
    CHECK(lists.error == wanted.error);
    check(bench, lists, wanted);
}

/// A mesh with sources and points on it.
struct Subject {
    explicit Subject(const TestMesh& shape)
        : mesh(prepared(shape)), vertices(expect(vertex_points(mesh)).points),
          spacing(std::sqrt(mesh.statistics().area / mesh.vertex_count())) {
        for (const Point& p : random_points(mesh, 7, 300)) {
            points.push_back({p.face,
                              {static_cast<float>(1 - p.weight1 - p.weight2),
                               static_cast<float>(p.weight1), static_cast<float>(p.weight2)}});
        }
        query.sources = vertices;
        query.within = 3 * spacing;
    }

    PreparedMesh mesh;
    std::vector<Sample> vertices, points;
    double spacing;
    NeighbourQuery query;
};

/// Little of everything, so that all of it grows and sources come in many parts.
FrameNeighbourOptions narrow(const SearchBench& bench, const PreparedMesh& mesh,
                             const NeighbourQuery& query) {
    FrameNeighbourOptions options;
    options.record_bytes = 1;
    // The least that one lane fits in.
    for (options.pool_bytes = 1024;
         !FrameNeighbours::create(bench.sampler, mesh, query, options);) {
        options.pool_bytes *= 2;
    }
    options.dispatches = 3;
    options.frames = 3;
    return options;
}

/// A command buffer that nobody submits.
struct Unsent {
    explicit Unsent(const Context& context)
        : device(context.device().device), vk(expect(load_device_table(context.device()))) {
        VkCommandPoolCreateInfo pool_info{};
        pool_info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
        pool_info.queueFamilyIndex = context.queue().family;
        REQUIRE(vk.vkCreateCommandPool(device, &pool_info, nullptr, &pool) == VK_SUCCESS);
        VkCommandBufferAllocateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
        info.commandPool = pool;
        info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
        info.commandBufferCount = 1;
        REQUIRE(vk.vkAllocateCommandBuffers(device, &info, &commands) == VK_SUCCESS);
        VkCommandBufferBeginInfo begin{};
        begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
        REQUIRE(vk.vkBeginCommandBuffer(commands, &begin) == VK_SUCCESS);
    }
    ~Unsent() {
        vk.vkEndCommandBuffer(commands);
        vk.vkDestroyCommandPool(device, pool, nullptr);
    }

    VkDevice device;
    DeviceTable vk;
    VkCommandPool pool = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;
};

} // namespace

TEST_SUITE("frame neighbours") {
    TEST_CASE("are those of a run, to the bit, over vertices, points and sources") {
        const Context context = validated_context();
        {
            SearchBench bench(context);
            for (const auto& [shape, resolution] :
                 {std::pair("torus-knot", 8), std::pair("cube", 6), std::pair("plate", 6),
                  std::pair("moebius", 6)}) {
                const std::string name = shape;
                CAPTURE(name);
                Subject subject(builtin(name, resolution));
                NeighbourQuery& query = subject.query;
                for (const NeighbourKind kind :
                     {NeighbourKind::vertices, NeighbourKind::points, NeighbourKind::sources}) {
                    query.kind = kind;
                    query.points = subject.points;
                    for (const std::uint32_t nearest : {0u, 4u}) {
                        query.nearest = nearest;
                        const Neighbours wanted = bench.wanted(subject.mesh, query);
                        FrameNeighbours frames = bench.frames(subject.mesh, query);
                        CHECK(record_all(bench, frames) > 2);
                        check_complete(bench, frames, wanted);
                    }
                }
            }
        }
        check_silent(context);
    }

    TEST_CASE("with little memory, and any number of frames in flight") {
        const Context context = validated_context();
        {
            SearchBench bench(context);
            Subject subject(builtin("torus-knot", 8));
            NeighbourQuery& query = subject.query;
            bool grows = false;
            SUBCASE("small disks") {
                grows = true;
            }
            SUBCASE("disks that hold much of the mesh") {
                query.within = 30 * subject.spacing;
                query.sources = std::span(subject.vertices).first(70);
            }
            SUBCASE("the nearest of many") {
                query.within = 30 * subject.spacing;
                query.nearest = 7;
                query.sources = std::span(subject.vertices).first(70);
            }
            const Neighbours wanted = bench.wanted(subject.mesh, query);
            FrameNeighbours frames =
                bench.frames(subject.mesh, query, narrow(bench, subject.mesh, query));
            const std::uint64_t before = frames.device_bytes();
            std::uint32_t last = 0, parts = 0;
            for (bool is_complete = false; !is_complete;) {
                bench.frame(0, [&](VkCommandBuffer commands) {
                    is_complete = expect(frames.record(commands));
                });
                if (const FrameNeighbourLists lists = frames.lists(); lists.ready != last) {
                    check(bench, lists, wanted); // What is ready is final.
                    last = lists.ready;
                    ++parts;
                }
            }
            CHECK(parts > 1);
            CHECK((frames.device_bytes() > before) == grows);
            check_complete(bench, frames, wanted);
            for (const std::uint32_t in_flight : {1u, 2u, 5u}) {
                FrameNeighbourOptions options;
                options.frames = in_flight;
                FrameNeighbours again = bench.frames(subject.mesh, query, options);
                record_all(bench, again);
                check_complete(bench, again, wanted);
            }
        }
        check_silent(context);
    }

    TEST_CASE("takes a larger buffer where disks outgrow the first") {
        const Context context = validated_context();
        {
            SearchBench bench(context);
            Subject subject(builtin("lattice", 1));
            NeighbourQuery& query = subject.query;
            query.sources = std::span(subject.vertices).first(3);
            query.nearest = 5; // So that the lists themselves stay small.
            std::uint32_t grown = 0;
            for (const double part : {0.25, 0.75, 2.0}) {
                query.within = part * std::sqrt(subject.mesh.statistics().area);
                FrameNeighbours frames =
                    bench.frames(subject.mesh, query, narrow(bench, subject.mesh, query));
                const VkBuffer lists = frames.lists().buffer;
                const std::uint64_t before = frames.device_bytes();
                record_all(bench, frames);
                grown += frames.device_bytes() > before;
                CHECK(frames.lists().buffer == lists);
                check_complete(bench, frames, bench.wanted(subject.mesh, query));
            }
            CHECK(grown > 0);
        }
        check_silent(context);
    }

    TEST_CASE("fill a buffer to its last record") {
        const Context context = validated_context();
        {
            SearchBench bench(context);
            Subject subject(builtin("torus-knot", 24));
            NeighbourQuery& query = subject.query;
            query.sources = std::span(subject.vertices).first(1);
            query.within = 1000 * subject.spacing; // All paths are neighbours.
            const Neighbours wanted = bench.wanted(subject.mesh, query);
            // Returns whether the disk fits into a buffer for so many records.
            const auto fits = [&](std::uint64_t records) {
                FrameNeighbourOptions options;
                options.record_bytes = records * sizeof(gpu::HitRec);
                FrameNeighbours frames = bench.frames(subject.mesh, query, options);
                const std::uint64_t before = frames.device_bytes();
                record_all(bench, frames);
                check_complete(bench, frames, wanted);
                return frames.device_bytes() == before;
            };
            std::uint64_t few = 4096, many = 65536; // The least that is allocated, and enough.
            REQUIRE_FALSE(fits(few));
            REQUIRE(fits(many));
            while (many - few > 1) { // Ends at a buffer that is full.
                const std::uint64_t middle = (few + many) / 2;
                (fits(middle) ? many : few) = middle;
            }
        }
        check_silent(context);
    }

    TEST_CASE("with distances of their own, and vertices that are joined") {
        const Context context = validated_context();
        {
            SearchBench bench(context);
            Subject subject(builtin("torus-knot", 8));
            NeighbourQuery& query = subject.query;
            std::vector<double> radii;
            for (std::size_t i = 0; i < subject.vertices.size(); ++i) {
                radii.push_back(subject.spacing * (1 + static_cast<double>(i % 7)) / 3);
            }
            query.radii = radii;
            for (const FrameNeighbourOptions& options :
                 {FrameNeighbourOptions{}, narrow(bench, subject.mesh, query)}) {
                FrameNeighbours frames = bench.frames(subject.mesh, query, options);
                record_all(bench, frames);
                check_complete(bench, frames, bench.wanted(subject.mesh, query));
            }
            // Each face with vertices of its own, joined where they coincide.
            const TestMesh apart = soup_of(builtin("torus-knot", 6));
            const WeldedMesh welded = expect(join_seams(apart.view()));
            const PreparedMesh by_hand =
                expect(PreparedMesh::prepare({apart.view().positions, welded.triangles, 3, true}));
            const PreparedMesh joined = expect(PreparedMesh::prepare(apart.view()));
            const std::vector<Sample> all = expect(vertex_points(by_hand, welded.vertices)).points;
            CHECK(expect(vertex_points(joined)).points.size() == all.size());
            query = {};
            query.sources = all;
            query.within = 2 * subject.spacing;
            for (const std::uint32_t nearest : {0u, 5u}) {
                query.nearest = nearest;
                query.joined = welded.vertices;
                const Neighbours wanted = bench.wanted(by_hand, query);
                for (const PreparedMesh* mesh : {&by_hand, &joined}) {
                    query.joined = {};
                    if (mesh == &by_hand) {
                        query.joined = welded.vertices;
                    }
                    FrameNeighbours frames =
                        bench.frames(*mesh, query, narrow(bench, *mesh, query));
                    record_all(bench, frames);
                    CHECK(frames.lists().pairs > all.size());
                    check_complete(bench, frames, bench.wanted(*mesh, query));
                    check_complete(bench, frames, wanted);
                }
            }
        }
        check_silent(context);
    }

    TEST_CASE("as the page on embedding shows it") {
        const Context context = validated_context();
        {
            SearchBench bench(context);
            const std::shared_ptr<const Sampler>& sampler = bench.sampler;
            const Subject subject(builtin("icosphere", 2));
            const PreparedMesh& mesh = subject.mesh;
            const NeighbourQuery& query = subject.query;
            FrameNeighbours frames = expect(FrameNeighbours::create(sampler, mesh, query));
            for (bool ended = false; !ended;) {
                bench.frame(0, [&](VkCommandBuffer commands) {
                    const bool is_complete = expect(frames.record(commands));
                    const FrameNeighbourLists lists = frames.lists();
                    CHECK(lists.ready <= lists.sources);
                    ended = is_complete;
                });
            }
            check_complete(bench, frames, bench.wanted(mesh, query));
        }
        check_silent(context);
    }

    TEST_CASE("lengths of any size are rounded as on the host") {
        const Context context = validated_context();
        {
            SearchBench bench(context);
            for (const double scale : {1e-30, 1.7e-20, 1e20, 7e34}) {
                CAPTURE(scale);
                TestMesh shape = builtin("torus-knot", 6);
                for (double& x : shape.positions) {
                    x *= scale;
                }
                const Subject subject(shape);
                FrameNeighbours frames = bench.frames(subject.mesh, subject.query);
                record_all(bench, frames);
                CHECK(frames.lists().pairs > subject.vertices.size());
                check_complete(bench, frames, bench.wanted(subject.mesh, subject.query));
            }
        }
        check_silent(context);
    }

    TEST_CASE("submits by itself, stops half way and goes on") {
        const Context context = validated_context();
        {
            SearchBench bench(context);
            const Subject subject(builtin("torus-knot", 12));
            const Neighbours wanted = bench.wanted(subject.mesh, subject.query);
            Runner runner = expect(Runner::create(bench.sampler, context.queue()));
            FrameNeighbours frames = bench.frames(subject.mesh, subject.query,
                                                  narrow(bench, subject.mesh, subject.query));
            std::uint32_t asked = 0;
            Result<Done> done = frames.find_and_wait(runner, [&](const Progress& now) {
                CHECK(now.candidates == subject.vertices.size());
                ++asked;
                return now.decided < now.candidates / 2;
            });
            REQUIRE_FALSE(done);
            CHECK(done.error().status == Status::cancelled);
            const FrameNeighbourLists lists = frames.lists();
            CHECK_FALSE(lists.is_complete);
            CHECK(lists.ready >= lists.sources / 2);
            check(bench, lists, wanted);
            expect(frames.find_and_wait(runner));
            check_complete(bench, frames, wanted);
            expect(frames.find_and_wait(runner)); // Nothing to do.
            // Lists of no neighbours at all.
            NeighbourQuery alone = subject.query;
            alone.kind = NeighbourKind::sources;
            alone.sources = std::span(subject.vertices).first(1);
            FrameNeighbours none = bench.frames(subject.mesh, alone);
            expect(none.find_and_wait(runner));
            CHECK(none.lists().pairs == 0);
            check_complete(bench, none, bench.wanted(subject.mesh, alone));
        }
        check_silent(context);
    }

    TEST_CASE("takes its memory from the caller, and gives all back") {
        AppDevice app;
        {
            Arena arena(app.refs());
            const MemoryHooks hooks = arena.hooks();
            DeviceRefs refs = app.refs();
            refs.memory_hooks = &hooks;
            const auto sampler = std::make_shared<const Sampler>(expect(Sampler::create(refs)));
            const Subject subject(builtin("torus-knot", 8));
            {
                Runner runner = expect(Runner::create(sampler, app.queue()));
                const std::size_t before = arena.alive.size();
                FrameNeighbours frames =
                    expect(FrameNeighbours::create(sampler, subject.mesh, subject.query));
                // Two for the device, work and lists; staging and a few words for the host.
                CHECK(arena.alive.size() - before == 4);
                expect(frames.find_and_wait(runner));
                CHECK(frames.lists().is_complete);
            }
            CHECK(arena.alive.empty());
        }
        CHECK(app.messages().empty());
    }

    TEST_CASE("tells of a frame that was not submitted, and of more pairs than are allowed") {
        const Context context = validated_context();
        {
            SearchBench bench(context);
            Subject subject(builtin("torus-knot", 8));
            FrameNeighbours lost = bench.frames(subject.mesh, subject.query);
            Unsent unsent(context);
            expect(lost.record(unsent.commands));
            Result<bool> recorded = false;
            for (int i = 0; i < 20 && recorded; ++i) {
                bench.frame(0, [&](VkCommandBuffer commands) { recorded = lost.record(commands); });
            }
            REQUIRE_FALSE(recorded);
            CHECK(recorded.error().message ==
                  "the buffers hold no mesh: a command buffer with uploads was not submitted");
            subject.query.max_pairs = 100; // Seen before the search.
            const auto seen = FrameNeighbours::create(bench.sampler, subject.mesh, subject.query);
            REQUIRE_FALSE(seen);
            CHECK(seen.error().status == Status::job_too_large);
            // Along edges a few seem too far, so that so many are seen only by the search.
            subject.query.max_pairs = NeighbourQuery().max_pairs;
            subject.query.max_pairs = bench.wanted(subject.mesh, subject.query).indices.size() - 1;
            FrameNeighbours many = bench.frames(subject.mesh, subject.query);
            Runner runner = expect(Runner::create(bench.sampler, context.queue()));
            const auto done = many.find_and_wait(runner);
            REQUIRE_FALSE(done);
            CHECK(done.error().status == Status::job_too_large);
        }
        check_silent(context);
    }

    TEST_CASE("what cannot be is refused") {
        const Context context = expect(Context::create());
        const SearchBench bench(context);
        Subject subject(builtin("cube", 2));
        NeighbourQuery query = subject.query;
        query.within = 0;
        query.nearest = 3;
        CHECK(refusal(bench, subject.mesh, query) ==
              "a search in frames needs the distance within which neighbours are");
        CHECK(refusal(bench, subject.mesh, {}) == "there is no source");
        FrameNeighbourOptions options;
        options.frames = 17;
        CHECK(refusal(bench, subject.mesh, subject.query, options) ==
              "FrameNeighbourOptions::frames is 17, not from 1 to 16");
        options = {};
        options.dispatches = 0;
        CHECK(refusal(bench, subject.mesh, subject.query, options) ==
              "FrameNeighbourOptions::dispatches and rounds must not be 0");
        options = {};
        options.readers.stages = 0;
        CHECK(refusal(bench, subject.mesh, subject.query, options) ==
              "FrameNeighbourOptions::readers has no stage");
        CHECK_FALSE(FrameNeighbours::create(nullptr, subject.mesh, subject.query));
        FrameNeighbours frames = bench.frames(subject.mesh, subject.query);
        CHECK(frames.record(VK_NULL_HANDLE).error().message == "the command buffer is null");
    }
}

} // namespace geodisk::test
