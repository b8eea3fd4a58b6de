#include "parts/ranges/directory.hpp"

#include <algorithm>
#include <utility>

#include <geodisk/detail/vertex_sets.hpp>

#include "mesh/connectivity.hpp"

namespace geodisk {
namespace {

bool face_takes_part(const WholeFace& face) {
    return takes_part({face.corners[0], face.corners[1], face.corners[2]});
}

VertexNumbers vertices_of(std::span<const WholeFace> faces) {
    std::vector<std::uint32_t> vertices;
    vertices.reserve(3 * faces.size());
    for (const WholeFace& face : faces) {
        if (face_takes_part(face)) {
            vertices.insert(vertices.end(), face.corners, face.corners + 3);
        }
    }
    return VertexNumbers(std::move(vertices));
}

/// A vertex, and the piece that it belongs to at a process.
struct HolderEntry {
    std::uint32_t vertex, piece;
};

/// A piece of a process.
struct Piece {
    std::uint32_t process, number;
    auto operator<=>(const Piece&) const = default;
};
/// Two pieces with a common vertex.
struct Contact {
    Piece a, b;
    auto operator<=>(const Contact&) const = default;
};

/// Joins the pieces of all processes, at the first one.
void join(Talk& talk, std::vector<Contact> own, WholeComponents& components) {
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    ByProcess<Contact> sent(talk.size());
    sent[0] = std::move(own);
    const auto received = talk.all_to_all(std::move(sent));
    std::vector<std::uint32_t> firsts{0};
    for (const std::uint32_t count : components.pieces) {
        firsts.push_back(firsts.back() + count);
    }
    VertexSets sets(talk.rank() == 0 ? firsts.back() : 0);
    std::uint64_t joins = 0;
    for (const auto& some : received) {
        for (const Contact& contact : some) {
            joins += sets.join(firsts[contact.a.process] + contact.a.number,
                               firsts[contact.b.process] + contact.b.number)
                         ? 1u
                         : 0u;
        }
    }
    if (talk.rank() == 0) {
        for (std::uint32_t piece = 0; piece < firsts.back(); ++piece) {
            components.of_pieces.push_back(sets.lowest(piece));
        }
    }
    components.count = firsts.back() - talk.sum(joins);
}

} // namespace

Directory Directory::create(Talk& talk, const MeshBlocks& vertices,
                            std::span<const WholeFace> faces) {
    Directory directory;
    directory.first_ = vertices.first(talk.rank());
    const VertexNumbers numbers = vertices_of(faces);
    std::vector<std::uint32_t> pieces(numbers.size());
    WholeComponents& components = directory.components_;
    {
        VertexSets sets(numbers.size());
        for (const WholeFace& face : faces) {
            if (face_takes_part(face)) {
                const std::uint32_t vertex = numbers.of(face.corners[0]);
                sets.join(vertex, numbers.of(face.corners[1]));
                sets.join(vertex, numbers.of(face.corners[2]));
            }
        }
        std::uint32_t count = 0;
        for (std::uint32_t vertex = 0; vertex < pieces.size(); ++vertex) {
            const std::uint32_t lowest = sets.lowest(vertex);
            pieces[vertex] = lowest == vertex ? count++ : pieces[lowest];
        }
        components.pieces = talk.all(count);
    }
    std::vector<Contact> contacts;
    directory.starts_.reserve(vertices.size(talk.rank()) + 1);
    directory.starts_.push_back(0);
    const std::uint64_t turns = turns_for(vertices.each() * 4 * sizeof(HolderEntry));
    for (std::uint64_t turn = 0; turn < turns; ++turn) {
        const auto begin_of = [&](std::uint32_t home, std::uint64_t at) {
            return vertices.first(home) + vertices.size(home) * at / turns;
        };
        ByProcess<HolderEntry> sent(talk.size());
        for (std::uint32_t home = 0; home < talk.size(); ++home) {
            const auto& all = numbers.vertices();
            const auto first = std::ranges::lower_bound(all, begin_of(home, turn));
            const auto last = std::ranges::lower_bound(all, begin_of(home, turn + 1));
            for (auto at = first; at != last; ++at) {
                sent[home].push_back({*at, pieces[static_cast<std::size_t>(at - all.begin())]});
            }
        }
        const auto received = talk.all_to_all(std::move(sent));
        std::vector<std::size_t> next(talk.size(), 0);
        ByProcess<std::uint32_t> shared(talk.size());
        const std::uint64_t end = begin_of(talk.rank(), turn + 1);
        for (std::uint64_t vertex = begin_of(talk.rank(), turn); vertex < end; ++vertex) {
            const std::size_t before = directory.holders_.size();
            Piece last{};
            for (std::uint32_t process = 0; process < talk.size(); ++process) {
                const auto& entries = received[process];
                if (next[process] < entries.size() && entries[next[process]].vertex == vertex) {
                    const Piece piece{process, entries[next[process]++].piece};
                    if (directory.holders_.size() > before) {
                        contacts.push_back({last, piece});
                    }
                    last = piece;
                    directory.holders_.push_back(process);
                }
            }
            const std::size_t count = directory.holders_.size() - before;
            for (std::size_t i = before; i < before + count && count > 1; ++i) {
                shared[directory.holders_[i]].push_back(static_cast<std::uint32_t>(vertex));
            }
            components.vertices += count > 0;
            directory.starts_.push_back(static_cast<std::uint32_t>(directory.holders_.size()));
        }
        for (const auto& some : talk.all_to_all(std::move(shared))) {
            directory.shared_.insert(directory.shared_.end(), some.begin(), some.end());
        }
    }
    directory.holders_.shrink_to_fit();
    std::sort(directory.shared_.begin(), directory.shared_.end());
    components.vertices = talk.sum(components.vertices);
    join(talk, std::move(contacts), components);
    if (components.count > 1) {
        for (const WholeFace& face : faces) {
            directory.pieces_.push_back(face_takes_part(face) ? pieces[numbers.of(face.corners[0])]
                                                              : 0);
        }
    }
    return directory;
}

} // namespace geodisk
