// Knots of a scale for amounts, from dark to light, sRGB: cividis (Nunez, Anderton and Renslow 2018),
// whose lightness grows evenly and which people of any colour vision see alike. What is between the
// parentheses of an array, in C++ with GLM and in GLSL.
vec3(0.000, 0.135, 0.305), vec3(0.139, 0.228, 0.421), vec3(0.338, 0.360, 0.427),
vec3(0.486, 0.482, 0.471), vec3(0.654, 0.615, 0.436), vec3(0.835, 0.760, 0.346),
vec3(0.995, 0.910, 0.218)
