// Sums of 64 bits in two words of a buffer.
#ifndef GEODISK_WIDE_GLSL
#define GEODISK_WIDE_GLSL

#define GEODISK_ADD_WIDE(low, high, summand)                                                       \
    {                                                                                              \
        uint before = atomicAdd(low, summand);                                                     \
        if (before + (summand) < before) {                                                         \
            atomicAdd(high, 1u);                                                                   \
        }                                                                                          \
    }

#endif
