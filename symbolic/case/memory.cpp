#include "symbolic/case/memory.hpp"

#include <cln/malloc.h>
#include <flint/flint.h>
#include <gmp.h>

#include <cstdlib>
#include <new>

namespace casimir {
namespace {

void* checked(void* pointer) {
  if (pointer == nullptr) throw std::bad_alloc();
  return pointer;
}

void* allocate(std::size_t size) { return checked(std::malloc(size > 0 ? size : 1)); }
void* allocate_zero(std::size_t count, std::size_t size) {
  return checked(std::calloc(count > 0 ? count : 1, size > 0 ? size : 1));
}
void* reallocate(void* old, std::size_t size) {
  return checked(std::realloc(old, size > 0 ? size : 1));
}
void* reallocate_known(void* old, std::size_t, std::size_t size) { return reallocate(old, size); }
void release(void* pointer) { std::free(pointer); }
void release_known(void* pointer, std::size_t) { std::free(pointer); }

}  // namespace

void throw_when_out_of_memory() {
  mp_set_memory_functions(allocate, reallocate_known, release_known);
  __flint_set_memory_functions(allocate, allocate_zero, reallocate, release);
  cln::malloc_hook = allocate;
  cln::free_hook = release;
}

}  // namespace casimir
