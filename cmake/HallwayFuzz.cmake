# SPDX-License-Identifier: MIT
# hallway_add_fuzz_target(<name> SOURCES a.cpp … [LIBS …])
#
# SOURCES define LLVMFuzzerTestOneInput. Two things are made of it:
#   - the ordinary test fuzz_corpus_<name>, in which the program fuzz_corpus runs it on every file of tests/fuzz/corpus/<name>;
#   - with -DHALLWAY_FUZZ=ON (clang) the libFuzzer executable fuzz_<name>:
#       cmake -S . -B build/fuzz -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_C_COMPILER=clang -DHALLWAY_FUZZ=ON \
#             -DHALLWAY_SANITIZE=address,undefined,fuzzer-no-link
#       ninja -C build/fuzz fuzz_map_reader && build/fuzz/tests/fuzz_map_reader FOLDER_OF_FINDS tests/fuzz/corpus/map_reader
option(HALLWAY_FUZZ "Build the libFuzzer executables (clang only)" OFF)
if(HALLWAY_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "HALLWAY_FUZZ needs clang")
  endif()
  if(NOT HALLWAY_SANITIZE MATCHES "fuzzer-no-link")
    message(FATAL_ERROR "HALLWAY_FUZZ needs -DHALLWAY_SANITIZE=address,undefined,fuzzer-no-link: "
                        "a fuzzer sees only what is built for it")
  endif()
endif()

# All targets in one program, each under a name of its own.
function(hallway_add_fuzz_corpus)
  cmake_parse_arguments(arg "" "" "TARGETS" ${ARGN})
  add_executable(fuzz_corpus ${PROJECT_SOURCE_DIR}/tests/fuzz/replay.cpp)
  list(TRANSFORM arg_TARGETS REPLACE "(.+)" "TARGET(\\1)" OUTPUT_VARIABLE targets)
  list(JOIN targets " " targets)
  target_compile_definitions(fuzz_corpus PRIVATE "HALLWAY_FUZZ_TARGETS=${targets}")
  list(TRANSFORM arg_TARGETS PREPEND fuzz_corpus_ OUTPUT_VARIABLE libraries)
  target_link_libraries(fuzz_corpus PRIVATE ${libraries})
  set_target_properties(fuzz_corpus PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  hallway_compile_plainly(fuzz_corpus)
  foreach(name ${arg_TARGETS})
    add_test(NAME fuzz_corpus_${name} COMMAND fuzz_corpus ${name} ${PROJECT_SOURCE_DIR}/tests/fuzz/corpus/${name})
    set_tests_properties(fuzz_corpus_${name} PROPERTIES LABELS "fuzz" TIMEOUT ${HALLWAY_TEST_SECONDS} ENVIRONMENT "${HALLWAY_TEST_ENVIRONMENT}")
  endforeach()
endfunction()

function(hallway_add_fuzz_target name)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBS" ${ARGN})
  add_library(fuzz_corpus_${name} OBJECT ${arg_SOURCES})
  target_compile_definitions(fuzz_corpus_${name} PRIVATE LLVMFuzzerTestOneInput=fuzz_${name})
  hallway_compile_plainly(fuzz_corpus_${name})
  # As test programs are compiled, whose precompiled header it reads.
  set_target_properties(fuzz_corpus_${name} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
  target_compile_options(fuzz_corpus_${name} PRIVATE ${CMAKE_CXX_COMPILE_OPTIONS_PIE})
  target_link_libraries(fuzz_corpus_${name} PRIVATE GTest::gtest)
  hallway_reuse_precompiled(fuzz_corpus_${name} hallway_test_precompiled)
  set(made fuzz_corpus_${name})
  if(HALLWAY_FUZZ)
    list(APPEND made fuzz_${name})
    add_executable(fuzz_${name} ${arg_SOURCES})
    target_link_options(fuzz_${name} PRIVATE -fsanitize=fuzzer)
    set_target_properties(fuzz_${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  endif()
  foreach(target ${made})
    target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
    target_link_libraries(${target} PUBLIC ${arg_LIBS})
  endforeach()
endfunction()
