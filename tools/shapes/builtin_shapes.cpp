#include "shapes/builtin_shapes.hpp"

#include <string>

#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/suggestion.hpp"
#include "shapes/shape_makers.hpp"

namespace geodisk::tools {
namespace {

constexpr BuiltinShape kShapes[] = {
    {"showpiece", "twisted ring with a ruffled fin and a deep fold; points around", 120, 60, 1200,
     make_showpiece},
    {"cube", "unit cube; parts per edge", 1, 1, 1000, make_cube},
    {"icosphere", "unit sphere; subdivision steps", 4, 0, 9, make_icosphere},
    {"torus-knot", "trefoil tube; points around", 32, 3, 800, make_torus_knot},
    {"lattice", "smooth frame of bars, genus 81; parts per bar width", 4, 1, 12, make_lattice},
    {"plate", "closed box of 1 x 1 x 0.01; parts per long edge", 32, 1, 2000, make_plate},
    {"drilled-plate", "plate with holes, cut into slivers as by CAD; holes per long edge", 20, 2,
     100, make_drilled_plate},
    {"folded-sheet", "open sheet in 5 layers 0.01 apart; parts per layer", 32, 1, 1000,
     make_folded_sheet},
    {"unfolded-sheet", "folded-sheet laid flat; parts per layer", 32, 1, 1000, make_unfolded_sheet},
    {"swiss-roll", "open sheet rolled up in 3 turns 0.05 apart; parts per turn", 48, 3, 1000,
     make_swiss_roll},
    {"unrolled-sheet", "swiss-roll laid flat; parts per turn", 48, 3, 1000, make_unrolled_sheet},
    {"crossed-sheet", "open sheet in a loop that crosses itself; parts across", 32, 1, 1000,
     make_crossed_sheet},
    {"uncrossed-sheet", "crossed-sheet laid flat; parts across", 32, 1, 1000, make_uncrossed_sheet},
    {"terrain", "square of hills; parts per edge", 160, 1, 4000, make_terrain},
    {"moebius", "one-sided strip; parts across the strip", 12, 1, 800, make_moebius},
    {"tube", "closed tube of length 1 and radius 0.0001; points around", 6, 3, 100000, make_tube},
    {"spike", "needle on a disk, 0.0000001 wide at its tip; points around", 12, 3, 100000,
     make_spike},
    {"cone", "open cone of height 1 and radius 0.001; points around", 8, 3, 100000, make_cone},
    {"clifford-torus", "flat torus in R^4; points around each circle", 64, 3, 3000,
     make_clifford_torus},
    {"klein-bottle", "one-sided, closed, in R^4; points around the tube", 48, 3, 2000,
     make_klein_bottle},
    {"veronese", "projective plane in R^4; subdivision steps", 5, 0, 9, make_veronese},
};

[[noreturn]] void fail_unknown(std::string_view name) {
    const std::vector<std::string> known = builtin_names("");
    fail_usage("unknown built-in shape " + in_quotes(name) + "; known are " + listed(known) +
               did_you_mean(name, known));
}

} // namespace

std::span<const BuiltinShape> builtin_shapes() {
    return kShapes;
}

std::vector<std::string> builtin_names(const std::string& prefix) {
    std::vector<std::string> names;
    for (const BuiltinShape& shape : kShapes) {
        names.push_back(prefix + std::string(shape.name));
    }
    return names;
}

MeshFile make_builtin(std::string_view name, std::optional<int> resolution) {
    for (const BuiltinShape& shape : kShapes) {
        if (shape.name != name) {
            continue;
        }
        const int value = resolution.value_or(shape.default_resolution);
        if (value < shape.min_resolution || value > shape.max_resolution) {
            fail_usage("builtin:" + std::string(name) + ": resolution must be " +
                       std::to_string(shape.min_resolution) + " to " +
                       std::to_string(shape.max_resolution) + ", not " + std::to_string(value));
        }
        MeshFile mesh = shape.make(value);
        mesh.positions.shrink_to_fit();
        mesh.triangles.shrink_to_fit();
        return mesh;
    }
    fail_unknown(name);
}

} // namespace geodisk::tools
