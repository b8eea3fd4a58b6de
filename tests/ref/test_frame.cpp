// The frame of a job, as the library and as the reference derive it. They share no formula, so a
// wrong one shows here.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include <geodisk/domain.hpp>
#include <geodisk/job_frame.hpp>
#include <geodisk/version.hpp>

#include "engine/domain/stages.hpp"
#include "engine/domain/tolerances.hpp"
#include "kernels/pool.hpp"
#include "lib/frame.hpp"
#include "lib/surface.hpp"
#include "ref/dart_check.hpp"
#include "support/radius_fields.hpp"
#include "throw_darts.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

/// Areas of slivers round otherwise, and sums in another order.
bool is_about(double a, double b) {
    return std::abs(a - b) <= 1e-11 * std::max(std::abs(a), std::abs(b));
}

void check_tolerances(const Tolerances& a, const ref::Tolerances& b) {
    CHECK(a.limit == b.limit);
    CHECK(a.margin == b.margin);
    CHECK(a.slack == b.slack);
    CHECK(a.guard == b.guard);
    CHECK(a.error_bound == b.error_bound);
}

void check_frames(const PreparedMesh& mesh, const SampleParams& params) {
    CAPTURE(params.min_distance);
    CAPTURE(params.pool_ratio);
    CAPTURE(params.darts);
    const Result<JobFrame> made = frame_of(mesh, params);
    REQUIRE_MESSAGE(made, made.error().message);
    const JobFrame& of_host = *made;
    const ref::Frame frame = ref::frame_of(mesh, params);
    CHECK(of_host.min_distance == params.min_distance);
    CHECK(of_host.unit == frame.unit);
    CHECK(is_about(of_host.samples, frame.stages.samples));
    CHECK(is_about(of_host.pool_ratio, frame.stages.ratio));
    CHECK(of_host.longest_edge == frame.longest_edge);
    CHECK(of_host.error_bound == frame.first_error());
    CHECK(of_host.radii_vary == frame.radii_vary);
    CHECK(of_host.nearest_first == frame.nearest_first);
    CHECK(of_host.splits_once == frame.splits_once);
    CHECK(of_host.straight_faces == frame.straight_faces);

    const auto domain = Domain::surface(mesh, params, of_host);
    REQUIRE(domain);
    const Stages& stages = domain->stages();
    CHECK(stages.pool_stages() == frame.stages.pool_stages());
    for (std::uint32_t stage = 0; stage < 40; ++stage) {
        CHECK(stage_intensity(stages, stage) == frame.intensity(stage));
        CHECK(is_about(stages.expected(stage), frame.stages.expected(stage)));
    }
    const ErrorModel model(of_host);
    for (const std::uint32_t crossings : {1u, 64u, 100u, 1000u, 70000u}) {
        CHECK(model.error_of(crossings) == frame.error_of(crossings));
        CHECK(model.error_of(crossings, true) == frame.error_of(crossings, true));
    }
    for (const double larger : {1.0, 1.5, 2.0, 40.0, 10000.0}) {
        const double error = larger * frame.first_error();
        check_tolerances(model.tolerances(error), frame.tolerances(error));
    }
    CHECK(static_cast<float>(model.error_of(0)) == frame.tolerances().base_error);
    CHECK(has_small_faces(mesh, params) == ref::Surface<float>(mesh, params).one_cell_each);
}

std::vector<TestMesh> shapes() {
    return {builtin("icosphere", 3),
            builtin("torus-knot", 6),
            builtin("cone", 4),
            flat_obtuse_fan(40),
            flat_lines({0, 0.1, 0.11, 1}, {0, 0.5, 0.7, 1}),
            needle_sheets(),
            tetrahedra(2, 0.1),
            two_sided_square(),
            all_triangles(6)};
}

/// Two meshes as one, the second one out of reach of the first.
TestMesh side_by_side(const TestMesh& a, const TestMesh& b) {
    TestMesh both = a;
    const std::uint32_t first = a.vertex_count();
    for (std::size_t i = 0; i < b.positions.size(); ++i) {
        both.positions.push_back(b.positions[i] + (i % 3 == 0 ? 50.0 : 0.0));
    }
    for (const std::uint32_t vertex : b.triangles) {
        both.triangles.push_back(first + vertex);
    }
    return both;
}

/// The faces from `first` to `end` of a mesh in reverse order, with their keys.
struct Part {
    TestMesh mesh;
    std::vector<std::uint32_t> keys;

    Part(const TestMesh& whole, std::uint32_t first, std::uint32_t end) {
        mesh.positions = whole.positions;
        for (std::uint32_t f = end; f-- > first;) {
            keys.push_back(f);
            const std::uint32_t* const corners = &whole.triangles[std::size_t{3} * f];
            mesh.add_triangle(corners[0], corners[1], corners[2]);
        }
    }
};

std::vector<Point> samples_in(const PreparedMesh& mesh, const SampleParams& params,
                              const ref::Frame& frame) {
    const ref::Surface<float> surface(mesh, params, frame);
    const auto pool = ref::draw_pool(surface, params);
    std::vector<Point> points;
    for (const std::uint32_t rank : ref::throw_darts(surface, pool, frame.tolerances()).ranks) {
        const auto p = pool.candidate(rank);
        points.push_back({params.face_keys.empty() ? p.face : params.face_keys[p.face],
                          static_cast<double>(p.weight1), static_cast<double>(p.weight2)});
    }
    return points;
}

/// Returns the points of the faces from `first` to `end`, in order.
std::vector<Point> between(const std::vector<Point>& points, std::uint32_t first,
                           std::uint32_t end) {
    std::vector<Point> some;
    std::copy_if(points.begin(), points.end(), std::back_inserter(some),
                 [=](const Point& p) { return p.face >= first && p.face < end; });
    return some;
}

bool are_equal_points(const std::vector<Point>& a, const std::vector<Point>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Point& p, const Point& q) {
        return p.face == q.face && p.weight1 == q.weight1 && p.weight2 == q.weight2;
    });
}

JobFrame frame_for(const PreparedMesh& mesh, const SampleParams& params) {
    const auto frame = frame_of(mesh, params);
    REQUIRE(frame);
    return *frame;
}

std::string message_of(const Error& error) {
    CHECK(error.status == Status::invalid_argument);
    return error.message;
}

std::string refusal(const JobFrame& frame, const PreparedMesh& mesh, const SampleParams& params) {
    const auto domain = Domain::surface(mesh, params, frame);
    REQUIRE_FALSE(domain);
    return message_of(domain.error());
}

bool contains(const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
}

using FrameBytes = std::array<std::byte, kJobFrameBytes>;

std::string refusal(std::span<const std::byte> bytes) {
    const auto frame = frame_from_bytes(bytes);
    REQUIRE_FALSE(frame);
    return message_of(frame.error());
}

} // namespace

TEST_CASE("frame: of the library and of the reference are equal") {
    for (const TestMesh& mesh : shapes()) {
        const PreparedMesh surface = prepared(mesh);
        for (const double count : {0.001, 0.5, 1.0, 3.0, 40.0, 700.0, 30000.0}) {
            SampleParams params = params_for(surface, count);
            for (const double ratio : {1.0, 7.5, 20.0, 100.0}) {
                params.pool_ratio = ratio;
                check_frames(surface, params);
            }
            for (const std::uint32_t darts : {1u, 1000u, 50'000'000u}) {
                params.darts = darts;
                check_frames(surface, params);
            }
        }
    }
}

TEST_CASE("frame: large disks take vertex events by distance") {
    const PreparedMesh sphere = prepared(builtin("icosphere", 6));
    for (const double count : {0.5, 5.0, 20.0}) {
        const SampleParams params = params_for(sphere, count);
        check_frames(sphere, params);
        CHECK(ref::frame_of(sphere, params).nearest_first == (count < 10));
    }
}

TEST_CASE("frame: of the library and of the reference are equal where radii vary") {
    for (const TestMesh& mesh : {builtin("icosphere", 3), builtin("torus-knot", 6)}) {
        for (const double least : {0.001, 0.3, 1.0}) {
            const FieldCase waves(mesh, radius_field, wavy_factors(mesh, least));
            const FieldCase density(mesh, density_field, rough_density(mesh));
            for (const double count : {0.01, 2.0, 40.0, 20000.0}) {
                check_frames(waves.surface, waves.params(count));
                check_frames(density.surface, density.params(count));
            }
        }
    }
}

TEST_CASE("frame: of the library and of the reference are equal where a mask leaves some faces") {
    for (const TestMesh& mesh : shapes()) {
        const FieldCase waves(mesh, radius_field, wavy_factors(mesh, 0.3));
        std::vector<std::uint8_t> mask = mask_above(mesh, 0);
        mask[0] = 1;
        for (const double count : {0.5, 3.0, 700.0, 30000.0}) {
            SampleParams params = params_for(waves.surface, count);
            params.face_mask = mask;
            check_frames(waves.surface, params);
            params.darts = 1000;
            check_frames(waves.surface, params);
            params = waves.params(count);
            params.face_mask = mask;
            check_frames(waves.surface, params);
        }
    }
}

TEST_CASE("frame: a part in the frame of the whole is sampled as the whole is") {
    const TestMesh large = builtin("torus-knot", 10);
    const TestMesh small = builtin("icosphere", 2);
    const TestMesh both = side_by_side(large, small);
    const PreparedMesh whole = prepared(both);
    const std::uint32_t cut = large.face_count();
    const std::uint32_t end = both.face_count();
    for (const double count : {3.0, 2000.0}) {
        for (const std::uint32_t darts : {0u, 100'000u}) {
            SampleParams params = params_for(whole, count, 5);
            params.darts = darts;
            const ref::Frame frame = ref::frame_of(whole, params);
            const JobFrame of_host = frame_for(whole, params);
            params.darts = 0; // Darts are counted on a part alone; candidates are the same.
            const std::vector<Point> of_all = samples_in(whole, params, frame);
            for (const auto& [first, last] : {std::pair{0u, cut}, std::pair{cut, end}}) {
                const Part part(both, first, last);
                const PreparedMesh some = prepared(part.mesh);
                params.face_keys = part.keys;
                CHECK(are_equal_points(samples_in(some, params, frame),
                                       between(of_all, first, last)));

                const auto domain = Domain::surface(some, params, of_host);
                REQUIRE_MESSAGE(domain, domain.error().message);
                const Stages& stages = domain->stages();
                CHECK(stages.samples < of_host.samples);
                for (std::uint32_t stage = 0; stage < 4; ++stage) {
                    CHECK(
                        stage_intensity(stages, stage) ==
                        stage_intensity(
                            Domain::surface(whole, params_for(whole, count, 5))->stages(), stage));
                }
                params.face_keys = {};
            }
        }
    }
}

TEST_CASE("frame: the numbers of faces do not matter where they have keys") {
    const TestMesh shape = builtin("icosphere", 3);
    const PreparedMesh mesh = prepared(shape);
    const Part renumbered(shape, 0, shape.face_count());
    const PreparedMesh other = prepared(renumbered.mesh);
    std::vector<std::uint32_t> keys(shape.face_count());
    std::iota(keys.begin(), keys.end(), 0u);
    SampleParams params = params_for(mesh, 20000, 3);
    params.pool_ratio = 40;
    params.face_keys = keys;
    SampleParams of_other = params;
    of_other.face_keys = renumbered.keys;
    const ref::Surface<float> a(mesh, params);
    const ref::Surface<float> b(other, of_other);
    const auto first = ref::draw_pool(a, params);
    const auto second = ref::draw_pool(b, of_other);
    REQUIRE(first.size() == second.size());
    std::uint32_t wrong = 0, ties = 0;
    for (std::uint32_t rank = 0; rank < first.size(); ++rank) {
        const auto p = first.candidate(rank);
        const auto q = second.candidate(rank);
        wrong += first.word(rank) != second.word(rank) || renumbered.keys[q.face] != p.face ||
                 p.weight1 != q.weight1 || p.weight2 != q.weight2;
        ties += rank > 0 && first.word(rank) == first.word(rank - 1);
    }
    CHECK(wrong == 0);
    CHECK(ties > 10);
    CHECK(
        are_equal_points(samples_in(mesh, params, a.frame), samples_in(other, of_other, b.frame)));
}

TEST_CASE("frame: bytes give the same frame back") {
    const FieldCase waves(builtin("torus-knot", 6), radius_field,
                          wavy_factors(builtin("torus-knot", 6), 0.3));
    const PreparedMesh sphere = prepared(builtin("icosphere", 2));
    for (const JobFrame& frame :
         {frame_for(sphere, params_for(sphere, 100)), frame_for(sphere, params_for(sphere, 0.001)),
          frame_for(waves.surface, waves.params(500))}) {
        const FrameBytes bytes = to_bytes(frame);
        const auto again = frame_from_bytes(bytes);
        REQUIRE_MESSAGE(again, again.error().message);
        CHECK(*again == frame);
        CHECK(to_bytes(*again) == bytes);
    }
    // The low byte first, on every machine.
    JobFrame frame{1, 1, 100, 20, 0.5, 0x1p-14};
    frame.splits_once = true;
    const FrameBytes bytes = to_bytes(frame);
    CHECK(std::to_integer<char>(bytes[0]) == 'G');
    CHECK(std::to_integer<int>(bytes[4]) == 2);
    CHECK(std::to_integer<int>(bytes[15]) == 0x3f); // 1.0 is 0x3ff0000000000000.
    CHECK(std::to_integer<int>(bytes[14]) == 0xf0);
    CHECK(std::to_integer<int>(bytes[56]) == 4);
    CHECK(std::to_integer<int>(bytes[60]) == GEODISK_SAMPLING_VERSION);
    // With another version of the sampling, and the checksum that is right then.
    FrameBytes other = bytes;
    other[60] = std::byte{GEODISK_SAMPLING_VERSION + 1};
    std::uint32_t sum = 0x811c9dc5u;
    for (std::size_t i = 0; i < kJobFrameBytes - 4; ++i) {
        sum = (sum ^ std::to_integer<std::uint32_t>(other[i])) * 0x01000193u;
    }
    for (std::size_t i = 0; i < 4; ++i) {
        other[kJobFrameBytes - 4 + i] = static_cast<std::byte>(sum >> 8 * i & 0xffu);
    }
    const auto refused = frame_from_bytes(other);
    REQUIRE_FALSE(refused);
    CHECK(refused.error().message.starts_with("the job frame is of sampling version 2, and"));
}

TEST_CASE("frame: bad bytes are refused") {
    const PreparedMesh sphere = prepared(builtin("icosphere", 2));
    const JobFrame frame = frame_for(sphere, params_for(sphere, 100));
    const FrameBytes bytes = to_bytes(frame);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        CHECK(contains(refusal(std::span(bytes).first(size)), "a job frame has 128 bytes"));
    }
    std::vector<std::byte> longer(bytes.begin(), bytes.end());
    longer.push_back({});
    CHECK(contains(refusal(longer), "a job frame has 128 bytes, there are 129"));
    // Any byte changed.
    for (std::size_t at = 0; at < bytes.size(); ++at) {
        FrameBytes changed = bytes;
        changed[at] ^= std::byte{1};
        const std::string message = refusal(changed);
        CHECK(contains(message, at < 4   ? "are not a job frame"
                                : at < 8 ? "the job frame has version"
                                         : "its checksum is wrong"));
    }
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const std::pair<double JobFrame::*, const char*> numbers[] = {
        {&JobFrame::min_distance, "its minimum distance"},
        {&JobFrame::unit, "its unit"},
        {&JobFrame::samples, "its number of samples"},
        {&JobFrame::pool_ratio, "its pool ratio"},
        {&JobFrame::longest_edge, "its longest edge"},
        {&JobFrame::error_bound, "its error bound"}};
    for (const auto& [number, name] : numbers) {
        const char* const text = name;
        for (const double value : {kNan, kInfinity, -1.0, 0.0}) {
            CAPTURE(text);
            CAPTURE(value);
            JobFrame wrong = frame;
            wrong.*number = value;
            CHECK(contains(refusal(to_bytes(wrong)), text));
            CHECK(contains(refusal(wrong, sphere, params_for(sphere, 100)), text));
        }
    }
    JobFrame wrong = frame;
    wrong.unit /= 2;
    wrong.radii_vary = true;
    CHECK(contains(refusal(to_bytes(wrong)), "where radii vary"));
}

TEST_CASE("frame: one of another job is refused") {
    const TestMesh shape = builtin("icosphere", 2);
    const PreparedMesh sphere = prepared(shape);
    const SampleParams params = params_for(sphere, 100);
    const JobFrame frame = frame_for(sphere, params);
    SampleParams other = params;
    other.min_distance *= 1.5;
    CHECK(contains(refusal(frame, sphere, other), "its minimum distance is"));
    other = params;
    other.pool_ratio = 10;
    CHECK(contains(refusal(frame, sphere, other), "its pool ratio"));
    const RadiusField field = radius_field(sphere, wavy_factors(shape, 0.5));
    other = params;
    other.radii = &field;
    CHECK(contains(refusal(frame, sphere, other), "its radii do not vary"));
    CHECK(contains(refusal(frame_for(sphere, other), sphere, params), "its radii vary"));
    other = params;
    other.min_distance = -1;
    CHECK(contains(refusal(frame, sphere, other), "the minimum distance must be"));

    TestMesh coarse = builtin("icosphere", 1);
    CHECK(contains(refusal(frame, prepared(coarse), params), "no edge as long"));
    JobFrame longer = frame;
    longer.longest_edge = 100;
    longer.error_bound = 0x1p-10;
    CHECK(contains(refusal(longer, prepared(tetrahedra(1, 0.1)), params), "more than two faces"));
    other = params;
    other.min_distance = 1000;
    JobFrame shorter = frame_for(sphere, other);
    shorter.unit /= 2;
    shorter.longest_edge *= 2;
    CHECK(contains(refusal(shorter, sphere, other), "is shorter than paths"));
}
