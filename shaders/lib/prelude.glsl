// Included first by every kernel.
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

// Returns the work group within a pass, which may be cut into several dispatches.
uint own_group() { return push.first_group + gl_WorkGroupID.x; }

#endif
