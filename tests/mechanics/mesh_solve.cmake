# Mesh, options, boundary conditions, solver
hg_mechanics_test(mesh_spaces_test RANKS 1 2 3)
hg_mechanics_test(options_group_test)
hg_mechanics_test(solve_clock_test)
hg_mechanics_test(boundary_conditions_test RANKS 1 2 3)
hg_mechanics_test(static_solver_test RANKS 1 2 3)
if(TARGET ceed_emu)
  hg_mechanics_test(device_vectors_test ENVIRONMENT "CEED_GEN_FLAGS=${hg_compiled_flags}")
  add_dependencies(device_vectors_test ceed_emu)
endif()
hg_mechanics_test(monitors_test RANKS 1 2 3)

# hg_program_test(name [LONG] [TIMEOUT seconds]): tests that run the program; no MPI in the test itself.
function(hg_program_test name)
  hg_add_test(${name} LABEL mechanics WHOLE PROCESSORS 2 SOURCES ${name}.cpp LIBS GTest::gtest_main hg_test_support
              ENVIRONMENT ${hg_mpi_environment} ${ARGN})
  add_dependencies(${name} honeyguide)
  target_compile_definitions(${name} PRIVATE HONEYGUIDE_PROGRAM="$<TARGET_FILE:honeyguide>"
    HONEYGUIDE_MPIEXEC="${MPIEXEC_EXECUTABLE}" HONEYGUIDE_EXAMPLES="${PROJECT_SOURCE_DIR}/ratel-like/examples")
endfunction()
hg_program_test(program_input_test TIMEOUT 600)
hg_program_test(program_examples_test TIMEOUT 600)
hg_program_test(program_mms_test TIMEOUT 600)
hg_program_test(program_regions_test)
hg_program_test(program_sinker_test LONG TIMEOUT 1200)
hg_program_test(program_sinker_long_test LONG TIMEOUT 3600)
