// How many candidates each face or box cell has in each stage, by the Poisson law (paper
// GenerateDensePoints, sections 3.3 and 4.2). One invocation per face or cell. Needs mean_count(cell),
// what one stage expects, and count_of(cell, stage, mean); tells counted(cell, number in all).
#ifndef GEODISK_COUNT_UNITS_GLSL
#define GEODISK_COUNT_UNITS_GLSL

layout(local_size_x_id = 0) in;

GEODISK_BUFFER(kBindStarts, writeonly, uint, starts);

void main() {
    uint cell = gl_WorkGroupID.y * (gl_NumWorkGroups.x * gl_WorkGroupSize.x) +
                gl_GlobalInvocationID.x;
    if (cell >= push.faces) {
        return;
    }
    float mean = mean_count(cell);
    uint sum = 0u;
    for (uint stage = 0u; stage < push.stages; ++stage) {
        uint count = count_of(cell, stage, mean);
        starts[cell * push.stages + stage] = count;
        sum += count;
    }
    counted(cell, sum);
}

#endif
