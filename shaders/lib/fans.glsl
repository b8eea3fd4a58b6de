// The fans of the vertices, and what lies behind them.
#ifndef GEODISK_FANS_GLSL
#define GEODISK_FANS_GLSL

GEODISK_ROWS(kBindFans, fans);

#endif
