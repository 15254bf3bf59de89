#pragma once

#include <cstddef>
#include <cstring>

// Loops that are compiled for wide registers too, and chosen when the program is loaded, by what
// the processor can do. Where these fuse products and sums, radii are others than elsewhere; both
// are right.
#if defined(__GNUC__) && __GNUC__ >= 12 && !defined(__clang__) && defined(__x86_64__) && \
    defined(__linux__) && !defined(__SANITIZE_ADDRESS__)
#define CASIMIR_FOR_WIDE_REGISTERS \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define CASIMIR_FOR_WIDE_REGISTERS
#endif
#define CASIMIR_INLINE_ALWAYS [[gnu::always_inline]] inline

namespace casimir::validated {

/// So many doubles side by side, in one register or some.
template <std::size_t kLanes>
struct LanesType {
  typedef double type __attribute__((vector_size(8 * kLanes)));
};
template <std::size_t kLanes>
using LanesOf = typename LanesType<kLanes>::type;

/// Those that begin at a place: by reference, since values of this type have no one way out of
/// functions.
template <std::size_t kLanes>
CASIMIR_INLINE_ALWAYS void load(LanesOf<kLanes>& lanes, const double* place) {
  std::memcpy(&lanes, place, sizeof lanes);
}

/// The sizes of numbers: their signs taken away.
template <std::size_t kLanes>
CASIMIR_INLINE_ALWAYS void absolute(LanesOf<kLanes>& lanes) {
  typedef long long Bits __attribute__((vector_size(8 * kLanes)));
  Bits bits;
  std::memcpy(&bits, &lanes, sizeof bits);
  bits &= 0x7fffffffffffffffLL;
  std::memcpy(&lanes, &bits, sizeof bits);
}

}  // namespace casimir::validated
