// Lengths in mesh units, from the units of a job, as the host computes them: the product in double precision,
// rounded to it and then to single precision. Integers alone, so that all devices agree.
#ifndef GEODISK_SCALED_GLSL
#define GEODISK_SCALED_GLSL

const int kDoubleBits = 53;
const int kFloatBits = 24;
const int kFloatExponent = -149; // of the lowest bit of the smallest floats
const uint kInfinite = 0x7f800000u;

// A whole number of 96 bits.
struct Wide {
    uint low;
    uint middle;
    uint high;
};

int top_bit(Wide a) {
    return a.high != 0u ? 64 + findMSB(a.high) : (a.middle != 0u ? 32 + findMSB(a.middle) : findMSB(a.low));
}

// Returns a shifted to the right by 0 to 31 bits.
Wide shifted_some(Wide a, uint by) {
    if (by == 0u) {
        return a;
    }
    return Wide(a.low >> by | a.middle << (32u - by), a.middle >> by | a.high << (32u - by),
                a.high >> by);
}

// Returns a without its lowest bits, so many, rounded to the nearest, of two to the even one.
Wide rounded_off(Wide a, int bits) {
    if (bits <= 0) {
        return a;
    }
    if (bits > 96) {
        return Wide(0u, 0u, 0u);
    }
    uint by = uint(bits);
    uvec3 words = uvec3(a.low, a.middle, a.high);
    // The highest bit that goes, and whether one below it is set.
    uint half_at = by - 1u;
    uint half_bit = (words[half_at >> 5] >> (half_at & 31u)) & 1u;
    uint below = words[half_at >> 5] & ((1u << (half_at & 31u)) - 1u);
    below |= half_at >= 32u ? words.x : 0u;
    below |= half_at >= 64u ? words.y : 0u;
    Wide whole = by >= 96u   ? Wide(0u, 0u, 0u)
                 : by >= 64u ? Wide(a.high, 0u, 0u)
                 : by >= 32u ? Wide(a.middle, a.high, 0u)
                             : a;
    whole = shifted_some(whole, by & 31u);
    if (half_bit != 0u && (below != 0u || (whole.low & 1u) != 0u)) {
        ++whole.low;
        whole.middle += whole.low == 0u ? 1u : 0u;
        whole.high += whole.low == 0u && whole.middle == 0u ? 1u : 0u;
    }
    return whole;
}

// Returns the word of the float nearest to a length of so many units. Words of floats that are not negative
// compare as the floats do.
uint in_mesh_units(uint length_word) {
    uint stored = length_word >> 23;
    uint mantissa = length_word & 0x7fffffu;
    mantissa |= stored != 0u ? 0x800000u : 0u;
    int exponent = int(max(stored, 1u)) - 150 + push.unit_exponent;
    if (mantissa == 0u) {
        return 0u;
    }
    uint high;
    uint low;
    umulExtended(mantissa, push.unit_low, high, low);
    uint more_high;
    uint more_low;
    umulExtended(mantissa, push.unit_high, more_high, more_low);
    uint carry;
    high = uaddCarry(high, more_low, carry);
    Wide product = Wide(low, high, more_high + carry);
    int surplus = max(top_bit(product) + 1 - kDoubleBits, 0);
    product = rounded_off(product, surplus);
    exponent += surplus;
    surplus = max(top_bit(product) + 1 - kFloatBits, kFloatExponent - exponent);
    product = rounded_off(product, surplus);
    exponent += max(surplus, 0);
    // Mantissas of fewer bits than a float has, or exact ones, are shifted up, as far as exponents
    // go.
    uint rounded = product.low;
    int up = clamp(kFloatBits - 1 - findMSB(rounded), 0, max(exponent - kFloatExponent, 0));
    if (rounded == 0u) {
        return 0u;
    }
    rounded <<= uint(up);
    exponent -= up;
    // A carry into the next bit fits the exponent: the mantissa is then even.
    if (rounded >= 0x1000000u) {
        rounded >>= 1;
        ++exponent;
    }
    if (rounded < 0x800000u) {
        return rounded; // Exponent of the smallest floats.
    }
    int shifted = exponent - kFloatExponent + 1;
    return shifted >= 255 ? kInfinite : uint(shifted) << 23 | (rounded & 0x7fffffu);
}

#endif
