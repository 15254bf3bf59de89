# Writes the scripts of pages, less comments and indentation, as C++ to OUTPUT. ROOT has the sources.
function(script_text name result)
  set(text "")
  foreach(file IN LISTS ARGN)
    file(READ "${ROOT}/${file}.js" content)
    string(REGEX REPLACE "\n *//[^\n]*" "" content "\n${content}")
    string(REGEX REPLACE "/\\*\\*[^*]*\\*/" "" content "${content}")
    string(REGEX REPLACE "\n *" "\n" content "${content}")
    string(REGEX REPLACE "\n\n+" "\n" content "${content}")
    string(APPEND text "${content}")
  endforeach()
  # No compiler has to read a literal of more than so many characters.
  set(literal "")
  string(LENGTH "${text}" length)
  set(at 0)
  while(at LESS length)
    string(SUBSTRING "${text}" ${at} 8000 part)
    string(APPEND literal "\n    R\"script(${part})script\"")
    math(EXPR at "${at} + 8000")
  endwhile()
  set(${result} "const char* const ${name} =\n    R\"script((() => {'use strict';)script\"${literal}\n    R\"script(})();)script\";\n" PARENT_SCOPE)
endfunction()

script_text(kReportScript report plot integrator live)
script_text(kIndexScript index search)
file(WRITE "${OUTPUT}" "// Written by tools/report/script/embed.cmake.
#include \"tools/report/script/script.hpp\"

namespace casimir::tools {

${report}
${index}
}  // namespace casimir::tools
")
