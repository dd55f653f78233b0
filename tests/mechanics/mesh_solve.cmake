# Mesh, options, boundary conditions, solver
hg_mechanics_test(mesh_spaces_test RANKS 1 2 3)
hg_mechanics_test(options_group_test)
hg_mechanics_test(solve_clock_test)
hg_mechanics_test(boundary_conditions_test RANKS 1 2 3)
hg_mechanics_test(static_solver_test RANKS 1 2 3)

# Tests that run the program: no MPI in the test itself.
function(hg_program_test name)
  cmake_parse_arguments(ARG "LONG" "TIMEOUT" "" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 600)
  endif()
  add_executable(${name} ${name}.cpp)
  add_dependencies(${name} honeyguide)
  target_link_libraries(${name} PRIVATE GTest::gtest_main hg_build_flags)
  target_compile_definitions(${name} PRIVATE HONEYGUIDE_PROGRAM="$<TARGET_FILE:honeyguide>"
    HONEYGUIDE_MPIEXEC="${MPIEXEC_EXECUTABLE}" HONEYGUIDE_EXAMPLES="${PROJECT_SOURCE_DIR}/ratel-like/examples")
  add_test(NAME mechanics.${name} COMMAND ${name})
  set(labels mechanics)
  if(ARG_LONG)
    list(APPEND labels long)
  endif()
  set_tests_properties(mechanics.${name} PROPERTIES LABELS "${labels}" TIMEOUT ${ARG_TIMEOUT} PROCESSORS 2 ENVIRONMENT
    "OMPI_ALLOW_RUN_AS_ROOT=1;OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1;OMPI_MCA_rmaps_base_oversubscribe=1;OMPI_MCA_btl_base_warn_component_unused=0;OMP_NUM_THREADS=1")
endfunction()
hg_program_test(program_input_test)
hg_program_test(program_sinker_test LONG TIMEOUT 1200)
hg_program_test(program_sinker_long_test LONG TIMEOUT 3600)
