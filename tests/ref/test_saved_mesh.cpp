// PreparedMesh::save and load: the same to the bit, and no bytes that give anything else.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "support/meshes.hpp"
#include "support/same_mesh.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

using Bytes = std::vector<std::byte>;

Bytes saved(const PreparedMesh& mesh) {
    auto bytes = mesh.save();
    REQUIRE(bytes);
    return std::move(*bytes);
}

void check_round_trip(const PreparedMesh& mesh) {
    const Bytes bytes = saved(mesh);
    const auto loaded = PreparedMesh::load(bytes);
    REQUIRE_MESSAGE(loaded, loaded.error().message);
    CHECK(same_mesh(*loaded, mesh));
    CHECK(saved(*loaded) == bytes);
    Bytes shifted(bytes.size() + 1); // At an odd address.
    std::memcpy(shifted.data() + 1, bytes.data(), bytes.size());
    const auto from_shifted = PreparedMesh::load(std::span(shifted).subspan(1));
    REQUIRE(from_shifted);
    CHECK(same_mesh(*from_shifted, mesh));
}

/// As the library computes it, to forge what the checksum would give away.
std::uint64_t checksum_of(const Bytes& bytes) {
    std::uint64_t sums[4] = {bytes.size(), 1, 2, 3};
    const auto add = [](std::uint64_t& sum, std::uint64_t word) {
        sum = (sum ^ word) * 0x9e3779b97f4a7c15u;
        sum ^= sum >> 29;
    };
    for (std::size_t at = 0; at <= bytes.size(); at += 32) {
        std::uint64_t words[4] = {};
        std::memcpy(words, bytes.data() + at, std::min<std::size_t>(32, bytes.size() - at));
        for (std::size_t lane = 0; lane < 4; ++lane) {
            add(sums[lane], words[lane]);
        }
    }
    for (std::size_t lane = 1; lane < 4; ++lane) {
        add(sums[0], sums[lane]);
    }
    return sums[0];
}

void sign(Bytes& bytes) {
    Bytes body(bytes.begin(), bytes.end() - 8);
    const std::uint64_t sum = checksum_of(body);
    std::memcpy(bytes.data() + body.size(), &sum, 8);
}

/// Indices in range and cycles that end, whatever the geometry.
void check_sound(const PreparedMesh& mesh) {
    const std::size_t count = mesh.half_edges().size();
    std::uint64_t corners = 0;
    for (std::uint32_t h = 0; h < count; ++h) {
        const HalfEdge& edge = mesh.half_edges()[h];
        REQUIRE(edge.origin < mesh.vertex_count());
        REQUIRE(std::isfinite(edge.length + edge.apex_x + edge.apex_y + edge.angle().cosine +
                              edge.angle().sine));
        std::size_t steps = 0;
        for (std::uint32_t g = around_half_edge(edge.around); g != h; ++steps) {
            REQUIRE(g < count);
            REQUIRE(steps < count);
            g = around_half_edge(mesh.half_edges()[g].around);
        }
    }
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        REQUIRE(mesh.fans()[v].first_corner == corners);
        corners += mesh.fans()[v].corner_count;
    }
    REQUIRE(corners == mesh.corners().size());
    for (const std::uint32_t corner : mesh.corners()) {
        REQUIRE(corner < count);
    }
}

Error refusal(const Bytes& bytes) {
    const auto loaded = PreparedMesh::load(bytes);
    REQUIRE(!loaded);
    CHECK(loaded.error().status == Status::invalid_argument);
    CHECK(loaded.error().message.find('\n') == std::string::npos);
    return loaded.error();
}

/// Closed and open fans, an irregular one, a face without area and one that names a vertex twice,
/// an unused vertex.
TestMesh small_mesh() {
    return {{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0.5, 1, 9, 9, 9, 0, 0, -1, 2, 0, 0},
            {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 0, 6, 4, 0, 1, 7, 2, 2, 3}};
}

} // namespace

TEST_CASE("saved: meshes of every kind come back to the bit") {
    for (const TestMesh& mesh :
         {small_mesh(), builtin("cube", 3), builtin("moebius", 3), builtin("lattice", 1),
          two_sided_square(), flat_irregular(8, 1), flat_obtuse_fan(40), builtin("klein-bottle", 6),
          flat_lines({0, 1e-9, 1, 1e3}, {0, 1e-7, 1}), builtin("icosphere", 6)}) {
        check_round_trip(prepared(mesh));
    }
    TestMesh tiny = flat_lines({0, 1e-160, 1e-155, 1}, {0, 1});
    check_round_trip(prepared(tiny));
    for (const NamedMesh& one :
         meshes_like({"bad/warn_nonmanifold_edge.obj", "bad/warn_duplicate_faces.obj",
                      "bad/warn_duplicate_flipped.obj", "bad/warn_bowtie_closed.obj",
                      "bad/warn_sliver_fan.obj", "bad/warn_repeated_index.obj",
                      "bad/warn_zero_area_cap.obj", "meshes/cycloidal_43k.ply",
                      "meshes/teapot_6k.obj", "meshes/human_neutral_21k.obj"})) {
        INFO(one.name);
        check_round_trip(prepared(one.mesh));
    }
    const std::vector<std::uint32_t> triangles{0, 1, 2, 0, 2, 3};
    for (const double excess : {0.0, 1e-7, -1e-7}) {
        const double base = 3 * (1 + excess);
        const std::vector<double> lengths{1, 2, base, base, 4, 5};
        const auto mesh = PreparedMesh::prepare({triangles, lengths, 4});
        REQUIRE(mesh);
        check_round_trip(*mesh);
    }
}

TEST_CASE("saved: damaged and foreign bytes are refused") {
    const Bytes bytes = saved(prepared(small_mesh()));
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        refusal({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)});
    }
    Bytes longer = bytes;
    longer.push_back(std::byte{0});
    CHECK(refusal(longer).message == "the saved mesh is not complete");
    for (std::size_t at = 0; at < bytes.size(); ++at) {
        for (const unsigned flip : {0x01u, 0x80u, 0xffu}) {
            Bytes damaged = bytes;
            damaged[at] ^= static_cast<std::byte>(flip);
            refusal(damaged);
        }
    }
    Bytes other = bytes;
    other[8] = std::byte{1};
    CHECK(refusal(other).message ==
          "the mesh was saved in version 1 of the format; this is version 2");
    std::swap(other[12], other[15]);
    std::swap(other[13], other[14]);
    CHECK(refusal(other).message == "the mesh was saved by a machine of another byte order");
    CHECK(refusal(Bytes(200)).message == "these bytes are no saved mesh");
}

TEST_CASE("saved: forged bytes are refused, or give a mesh that is sound") {
    const Bytes bytes = saved(prepared(small_mesh()));
    std::size_t refused = 0, taken = 0;
    for (std::size_t at = 8; at < bytes.size() - 8; ++at) {
        for (unsigned flip = 1; flip < 256; flip += flip < 16 ? 1 : 13) {
            Bytes forged = bytes;
            forged[at] ^= static_cast<std::byte>(flip);
            sign(forged);
            const auto loaded = PreparedMesh::load(forged);
            if (loaded) {
                check_sound(*loaded);
                ++taken;
            } else {
                ++refused;
            }
        }
    }
    CHECK(refused > taken);
    Bytes same = bytes;
    sign(same);
    CHECK(same == bytes);
}
