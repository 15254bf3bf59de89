#pragma once

// What a loop of steps is made of: functions that are written out where they are called.
#define CASIMIR_INLINE inline __attribute__((always_inline))
#define CASIMIR_INLINE_LAMBDA __attribute__((always_inline))
