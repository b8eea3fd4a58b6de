// Counts the candidates of each face or box cell in each stage, by the Poisson law (paper
// GenerateDensePoints, sections 3.3 and 4.2). One invocation per face or cell. Needs mean_count(cell),
// the expected number per stage; stages_of(cell), its number of stages; count_key(cell) and
// count_words(key, stage), random words; and counted(cell, total), which receives the result.
#ifndef GEODISK_COUNT_UNITS_GLSL
#define GEODISK_COUNT_UNITS_GLSL

#include "job.glsl"

layout(local_size_x_id = 0) in; // kSpecLocalSize

GEODISK_BUFFER(kBindStarts, writeonly, uint, starts);

void main() {
    uint cell = own_group() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (cell >= job.faces) {
        return;
    }
    float mean = mean_count(cell);
    bool has_any = mean >= kSmallestMean;
    // Shared by all stages explicitly: lavapipe's compiler would compute it for each.
    PoissonLaw law = poisson_law(mean);
    uvec3 key = count_key(cell);
    uint stages = stages_of(cell);
    uint sum = 0u;
    for (uint stage = 0u; stage < push.stages; ++stage) {
        uvec4 random = count_words(key, push.first_stage + stage);
        bool has_stage = push.first_stage + stage < stages;
        uint count = has_any && has_stage ? poisson(law, random.x, random.y) : 0u;
        starts[cell * push.stages + stage] = count;
        sum += count;
    }
    counted(cell, sum);
}

#endif
