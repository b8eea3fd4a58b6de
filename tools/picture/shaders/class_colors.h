// Colours of classes, sRGB: those of Okabe and Ito (2008) except orange, which overlaps have, then
// three darker ones. What is between the parentheses of an array, in C++ and in GLSL.
vec3(0.000, 0.447, 0.698), vec3(0.000, 0.620, 0.451), vec3(0.800, 0.475, 0.655),
vec3(0.941, 0.894, 0.259), vec3(0.337, 0.706, 0.914), vec3(0.533, 0.133, 0.333),
vec3(0.400, 0.400, 0.400), vec3(0.600, 0.600, 0.200)
