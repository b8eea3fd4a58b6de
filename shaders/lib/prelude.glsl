// What every kernel starts with.
#ifndef GEODISK_PRELUDE_GLSL
#define GEODISK_PRELUDE_GLSL

#include "../shared/bindings.h"
#include "../shared/constants.h"
#include "../shared/push.h"
#include "../shared/records.h"
#include "buffers.glsl"

#ifndef GEODISK_OWN_PUSH
#define GEODISK_OWN_PUSH Push
#endif
GEODISK_PUSH(GEODISK_OWN_PUSH);

// Passes over faces, candidates or samples are cut into several dispatches.
uint own_group() { return push.first_group + gl_WorkGroupID.x; }

#endif
