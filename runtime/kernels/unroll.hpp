#pragma once

// Before a loop over the components: written out in full for small systems, also at -O2.
#ifdef __clang__
#define CASIMIR_UNROLL _Pragma("unroll 16")
#else
#define CASIMIR_UNROLL _Pragma("GCC unroll 16")
#endif
