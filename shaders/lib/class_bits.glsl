// Places of the classes of candidates: in the lowest bits of their orders, and in their weights.
#ifndef GEODISK_CLASS_BITS_GLSL
#define GEODISK_CLASS_BITS_GLSL

layout(constant_id = kSpecClasses) const bool kClasses = false;

// Returns the first weight word of a candidate as `draw` writes it.
uint weight_with_class(uint weight, uint order) {
    return kClasses ? weight | (order & kClassMask) << kClassShift : weight;
}

// Returns the weight in such a word, and its class.
uint weight_in(uint word) { return kClasses ? word & ((1u << kClassShift) - 1u) : word; }
uint class_in(uint word) { return word >> kClassShift; }

#endif
