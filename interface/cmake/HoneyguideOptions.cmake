# Switches and compile settings that every room shares.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_C_STANDARD 11)
set(CMAKE_C_VISIBILITY_PRESET hidden)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

# The build tree has the shape of an installation: programs in bin/, the library and its plugins in lib/.
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib")
file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/include/ceed")
file(CREATE_LINK "${PROJECT_SOURCE_DIR}/qfunctions" "${PROJECT_BINARY_DIR}/include/ceed/jit-source" SYMBOLIC)

# Installed programs find the library relative to themselves; LD_LIBRARY_PATH goes before it (RUNPATH, not RPATH), so
# that a program can be run with another library of this interface.
file(RELATIVE_PATH hg_bin_to_lib "${CMAKE_INSTALL_FULL_BINDIR}" "${CMAKE_INSTALL_FULL_LIBDIR}")
set(CMAKE_INSTALL_RPATH "$ORIGIN/${hg_bin_to_lib}")
set(CMAKE_INSTALL_RPATH_USE_LINK_PATH ON)  # a PETSc of the user's own is found where it was linked
add_link_options(LINKER:--enable-new-dtags)

# The version of the interface, which is also the version of the package, is said once: in the header.
file(STRINGS "${PROJECT_SOURCE_DIR}/interface/include/ceed/ceed.h" version_lines
     REGEX "^#define CEED_VERSION_(MAJOR|MINOR|PATCH) ")
string(REGEX REPLACE "[^0-9]+([0-9]+)" ".\\1" HG_CEED_VERSION "${version_lines}")
string(SUBSTRING "${HG_CEED_VERSION}" 1 -1 HG_CEED_VERSION)
if(NOT HG_CEED_VERSION MATCHES "^[0-9]+\\.[0-9]+\\.[0-9]+$")
  message(FATAL_ERROR "ceed.h: expected CEED_VERSION_MAJOR, _MINOR and _PATCH, found '${version_lines}'")
endif()

option(HONEYGUIDE_BPS "Build the bake-off programs" ON)
option(HONEYGUIDE_MECHANICS "Build the mechanics layer (PETSc, MPI, HDF5, METIS)" ON)
option(HONEYGUIDE_WERROR "Treat warnings as errors" ON)
set(HONEYGUIDE_SANITIZE "" CACHE STRING "Sanitizers for every target, for example address,undefined or thread")
option(HONEYGUIDE_COVERAGE "Instrument for line coverage" OFF)
option(HONEYGUIDE_FUZZ "Build the fuzz target (clang with libFuzzer)" OFF)

# Every target of ours links this: warnings, sanitizers, coverage. It is never exported.
add_library(hg_build_flags INTERFACE)
target_compile_options(hg_build_flags INTERFACE -Wall -Wextra $<$<BOOL:${HONEYGUIDE_WERROR}>:-Werror>
                       $<$<CXX_COMPILER_ID:Clang>:-Wno-pass-failed>)
if(HONEYGUIDE_SANITIZE)
  target_compile_options(hg_build_flags INTERFACE -fsanitize=${HONEYGUIDE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(hg_build_flags INTERFACE -fsanitize=${HONEYGUIDE_SANITIZE})
  add_library(hg_sanitizer_defaults OBJECT "${PROJECT_SOURCE_DIR}/interface/cmake/sanitizer_defaults.c")
  target_sources(hg_build_flags INTERFACE
    $<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:$<TARGET_OBJECTS:hg_sanitizer_defaults>>)
endif()
if(HONEYGUIDE_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang" OR NOT CMAKE_C_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "HONEYGUIDE_FUZZ needs clang, which has libFuzzer; the compiler is ${CMAKE_CXX_COMPILER_ID}")
  endif()
  # Two checks compare types by address, which differ between libraries that hide their symbols.
  target_compile_options(hg_build_flags INTERFACE -fsanitize=fuzzer-no-link -fno-sanitize=function,vptr)
endif()
if(HONEYGUIDE_COVERAGE)
  target_compile_options(hg_build_flags INTERFACE --coverage -fprofile-update=atomic -O0)
  target_link_options(hg_build_flags INTERFACE --coverage)
endif()

# PETSc, MPI, HDF5 and METIS: needed by the mechanics layer and the distributed bake-off, by nothing else.
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(PETSC QUIET IMPORTED_TARGET PETSc>=3.18)
  pkg_check_modules(HDF5 QUIET IMPORTED_TARGET hdf5-openmpi)
endif()
if(PETSC_FOUND)
  find_package(MPI QUIET COMPONENTS C CXX)
  find_path(METIS_INCLUDE_DIR metis.h)
  find_library(METIS_LIBRARY metis)
endif()
if(PETSC_FOUND AND MPI_CXX_FOUND)
  set(HONEYGUIDE_HAVE_PETSC ON)
else()
  set(HONEYGUIDE_HAVE_PETSC OFF)
endif()
if(HONEYGUIDE_MECHANICS AND NOT (HONEYGUIDE_HAVE_PETSC AND HDF5_FOUND AND METIS_LIBRARY AND METIS_INCLUDE_DIR))
  message(STATUS "Mechanics layer off: it needs PETSc >= 3.18 (found: ${PETSC_FOUND}), MPI (${MPI_CXX_FOUND}), HDF5 (${HDF5_FOUND}), METIS (${METIS_LIBRARY})")
  set(HONEYGUIDE_MECHANICS OFF)
endif()

# What tests that start MPI programs have in their environment: containers run as root on few cores.
set(hg_mpi_environment OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
    OMPI_MCA_btl_base_warn_component_unused=0 OMPI_MCA_mpi_yield_when_idle=1 OMP_NUM_THREADS=1)

# MPI's C++ bindings are not used; this keeps their headers out of -Wextra's sight.
function(hg_use_petsc target)
  target_link_libraries(${target} PUBLIC PkgConfig::PETSC MPI::MPI_CXX)
  target_compile_definitions(${target} PUBLIC OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)
endfunction()
