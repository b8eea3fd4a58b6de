// Declarations of buffers. Many kernels are compiled twice. With GEODISK_TEXELS, a kernel reads through
// texel buffers what no invocation of the dispatch writes, or only the invocation itself. On lavapipe a
// load from a storage buffer is a loop over lanes and words; a texel fetch is a few gathers at less than
// half the cost.
#ifndef GEODISK_BUFFERS_GLSL
#define GEODISK_BUFFERS_GLSL

#define GEODISK_BUFFER(number, access, type, name)                                                 \
    layout(set = 0, binding = number, std430) restrict access buffer name##_buffer { type name[]; }

// Read-only buffers: words and rows of four words, with word_at and row_at.
#ifdef GEODISK_TEXELS
#define GEODISK_WORDS(number, name) layout(set = 0, binding = number) uniform usamplerBuffer name
#define GEODISK_ROWS(number, name) GEODISK_WORDS(number, name)
#define word_at(name, i) texelFetch(name, int(i)).x
#define row_at(name, i) texelFetch(name, int(i))
#else
#define GEODISK_WORDS(number, name) GEODISK_BUFFER(number, readonly, uint, name)
#define GEODISK_ROWS(number, name) GEODISK_BUFFER(number, readonly, uvec4, name)
#define word_at(name, i) name[i]
#define row_at(name, i) name[i]
#endif

// Rows that an invocation writes and reads back itself: written as name[i], read with own_row_at. Two
// names of one memory, neither `restrict` and both `coherent`, so that reads see earlier writes.
#ifdef GEODISK_TEXELS
#define GEODISK_OWN_ROWS(number, texels_number, name)                                              \
    layout(set = 0, binding = number, std430) coherent buffer name##_buffer { uvec4 name[]; };     \
    layout(set = 0, binding = texels_number, rgba32ui) uniform coherent readonly uimageBuffer      \
        name##_texels
#define own_row_at(name, i) imageLoad(name##_texels, int(i))
#else
#define GEODISK_OWN_ROWS(number, texels_number, name) GEODISK_BUFFER(number, , uvec4, name)
#define own_row_at(name, i) name[i]
#endif

// Rows that all invocations of a work group write and read, with a barrier between: written as name[i],
// read with own_row_at.
#ifdef GEODISK_TEXELS
#define GEODISK_GROUP_ROWS(number, texels_number, name) GEODISK_OWN_ROWS(number, texels_number, name)
#else
#define GEODISK_GROUP_ROWS(number, texels_number, name) GEODISK_BUFFER(number, coherent, uvec4, name)
#endif

// Words that are read with word_before, before any invocation of the dispatch writes them.
#ifdef GEODISK_TEXELS
#define GEODISK_WORDS_BEFORE(number, texels_number, name)                                          \
    layout(set = 0, binding = number, std430) buffer name##_buffer { uint name[]; };               \
    layout(set = 0, binding = texels_number) uniform usamplerBuffer name##_texels
#define word_before(name, i) texelFetch(name##_texels, int(i)).x
#else
#define GEODISK_WORDS_BEFORE(number, texels_number, name) GEODISK_BUFFER(number, , uint, name)
#define word_before(name, i) name[i]
#endif

// The control record and the slots after it, shared by all work groups of a dispatch. Only atomics touch
// what another invocation may write.
#define GEODISK_CONTROL                                                                            \
    layout(set = 0, binding = kBindControl, std430) coherent buffer control_buffer {               \
        ControlRec control;                                                                        \
        SlotRec slots[];                                                                           \
    }

// Reads a word that other invocations of the dispatch may be changing.
#define atomic_load(word) atomicOr(word, 0u)

// Adds to a 64-bit sum in two words.
#define GEODISK_ADD_WIDE(low, high, summand)                                                       \
    {                                                                                              \
        uint before = atomicAdd(low, summand);                                                     \
        if (before + (summand) < before) {                                                         \
            atomicAdd(high, 1u);                                                                   \
        }                                                                                          \
    }

// The push block. Kernels of long loops keep a copy of it and of the constants of the job, which stays in
// registers: lavapipe gathers, lane by lane, what is read of either in a branch.
#ifdef GEODISK_KEEPS_CONSTANTS
#define GEODISK_PUSH(type)                                                                         \
    layout(push_constant, std430) uniform push_block { type push_given; };                         \
    type push
#else
#define GEODISK_PUSH(type)                                                                         \
    layout(push_constant, std430) uniform push_block { type push; }
#endif

#endif
