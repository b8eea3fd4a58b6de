// Candidates in a box (paper section 5.9), drawn by cells about as wide as the minimum distance. Each is
// a pure function of the seed, its cell, its stage and its number there. A larger box keeps those of the
// cells that a smaller one has. One word per coordinate, in steps of its axis.
#ifndef GEODISK_BOX_CANDIDATE_GLSL
#define GEODISK_BOX_CANDIDATE_GLSL

#include "job.glsl"
#include "grid.glsl"
#include "poisson.glsl"
#include "rng.glsl"
#include "unit.glsl"

uint words_per_point() { return kDimension; }

// A cell for drawing: its index along each axis, and its width in steps; 0 for 2^32.
struct DrawCell {
    uint first[kMaxAxes];
    uint width[kMaxAxes];
    uvec2 seed;
};

DrawCell load_draw_cell(uint cell) {
    DrawCell c;
    uint at[kMaxAxes] = uint[kMaxAxes](0u, 0u, 0u, 0u, 0u, 0u);
    for (uint i = 0u; i < kDimension; ++i) {
        uvec4 row = row_at(axes, kAxisRows * i + 1u);
        at[i] = cell % row.x;
        cell /= row.x;
        c.first[i] = at[i] * row.y;
        c.width[i] = at[i] + 1u == row.x ? row.z : row.y;
    }
    c.seed = philox(uvec2(job.seed_low, job.seed_high), uvec4(at[0], at[1], at[2], kCellSeed)).xy;
    if (kDimension > 3u) {
        c.seed = philox(c.seed, uvec4(at[3], at[4], at[5], kCellSeed)).xy;
    }
    return c;
}

// Returns the expected number of candidates of a cell per stage.
float mean_count(uint cell) {
    DrawCell c = load_draw_cell(cell);
    float mean = push.intensity;
    for (uint i = 0u; i < kDimension; ++i) {
        uint width = c.width[i];
        precise float steps = float(width >> 16) * 65536.0 + float(width & 0xffffu);
        steps = width == 0u ? 4294967296.0 : steps;
        precise float less = mean * (steps * load_axis(i).unit);
        mean = less;
    }
    return mean;
}

uint stages_of(uint cell) { return kAllStages; }
uvec3 count_key(uint cell) { return uvec3(load_draw_cell(cell).seed, kCountNumber); }

// Returns the random words for its count in a stage of the job.
uvec4 count_words(uvec3 key, uint stage) { return philox(key.xy, uvec4(key.z, stage, 0u, 0u)); }

// Draws a candidate in a cell; `stage` is that of the job.
uint[kMaxAxes] draw_in_cell(uint cell, uint stage, uint number, out uint priority) {
    DrawCell c = load_draw_cell(cell);
    uvec4 a = philox(c.seed, uvec4(number, stage, 0u, 0u));
    uvec4 b = kDimension > 3u ? philox(c.seed, uvec4(number, stage, 1u, 0u)) : uvec4(0u);
    uint words[kMaxAxes] = uint[kMaxAxes](a.y, a.z, a.w, b.x, b.y, b.z);
    for (uint i = 0u; i < kDimension; ++i) {
        uint high, low;
        umulExtended(words[i], c.width[i], high, low);
        words[i] = c.first[i] + (c.width[i] == 0u ? words[i] : high);
    }
    priority = a.x >> (32u - kPriorityBits);
    return words;
}

// Draws the candidate with this number in its unit. The words of its sample are its order, its cell, its
// number there, and its stage.
uint[kMaxAxes] draw_point(Unit unit, uint number, out uvec4 record) {
    uint stage = push.first_stage + unit.stage;
    uint priority;
    uint point[kMaxAxes] = draw_in_cell(unit.owner, stage, number, priority);
    record = uvec4(unit.stage << kPriorityBits | priority, unit.owner, number, stage);
    return point;
}

uint[kMaxAxes] point_of(uvec4 record) {
    uint priority;
    return draw_in_cell(record.y, record.w, record.z, priority);
}

#endif
