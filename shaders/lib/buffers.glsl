// How kernels declare the buffers they touch.
#ifndef GEODISK_BUFFERS_GLSL
#define GEODISK_BUFFERS_GLSL

#define GEODISK_BUFFER(number, access, type, name)                                                 \
    layout(set = 0, binding = number, std430) restrict access buffer name##_buffer { type name[]; }

// The run's record with the blocker words behind it; shared by all work groups of a dispatch, so
// only atomics touch what another invocation may write.
#define GEODISK_CONTROL                                                                            \
    layout(set = 0, binding = kBindControl, std430) restrict coherent buffer control_buffer {      \
        ControlRec control;                                                                        \
        uint blockers[];                                                                           \
    }

#define GEODISK_PUSH                                                                               \
    layout(push_constant, std430) uniform push_block { Push push; }

#endif
