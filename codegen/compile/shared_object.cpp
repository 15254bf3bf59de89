#include "codegen/compile/shared_object.hpp"

#include <dlfcn.h>
#include <elf.h>
#include <link.h>

#include <cstring>
#include <fstream>

namespace casimir::codegen {

namespace {

template <class Value>
bool read_at(std::ifstream& in, std::uintmax_t place, Value& value) {
  in.seekg(static_cast<std::streamoff>(place));
  return static_cast<bool>(in.read(reinterpret_cast<char*>(&value), sizeof value));
}

/// Whether it is an object file of this kind of machine and everything that is loaded is in it.
bool is_whole(const std::filesystem::path& object) {
  std::error_code missing;
  const std::uintmax_t size = std::filesystem::file_size(object, missing);
  std::ifstream in(object, std::ios::binary);
  ElfW(Ehdr) head{};
  if (missing || !read_at(in, 0, head) || std::memcmp(head.e_ident, ELFMAG, SELFMAG) != 0 ||
      head.e_ident[EI_CLASS] != (sizeof(void*) == 8 ? ELFCLASS64 : ELFCLASS32) ||
      head.e_phentsize != sizeof(ElfW(Phdr))) {
    return false;
  }
  for (int i = 0; i < head.e_phnum; ++i) {
    ElfW(Phdr) part{};
    if (!read_at(in, head.e_phoff + static_cast<std::uintmax_t>(i) * sizeof part, part) ||
        part.p_offset > size || part.p_filesz > size - part.p_offset) {
      return false;
    }
  }
  return head.e_phnum > 0;
}

}  // namespace

std::string loading_problem(const std::filesystem::path& object) {
  if (!is_whole(object)) return "it is no shared object, or only the beginning of one";
  void* const handle = dlopen(object.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle) {
    dlclose(handle);
    return {};
  }
  const char* const reason = dlerror();
  return reason ? reason : "unknown reason";
}

}  // namespace casimir::codegen
