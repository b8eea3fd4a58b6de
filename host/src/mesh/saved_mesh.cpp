// Prepared meshes as bytes: a header, the shapes of half-edges, their links, the fans, the corners
// and a checksum. Derived values are computed again. Everything that could harm a run is checked,
// because the bytes may come from any source.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <string>
#include <type_traits>
#include <utility>

#include "constants.h"
#include "geodisk/mesh.hpp"
#include "mesh/checks.hpp"
#include "mesh/connectivity.hpp"
#include "mesh/face_frames.hpp"
#include "mesh/vertex_fans.hpp"
#include "support/blocks.hpp"
#include "support/checksums.hpp"
#include "support/guard.hpp"
#include "support/invalid.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

constexpr char kMagic[8] = {'g', 'e', 'o', 'd', 'i', 's', 'k', 'M'};
constexpr std::uint32_t kVersion = 2;
constexpr std::uint32_t kByteOrder = 0x01020304;

struct Header {
    char magic[8];
    std::uint32_t version;
    std::uint32_t byte_order;
    std::uint64_t half_edges, vertices, corners;
    std::uint64_t components, coinciding_border_edges;
    double diagonal;
};

/// Part of a frame that depends on coordinates or lengths; the rest follows from it.
struct Shape {
    double length, apex_x, apex_y;
};

using Checksum = std::uint64_t;

static_assert(std::has_unique_object_representations_v<Link>);
static_assert(std::has_unique_object_representations_v<VertexFan>);
static_assert(sizeof(Header) == 64 && sizeof(Shape) == 24);

/// Returns a checksum. A change of eight adjacent bytes always changes it, since each step is
/// invertible. Four independent sums are faster on a processor.
Checksum checksum_of(std::span<const std::byte> bytes) {
    constexpr std::size_t kLanes = 4;
    Checksum sums[kLanes] = {bytes.size(), 1, 2, 3};
    const auto add = [](Checksum& sum, std::uint64_t word) {
        sum = (sum ^ word) * 0x9e3779b97f4a7c15u;
        sum ^= sum >> 29;
    };
    std::uint64_t words[kLanes];
    std::size_t at = 0;
    for (; at + sizeof words <= bytes.size(); at += sizeof words) {
        std::memcpy(words, bytes.data() + at, sizeof words);
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            add(sums[lane], words[lane]);
        }
    }
    std::fill(std::begin(words), std::end(words), 0u);
    std::memcpy(words, bytes.data() + at, bytes.size() - at);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        add(sums[lane], words[lane]);
    }
    for (std::size_t lane = 1; lane < kLanes; ++lane) {
        add(sums[0], sums[lane]);
    }
    return sums[0];
}

std::uint64_t saved_size(const Header& header) {
    return sizeof(Header) + header.half_edges * (sizeof(Shape) + sizeof(Link)) +
           header.vertices * sizeof(VertexFan) + header.corners * sizeof(std::uint32_t) +
           sizeof(Checksum);
}

class Writer {
  public:
    explicit Writer(std::size_t size) { bytes_.reserve(size); }

    template <class T>
    void put(const T* from, std::size_t count) {
        const auto* const first = reinterpret_cast<const std::byte*>(from);
        bytes_.insert(bytes_.end(), first, first + count * sizeof(T));
    }
    std::vector<std::byte> finish() {
        const Checksum sum = checksum_of(bytes_);
        put(&sum, 1);
        return std::move(bytes_);
    }

  private:
    std::vector<std::byte> bytes_;
};

/// Array of elements in memory without alignment.
template <class T>
class Stored {
  public:
    /// Takes `count` elements off the front of `bytes`.
    Stored(std::span<const std::byte>& bytes, std::size_t count) : first_(bytes.data()) {
        bytes = bytes.subspan(count * sizeof(T));
    }
    void read(std::size_t begin, std::size_t end, T* to) const {
        if (begin < end) {
            std::memcpy(to, first_ + begin * sizeof(T), (end - begin) * sizeof(T));
        }
    }
    T operator[](std::size_t i) const {
        T element;
        std::memcpy(&element, first_ + i * sizeof(T), sizeof(T));
        return element;
    }

  private:
    const std::byte* first_;
};

Result<Header> read_header(std::span<const std::byte> bytes) {
    Header header;
    if (bytes.size() < sizeof header || std::memcmp(bytes.data(), kMagic, sizeof kMagic) != 0) {
        return invalid("these bytes are no saved mesh");
    }
    std::memcpy(&header, bytes.data(), sizeof header);
    if (header.byte_order != kByteOrder) {
        return invalid("the mesh was saved by a machine of another byte order");
    }
    if (header.version != kVersion) {
        return invalid("the mesh was saved in version " + std::to_string(header.version) +
                       " of the format; this is version " + std::to_string(kVersion));
    }
    // Check counts first, so that the size cannot overflow.
    if (header.half_edges % 3 != 0 || header.corners > header.half_edges ||
        !check_counts(header.half_edges / 3, header.vertices) ||
        bytes.size() != saved_size(header)) {
        return invalid("the saved mesh is not complete");
    }
    Checksum sum;
    std::memcpy(&sum, bytes.data() + bytes.size() - sizeof sum, sizeof sum);
    if (kComparesChecksums && sum != checksum_of(bytes.first(bytes.size() - sizeof sum))) {
        return invalid("the saved mesh is damaged");
    }
    return header;
}

bool is_empty(const HalfEdge& edge) {
    return edge.length == 0 && edge.apex_x == 0 && edge.apex_y == 0;
}

/// Returns true if the three frames of a face describe one triangle, up to rounding.
bool frames_agree(const HalfEdge* edges) {
    constexpr double kLargest = 1e102;   // Coordinates and lengths are at most 1e100.
    constexpr double kSmallest = 1e-150; // Squares of smaller lengths lose digits.
    constexpr double kAgreement = 1e-5;  // Lengths may violate the triangle inequality by 1e-6.
    double longest = 0, shortest = kLargest;
    for (std::size_t k = 0; k < 3; ++k) {
        const HalfEdge& edge = edges[k];
        if (!(edge.length >= 0 && edge.length <= kLargest && edge.apex_y >= 0 &&
              edge.apex_y <= kLargest && std::abs(edge.apex_x) <= kLargest)) {
            return false;
        }
        longest = std::max(longest, edge.length);
        shortest = std::min(shortest, edge.length);
    }
    bool agree = true;
    for (std::size_t k = 0; k < 3 && shortest >= kSmallest; ++k) {
        const HalfEdge& edge = edges[k];
        const double rest = edge.length - edge.apex_x;
        const double height2 = edge.apex_y * edge.apex_y;
        const double previous = std::sqrt(edge.apex_x * edge.apex_x + height2);
        const double next = std::sqrt(rest * rest + height2);
        agree &= std::abs(previous - edges[(k + 2) % 3].length) <= kAgreement * longest &&
                 std::abs(next - edges[(k + 1) % 3].length) <= kAgreement * longest;
    }
    return agree;
}

/// Checks everything except the header.
class Loader {
  public:
    Loader(const ThreadOptions& threads, const Header& header, std::span<const std::byte> bytes)
        : threads_(threads), header_(header), shapes_(bytes, header.half_edges),
          saved_links_(bytes, header.half_edges), saved_fans_(bytes, header.vertices),
          saved_corners_(bytes, header.corners) {}

    Result<Done> load(UninitializedVector<HalfEdge>& half_edges, std::vector<VertexFan>& fans,
                      std::vector<std::uint32_t>& corners, MeshStatistics& statistics) {
        half_edges.resize(header_.half_edges);
        links_.resize(header_.half_edges);
        fans.resize(header_.vertices);
        corners.resize(header_.corners);
        saved_fans_.read(0, fans.size(), fans.data());
        saved_corners_.read(0, corners.size(), corners.data());
        GEODISK_TRY(load_faces(half_edges, fans, statistics));
        GEODISK_TRY(check_edges(statistics));
        if (auto checked = check_agreement(half_edges); !checked) {
            return invalid(checked.error().message, checked.error().element);
        }
        GEODISK_TRY(check_fans(fans, corners, statistics));
        return check_statistics(statistics);
    }

  private:
    /// Loads half-edges and links and computes what follows from them. Afterwards all vertex
    /// indices are in range and the angles of corners fit.
    Result<Done> load_faces(std::span<HalfEdge> half_edges, std::span<const VertexFan> fans,
                            MeshStatistics& statistics) {
        const std::size_t faces = half_edges.size() / 3;
        std::vector<std::size_t> wrong(block_count(faces),
                                       faces); // First wrong face of each block.
        UninitializedVector<double> areas(faces);
        std::vector<MeshStatistics> blocks(block_count(faces));
        for_blocks(threads_, faces, [&](std::size_t begin, std::size_t end) {
            saved_links_.read(3 * begin, 3 * end, &links_[3 * begin]);
            for (std::size_t f = end; f-- > begin;) {
                HalfEdge edges[3];
                if (!load_face(f, fans, edges)) {
                    wrong[begin / kBlock] = f;
                }
                areas[f] = add_face(takes_part(face_of(f)), edges, blocks[begin / kBlock]);
                std::copy_n(edges, 3, &half_edges[3 * f]);
            }
        });
        const std::size_t first = *std::min_element(wrong.begin(), wrong.end());
        if (first < faces) {
            return invalid("face " + std::to_string(first) + " of the saved mesh is no triangle",
                           first);
        }
        sum_up(areas, blocks, statistics);
        return Done{};
    }

    bool load_face(std::size_t f, std::span<const VertexFan> fans, HalfEdge (&edges)[3]) const {
        for (std::size_t k = 0; k < 3; ++k) {
            const Link& link = links_[3 * f + k];
            const Shape shape = shapes_[3 * f + k];
            edges[k] = {shape.length, shape.apex_x, shape.apex_y,
                        link.origin,  link.around,  link.angle};
            if (link.origin >= header_.vertices) {
                return false;
            }
        }
        if (!takes_part(face_of(f))) {
            return is_empty(edges[0]) && is_empty(edges[1]) && is_empty(edges[2]);
        }
        if (!frames_agree(edges)) {
            return false;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t packed = pack_corner_angle(edges[k], edges[(k + 2) % 3]);
            const bool is_regular = (fans[edges[k].origin].flags & gpu::kFanIrregular) == 0;
            if (is_regular && !angles_fit(edges[k].fan_angles, packed)) {
                return false;
            }
        }
        return true;
    }

    /// Checks the cycles of half-edges around edges, and counts them.
    Result<Done> check_edges(MeshStatistics& statistics) const {
        const std::size_t count = links_.size();
        std::vector<bool> seen(count, false);
        for (std::uint32_t first = 0; first < count; ++first) {
            std::uint32_t size = 0;
            for (std::uint32_t h = first; !seen[h]; ++size) {
                seen[h] = true;
                const std::uint32_t next = around_half_edge(links_[h].around);
                // Each half-edge is visited once, so a cycle can only end where it began.
                if (next >= count || !shares_edge(h, next) || (seen[next] && next != first)) {
                    return invalid("the links of face " + std::to_string(h / 3) +
                                       " in the saved mesh are wrong",
                                   h / 3);
                }
                h = next;
            }
            if (takes_part(face_of(first / 3))) {
                statistics.boundary_edges += size == 1;
                statistics.nonmanifold_edges += size > 2;
            } else if (size > 1) {
                return invalid("face " + std::to_string(first / 3) +
                                   " of the saved mesh names a vertex twice and has neighbours",
                               first / 3);
            }
        }
        return Done{};
    }

    /// Returns true if the half-edges run between the same vertices, in the direction that the
    /// first one says.
    bool shares_edge(std::uint32_t h, std::uint32_t next) const {
        const std::uint32_t from = links_[h].origin, to = links_[next_in_face(h)].origin;
        const std::uint32_t other_from = links_[next].origin;
        const std::uint32_t other_to = links_[next_in_face(next)].origin;
        return around_same_way(links_[h].around) ? from == other_from && to == other_to
                                                 : from == other_to && to == other_from;
    }

    /// Checks that every corner is in the fan of its vertex, and that fans are as FanBuilder makes
    /// them.
    Result<Done> check_fans(std::span<const VertexFan> fans, std::span<const std::uint32_t> corners,
                            MeshStatistics& statistics) {
        std::uint64_t total = 0;
        std::vector<bool> seen(links_.size(), false);
        for (std::uint32_t v = 0; v < fans.size(); ++v) {
            const VertexFan& fan = fans[v];
            if (fan.first_corner != total || fan.corner_count > corners.size() - total) {
                return wrong_fan(v);
            }
            total += fan.corner_count;
            statistics.vertices += fan.corner_count > 0;
            for (const std::uint32_t corner : corners.subspan(fan.first_corner, fan.corner_count)) {
                if (corner >= links_.size() || links_[corner].origin != v || seen[corner] ||
                    !takes_part(face_of(corner / 3))) {
                    return wrong_fan(v);
                }
                seen[corner] = true;
            }
        }
        if (total != corners.size() ||
            total != 3 * (statistics.triangles - statistics.repeated_index_faces)) {
            return invalid("the saved mesh lacks corners");
        }
        std::vector<std::uint32_t> wrong(block_count(fans.size()), ~0u);
        for_blocks(threads_, fans.size(), [&](std::size_t begin, std::size_t end) {
            FanBuilder builder(links_);
            for (std::size_t v = end; v-- > begin;) {
                const VertexFan& fan = fans[v];
                if (!builder.fits(static_cast<std::uint32_t>(v), fan,
                                  corners.subspan(fan.first_corner, fan.corner_count))) {
                    wrong[begin / kBlock] = static_cast<std::uint32_t>(v);
                }
            }
        });
        const std::uint32_t first = *std::min_element(wrong.begin(), wrong.end());
        return first == ~0u ? Result<Done>(Done{}) : wrong_fan(first);
    }

    static Error wrong_fan(std::uint32_t v) {
        return invalid(
            "the corners of vertex " + std::to_string(v) + " in the saved mesh are wrong", v);
    }

    /// Copies the statistics that do not follow from the rest.
    Result<Done> check_statistics(MeshStatistics& statistics) const {
        statistics.components = header_.components;
        statistics.coinciding_border_edges = header_.coinciding_border_edges;
        statistics.diagonal = header_.diagonal;
        const bool has_box = statistics.diagonal > 0;
        const double extent = has_box ? statistics.diagonal : statistics.longest_edge;
        if (!std::isfinite(statistics.diagonal) || std::signbit(statistics.diagonal) ||
            (has_box && statistics.longest_edge > statistics.diagonal * (1 + 1e-9)) ||
            !has_area(statistics.area, extent) || statistics.components == 0 ||
            statistics.components > statistics.vertices ||
            statistics.coinciding_border_edges > statistics.boundary_edges) {
            return invalid("the statistics of the saved mesh contradict it");
        }
        return Done{};
    }

    std::array<std::uint32_t, 3> face_of(std::size_t f) const {
        return {links_[3 * f].origin, links_[3 * f + 1].origin, links_[3 * f + 2].origin};
    }

    const ThreadOptions& threads_;
    const Header& header_;
    Stored<Shape> shapes_;
    Stored<Link> saved_links_;
    Stored<VertexFan> saved_fans_;
    Stored<std::uint32_t> saved_corners_;
    UninitializedVector<Link> links_;
};

} // namespace

Result<std::vector<std::byte>> PreparedMesh::save() const noexcept {
    return guarded([&]() -> Result<std::vector<std::byte>> {
        Header header{{},
                      kVersion,
                      kByteOrder,
                      half_edges_.size(),
                      fans_.size(),
                      corners_.size(),
                      statistics_.components,
                      statistics_.coinciding_border_edges,
                      statistics_.diagonal};
        std::memcpy(header.magic, kMagic, sizeof kMagic);
        Writer writer(saved_size(header));
        writer.put(&header, 1);
        for (const HalfEdge& edge : half_edges_) {
            const Shape shape{edge.length, edge.apex_x, edge.apex_y};
            writer.put(&shape, 1);
        }
        for (const HalfEdge& edge : half_edges_) {
            const Link link{edge.origin, edge.around, edge.fan_angles};
            writer.put(&link, 1);
        }
        writer.put(fans_.data(), fans_.size());
        writer.put(corners_.data(), corners_.size());
        return writer.finish();
    });
}

Result<PreparedMesh> PreparedMesh::load(std::span<const std::byte> bytes,
                                        const ThreadOptions& threads) noexcept {
    return guarded([&]() -> Result<PreparedMesh> {
        GEODISK_TRY(check_threads(threads));
        const auto header = read_header(bytes);
        GEODISK_TRY(header);
        PreparedMesh mesh;
        Loader loader(threads, *header, bytes.subspan(sizeof(Header)));
        if (auto loaded =
                loader.load(mesh.half_edges_, mesh.fans_, mesh.corners_, mesh.statistics_);
            !loaded) {
            return loaded.error();
        }
        return mesh;
    });
}

} // namespace geodisk
