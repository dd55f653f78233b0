# ceed_add_backend(<folder> [BUILT_IN] SOURCES <file>... [LIBS <target>...])
#
# A backend is a folder below backends/ and one call of this function. Built in, its sources go into the core library
# and its entry is the function ceed_plugin_<folder>(); otherwise it becomes the plugin library ceed-plugins/<folder>.so
# beside the core library, with the one exported symbol ceed_plugin_v1.
function(ceed_add_backend name)
  cmake_parse_arguments(arg "BUILT_IN" "" "SOURCES;LIBS" ${ARGN})
  list(TRANSFORM arg_SOURCES PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/${name}/")
  if(arg_BUILT_IN)
    target_sources(ceed PRIVATE ${arg_SOURCES})
    set_property(GLOBAL APPEND PROPERTY HG_BUILT_IN_BACKENDS ${name})
    return()
  endif()
  add_library(ceed_${name} MODULE ${arg_SOURCES})
  target_link_libraries(ceed_${name} PRIVATE ceed hg_build_flags ${arg_LIBS})
  set_target_properties(ceed_${name} PROPERTIES PREFIX "" OUTPUT_NAME ${name}
    LIBRARY_OUTPUT_DIRECTORY "$<TARGET_FILE_DIR:ceed>/ceed-plugins" INSTALL_RPATH "$ORIGIN/..")
  file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/generated/plugin.map" CONTENT "{ global: ceed_plugin_v1; local: *; };\n" @ONLY)
  target_link_options(ceed_${name} PRIVATE "LINKER:--version-script=${PROJECT_BINARY_DIR}/generated/plugin.map")
  install(TARGETS ceed_${name} LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/ceed-plugins")
endfunction()

# Writes the list of built-in backends: the core names none of them.
function(ceed_finish_backends)
  get_property(names GLOBAL PROPERTY HG_BUILT_IN_BACKENDS)
  set(declarations "")
  set(entries "")
  foreach(name IN LISTS names)
    string(APPEND declarations "const CeedPlugin *ceed_plugin_${name}();\n")
    string(APPEND entries "ceed_plugin_${name}, ")
  endforeach()
  file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/generated/built_in_plugins.cpp" CONTENT [=[
#include "registry.hpp"

@declarations@
namespace hg {

std::vector<CeedPluginEntry> built_in_plugins() { return {@entries@}; }

}  // namespace hg
]=] @ONLY)
  target_sources(ceed PRIVATE "${PROJECT_BINARY_DIR}/generated/built_in_plugins.cpp")
endfunction()
