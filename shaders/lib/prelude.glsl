// What every kernel starts with.
#ifndef GEODISK_PRELUDE_GLSL
#define GEODISK_PRELUDE_GLSL

#include "../shared/bindings.h"
#include "../shared/constants.h"
#include "../shared/push.h"
#include "../shared/records.h"
#include "buffers.glsl"

GEODISK_PUSH;

#endif
