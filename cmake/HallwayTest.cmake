# SPDX-License-Identifier: MIT
# hallway_add_test(<name> [FAST] SOURCES a.cpp … [APART a.cpp …] [LIBS …] [DEPENDS …] [LABELS …])
#
# Tests are half of what is built, so most of them are not optimized at all. FAST: those that compute for long. DEPENDS: programs and plugins that the
# tests run.
#
# One GoogleTest program for each library, registered with ctest under the library's name. hallway_add_test_part() registers some of its tests by themselves.
# The label `threads` marks what runs under the thread sanitizer; the target thread_tests builds what that takes. A test at the size that only `make test-long` runs is registered with
# hallway_add_long_test.

# intercept_tls_get_addr=0: the runtimes of g++ up to 13 and clang up to 16 take some blocks of thread-local memory for those of an old glibc, and the search for leaks then crashes
# (google/sanitizers issue 1322).
set(HALLWAY_TEST_ENVIRONMENT
    "HALLWAY_SOURCE_DIR=${PROJECT_SOURCE_DIR}"
    "HALLWAY_BINARY_DIR=${PROJECT_BINARY_DIR}"
    "ASAN_OPTIONS=detect_stack_use_after_return=1:strict_string_checks=1:intercept_tls_get_addr=0"
    "LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/sanitizers/lsan.supp:print_suppressions=0"
    "UBSAN_OPTIONS=print_stacktrace=1"
    "TSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/sanitizers/tsan.supp:halt_on_error=1")

# After which a test counts as hung: also on a machine that has eight times as much to do, and under a sanitizer.
set(HALLWAY_TEST_SECONDS 3600)

# Test programs are many: gold, which comes with GNU's other linker, took a quarter to a third of its time for the two that were tried.
find_program(HALLWAY_GOLD ld.gold)
mark_as_advanced(HALLWAY_GOLD)

add_custom_target(thread_tests)

function(hallway_add_test name)
  cmake_parse_arguments(arg "FAST" "" "SOURCES;APART;LIBS;DEPENDS;LABELS" ${ARGN})
  add_executable(test_${name} ${arg_SOURCES})
  set(precompiled hallway_test_precompiled)
  if(arg_FAST)
    set(precompiled hallway_fast_test_precompiled)
    hallway_compile_quickly(test_${name})
  else()
    hallway_compile_plainly(test_${name})
  endif()
  target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(test_${name} PRIVATE ${arg_LIBS} GTest::gtest GTest::gtest_main)
  hallway_compile_together(test_${name} APART ${arg_APART})
  if(NOT "${arg_SOURCES}" MATCHES "\\.c(;|$)")
    hallway_reuse_precompiled(test_${name} ${precompiled})
  endif()
  if(HALLWAY_GOLD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT HALLWAY_SANITIZE)
    target_link_options(test_${name} PRIVATE -fuse-ld=gold)
  endif()
  set_target_properties(test_${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests HALLWAY_PARTS "")
  if(arg_DEPENDS)
    add_dependencies(test_${name} ${arg_DEPENDS})
  endif()
  # All but the parts, whatever they are: so no test is in none of them.
  hallway_register_test(${name} ${name} "*-$<JOIN:$<TARGET_PROPERTY:test_${name},HALLWAY_PARTS>,:>" "${arg_LABELS}")
endfunction()

# hallway_add_test_part(<name> OF <test> FILTER <gtest filter> [LABELS …] [COST seconds]): the tests that the filter chooses, registered by themselves: so that
# two run at once, or since the labels are others. COST: about how long it takes, for the order of the first run.
function(hallway_add_test_part name)
  cmake_parse_arguments(arg "" "OF;FILTER;COST" "LABELS" ${ARGN})
  set_property(TARGET test_${arg_OF} APPEND PROPERTY HALLWAY_PARTS ${arg_FILTER})
  hallway_register_test(${name} ${arg_OF} ${arg_FILTER} "${arg_LABELS}")
  if(arg_COST)
    set_tests_properties(${name} PROPERTIES COST ${arg_COST})
  endif()
endfunction()

# A filter that chooses nothing fails.
function(hallway_register_test name program filter labels)
  if("threads" IN_LIST labels)
    add_dependencies(thread_tests test_${program})
  endif()
  add_test(NAME ${name} COMMAND test_${program} --gtest_filter=${filter})
  set_tests_properties(${name} PROPERTIES LABELS "${labels}" TIMEOUT ${HALLWAY_TEST_SECONDS} FAIL_REGULAR_EXPRESSION "Running 0 tests"
                       ENVIRONMENT "${HALLWAY_TEST_ENVIRONMENT}")
endfunction()

# hallway_add_long_test(<name> OF <test> [FILTER <gtest filter>] [LABELS …]): the same executable at the sizes that are
# too long for every day (HALLWAY_TEST_LONG=1), labelled `long`. A filter that chooses nothing fails.
function(hallway_add_long_test name)
  cmake_parse_arguments(arg "" "OF;FILTER" "LABELS" ${ARGN})
  set(filter)
  if(arg_FILTER)
    set(filter --gtest_filter=${arg_FILTER})
  endif()
  add_test(NAME ${name} COMMAND test_${arg_OF} ${filter})
  set_tests_properties(${name} PROPERTIES LABELS "long;${arg_LABELS}" TIMEOUT 3600
                       FAIL_REGULAR_EXPRESSION "Running 0 tests"
                       ENVIRONMENT "${HALLWAY_TEST_ENVIRONMENT};HALLWAY_TEST_LONG=1")
endfunction()
