// What both surface shaders begin with: the records of tools/picture, in textures of kTexelsPerRow texels
// a row (data.js).
precision highp float;
precision highp int;
precision highp sampler2D;

uniform sampler2D faces; // Two texels each: longest, apex_x, apex_y, base; columns, rows, first_cell.

const uint kRowBits = 12u;

ivec2 texel(uint index) {
    return ivec2(index & ((1u << kRowBits) - 1u), index >> kRowBits);
}
