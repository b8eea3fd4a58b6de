// The constants of the job, as `job`. Only kernels that use them declare them: the host binds what a
// kernel declares.
#ifndef GEODISK_JOB_GLSL
#define GEODISK_JOB_GLSL

#ifdef GEODISK_KEEPS_CONSTANTS
layout(set = 0, binding = kBindConstants, std140) uniform job_block { JobRec job_existing; };
JobRec job;

void keep_constants() {
    push = push_given;
    job = job_existing;
}
#else
layout(set = 0, binding = kBindConstants, std140) uniform job_block { JobRec job; };
#endif

#endif
