# SPDX-License-Identifier: MIT
# hallway_add_fuzz_target(<name> SOURCES a.cpp … [LIBS …])
#
# SOURCES define LLVMFuzzerTestOneInput. Two things are made of it:
#   - the ordinary test fuzz_corpus_<name>, which runs it on every file of tests/fuzz/corpus/<name>;
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

function(hallway_add_fuzz_target name)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBS" ${ARGN})
  set(executables fuzz_corpus_${name})
  add_executable(fuzz_corpus_${name} ${arg_SOURCES} ${PROJECT_SOURCE_DIR}/tests/fuzz/replay.cpp)
  if(HALLWAY_FUZZ)
    list(APPEND executables fuzz_${name})
    add_executable(fuzz_${name} ${arg_SOURCES})
    target_link_options(fuzz_${name} PRIVATE -fsanitize=fuzzer)
  endif()
  foreach(executable ${executables})
    target_include_directories(${executable} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
    target_link_libraries(${executable} PRIVATE ${arg_LIBS})
    set_target_properties(${executable} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  endforeach()
  add_test(NAME fuzz_corpus_${name}
           COMMAND fuzz_corpus_${name} ${PROJECT_SOURCE_DIR}/tests/fuzz/corpus/${name})
  set_tests_properties(fuzz_corpus_${name} PROPERTIES LABELS "fuzz" TIMEOUT 900
                       ENVIRONMENT "${HALLWAY_TEST_ENVIRONMENT}")
endfunction()
