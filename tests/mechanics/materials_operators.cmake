# Tests of the rooms materials and operators.
hg_mechanics_test(materials_elasticity_test)
hg_mechanics_test(materials_qfunctions_test)
target_sources(materials_qfunctions_test PRIVATE qfunctions_as_c.c)
set_source_files_properties(qfunctions_as_c.c PROPERTIES SKIP_PRECOMPILE_HEADERS ON)  # those are of C++
hg_mechanics_test(operators_solid_test RANKS 1 2 3)
hg_mechanics_test(operators_projection_test RANKS 1 2 3)
hg_mechanics_test(verification_patch_test RANKS 1 2 3)
hg_mechanics_test(output_points_on_mesh_test RANKS 1 2 3)

# Verification by the program
if(TARGET honeyguide)
  find_package(Python3 QUIET COMPONENTS Interpreter)
  add_test(NAME mechanics.mms_linear
           COMMAND ${Python3_EXECUTABLE} "${PROJECT_SOURCE_DIR}/docs/verification/mms_linear.py" --check
                   --honeyguide $<TARGET_FILE:honeyguide> --mpiexec ${MPIEXEC_EXECUTABLE})
  set_tests_properties(mechanics.mms_linear PROPERTIES LABELS "mechanics;long" TIMEOUT 1200 PROCESSORS 2 ENVIRONMENT
    "${hg_mpi_environment}")
endif()
