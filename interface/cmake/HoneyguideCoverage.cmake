# The target `coverage`: after the tests of a build with HONEYGUIDE_COVERAGE, prints the lines that they reached in the
# interface and in ref, file by file, and fails where the whole is below the promise. Included by the root, last.
set(hg_coverage_promise 95)

find_program(GCOVR gcovr)
if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
  string(REGEX MATCH "^[0-9]+" hg_compiler_major "${CMAKE_CXX_COMPILER_VERSION}")
  find_program(HG_GCOV NAMES llvm-cov-${hg_compiler_major} llvm-cov)
  set(hg_gcov "${HG_GCOV} gcov")
else()
  string(REGEX MATCH "^[0-9]+" hg_compiler_major "${CMAKE_CXX_COMPILER_VERSION}")
  find_program(HG_GCOV NAMES gcov-${hg_compiler_major} gcov)
  set(hg_gcov "${HG_GCOV}")
endif()
if(NOT GCOVR OR NOT HG_GCOV)
  message(FATAL_ERROR "HONEYGUIDE_COVERAGE needs gcovr (found: ${GCOVR}) and the compiler's gcov (found: ${HG_GCOV})")
endif()

add_custom_target(coverage
  COMMAND ${GCOVR} --root ${PROJECT_SOURCE_DIR} --gcov-executable ${hg_gcov} --exclude-throw-branches
          --filter ${PROJECT_SOURCE_DIR}/interface/ --filter ${PROJECT_SOURCE_DIR}/backends/ref/
          --html-details ${PROJECT_BINARY_DIR}/coverage.html --txt - --print-summary --fail-under-line ${hg_coverage_promise}
          ${PROJECT_BINARY_DIR}
  WORKING_DIRECTORY ${PROJECT_BINARY_DIR}
  COMMENT "Lines of interface/ and backends/ref that the tests reached (at least ${hg_coverage_promise} % expected)"
  USES_TERMINAL VERBATIM)
