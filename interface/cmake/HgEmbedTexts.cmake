# hg_embed_texts(<target> NAMESPACE <name> HEADER <file> TEXTS <name>:<file>...)
#
# Makes an object library that defines the `texts` (backends/jit/texts.hpp) that a header declares in namespace hg::<name>:
# each file under the name by which it is included. What QFunctions may include of the library is there, too.
function(hg_embed_texts target)
  cmake_parse_arguments(arg "" "NAMESPACE;HEADER" "TEXTS" ${ARGN})
  set(texts "")
  foreach(entry IN LISTS arg_TEXTS)
    string(REGEX MATCH "^([^:]+):(.*)$" _ "${entry}")
    file(READ "${CMAKE_MATCH_2}" text)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${CMAKE_MATCH_2}")
    string(APPEND texts "    {\"${CMAKE_MATCH_1}\", R\"honeyguide(${text})honeyguide\"},\n")
  endforeach()
  foreach(name ceed.h ceed/ceed.h)
    string(APPEND texts "    {\"${name}\", \"#include <ceed/types.h>\\n\"},\n")
  endforeach()
  set(file "${PROJECT_BINARY_DIR}/generated/${target}.cpp")
  file(CONFIGURE OUTPUT "${file}" CONTENT [=[
#include "@arg_HEADER@"

namespace hg::@arg_NAMESPACE@ {

namespace {

constexpr jit::Text all[] = {
@texts@};

}  // namespace

constinit const jit::Texts texts(all);

}  // namespace hg::@arg_NAMESPACE@
]=] @ONLY)
  add_library(${target} OBJECT "${file}")
  target_link_libraries(${target} PRIVATE hg_build_flags)
endfunction()
