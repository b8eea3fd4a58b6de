// Readies the slots that select has filled with ranks, where disks are found by a grid in space. A
// sample of an earlier chunk has no place among the candidates; its point goes behind theirs. Needs
// draw_point(rank) and words_per_point().
#ifndef GEODISK_GRID_ACTIVATE_GLSL
#define GEODISK_GRID_ACTIVATE_GLSL

#include "point_words.glsl"
#include "ready_slot.glsl"

layout(local_size_x_id = 0) in;

GEODISK_BUFFER(kBindPoints, writeonly, uint, points);

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (!is_due(slot)) {
        return;
    }
    uint rank = rank_of(slot);
    ready_slot(slot, uvec4(rank, 0u, 0u, 0u));
    if (is_settled(rank)) {
        uint point[kMostAxes] = draw_point(rank);
        PointWords words = words_of_settled(slot, words_per_point());
        for (uint i = 0u; i < words_per_point(); ++i) {
            points[words.first + i * words.stride] = point[i];
        }
    }
}

#endif
