#include "parts/mesh_turn.hpp"

#include "mesh/mesh_pieces.hpp"
#include "support/free_memory.hpp"

namespace geodisk {

MeshTurn::MeshTurn(Exchange& exchange, Part& part) : turn_(exchange.turn()), part_(part) {
    if (part.of_mesh != nullptr) {
        part.mesh = MeshPieces::part(*part.of_mesh, part.faces);
        part.ranks = Ranks(part.of_mesh->face_count(), part.faces);
        if (part.of_radii != nullptr) {
            part.radii = part.of_radii->on_part(part.mesh, part.faces);
        }
    } else if (!part.places.triangles.empty()) {
        part.mesh = MeshPieces::piece(MeshView{part.places.positions, part.places.triangles, 3},
                                      part.whole);
        if (!part.places.radii.factors.empty()) {
            part.radii = RadiusPieces::piece(part.mesh, part.places.radii, part.places.of_whole);
        }
        if (!turn_) {
            part.places = {};
        }
    }
}

MeshTurn::~MeshTurn() {
    if (part_.of_mesh != nullptr || (turn_ && !part_.places.triangles.empty())) {
        part_.mesh = {};
        part_.ranks = {};
        part_.radii.reset();
    }
    if (turn_) { // Other parts have other threads.
        trim_memory();
    }
}

} // namespace geodisk
