# embed_files(OUTPUT FILE..): writes a C++ file that defines casimir::embedded_file for these files,
# and again whenever one of them changes.
function(embed_files output)
  set(entries "")
  foreach(file IN LISTS ARGN)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${file})
    file(READ ${PROJECT_SOURCE_DIR}/${file} text)
    string(APPEND entries "    {\"${file}\", R\"embedded(${text})embedded\"},\n")
  endforeach()
  file(GENERATE OUTPUT ${output} CONTENT "// Made by runtime/embed.cmake.
#include \"runtime/embedded.hpp\"

#include <map>

namespace casimir {

std::string_view embedded_file(std::string_view path) {
  static const std::map<std::string_view, std::string_view> files = {
${entries}  };
  return files.at(path);
}

}  // namespace casimir
")
endfunction()
