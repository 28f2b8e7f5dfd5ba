# Helpers of the build: one function per kind of target, so that the folders' lists stay lists.

function(conform_global_flags)
  set(CMAKE_CXX_STANDARD 23 PARENT_SCOPE)
  set(CMAKE_CXX_STANDARD_REQUIRED ON PARENT_SCOPE)
  set(CMAKE_CXX_EXTENSIONS OFF PARENT_SCOPE)
  add_compile_options(-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Wold-style-cast)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # GCC bug 105651: a false alarm inside std::string's operator+.
    add_compile_options(-Wno-restrict)
  endif()
  # No paths of the build machine in the binaries: builds are reproducible and messages short.
  add_compile_options(-ffile-prefix-map=${CMAKE_SOURCE_DIR}/=)
  if(CONFORM_WARNINGS_AS_ERRORS)
    add_compile_options(-Werror)
  endif()
  if(CONFORM_SANITIZE)
    add_compile_options(-fsanitize=${CONFORM_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
    add_link_options(-fsanitize=${CONFORM_SANITIZE})
  endif()
  if(NOT CMAKE_BUILD_TYPE)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
  endif()
  find_program(CCACHE ccache)
  if(CCACHE)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE} PARENT_SCOPE)
  endif()
endfunction()

# conform_library(NAME SOURCES a.cpp ... DEPENDS targets...): static library conform_NAME; headers are found by
# their path from the folder above ("can/frame.hpp").
function(conform_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  add_library(conform_${name} STATIC ${arg_SOURCES})
  target_include_directories(conform_${name} PUBLIC ${CMAKE_CURRENT_SOURCE_DIR}/..)
  target_link_libraries(conform_${name} PUBLIC ${arg_DEPENDS} PRIVATE ${arg_PRIVATE_DEPENDS})
endfunction()

# One object library holds Catch's main (v2) and the include path of the version shim.
function(conform_test_support)
  add_library(conform_test_main STATIC ${CMAKE_SOURCE_DIR}/cmake/testing/main.cpp)
  target_include_directories(conform_test_main PUBLIC ${CMAKE_SOURCE_DIR}/cmake/testing)
  if(Catch2_VERSION VERSION_GREATER_EQUAL 3)
    target_link_libraries(conform_test_main PUBLIC Catch2::Catch2WithMain)
  else()
    target_link_libraries(conform_test_main PUBLIC Catch2::Catch2)
  endif()
endfunction()

# conform_test(NAME SOURCES ... DEPENDS ... [LABELS ...]): one Catch2 binary test_NAME, registered with CTest as NAME.
function(conform_test name)
  if(NOT BUILD_TESTING)
    return()
  endif()
  cmake_parse_arguments(arg "" "" "SOURCES;DEPENDS;LABELS" ${ARGN})
  add_executable(test_${name} ${arg_SOURCES})
  target_link_libraries(test_${name} PRIVATE conform_test_main ${arg_DEPENDS})
  target_compile_definitions(test_${name} PRIVATE CONFORM_SOURCE_DIR="${CMAKE_SOURCE_DIR}"
                                                  CONFORM_BINARY_DIR="${CMAKE_BINARY_DIR}")
  add_test(NAME ${name} COMMAND test_${name})
  set_tests_properties(${name} PROPERTIES LABELS "${arg_LABELS}" SKIP_RETURN_CODE 77)
endfunction()

# conform_fuzz(NAME SOURCES ... DEPENDS ... SEEDS folders): LLVMFuzzerTestOneInput twice. replay_NAME runs the seeds with any
# compiler and is the test NAME_seeds; fuzz_NAME is made with CONFORM_FUZZ and run by the fuzz stage of scripts/check.
function(conform_fuzz name)
  cmake_parse_arguments(arg "" "" "SOURCES;DEPENDS;SEEDS" ${ARGN})
  list(TRANSFORM arg_SEEDS PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  if(BUILD_TESTING OR CONFORM_FUZZ)
    add_executable(replay_${name} ${arg_SOURCES} ${CMAKE_SOURCE_DIR}/cmake/testing/replay.cpp)
    target_link_libraries(replay_${name} PRIVATE ${arg_DEPENDS})
  endif()
  if(BUILD_TESTING)
    add_test(NAME ${name}_seeds COMMAND replay_${name} ${arg_SEEDS})
  endif()
  if(CONFORM_FUZZ)
    add_executable(fuzz_${name} ${arg_SOURCES})
    target_link_libraries(fuzz_${name} PRIVATE ${arg_DEPENDS} -fsanitize=fuzzer)
    if(NOT TARGET fuzz)
      add_custom_target(fuzz)
    endif()
    add_dependencies(fuzz fuzz_${name} replay_${name})
    # For scripts/check: both programs, then the folders with seeds.
    string(REPLACE ";" "\n" seeds "${arg_SEEDS}")
    file(GENERATE OUTPUT ${CMAKE_BINARY_DIR}/fuzz/${name}.target
         CONTENT "$<TARGET_FILE:fuzz_${name}>\n$<TARGET_FILE:replay_${name}>\n${seeds}\n")
  endif()
endfunction()
