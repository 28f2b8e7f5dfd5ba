# Helpers of the build: one function per kind of target, so that the folders' lists stay lists.

function(conform_global_flags)
  set(CMAKE_CXX_STANDARD 23 PARENT_SCOPE)
  set(CMAKE_CXX_STANDARD_REQUIRED ON PARENT_SCOPE)
  set(CMAKE_CXX_EXTENSIONS OFF PARENT_SCOPE)
  add_compile_options(-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Wold-style-cast)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # GCC bug 105651 and its relatives: false alarms inside std::string.
    add_compile_options(-Wno-restrict -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
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
    # Without this ccache would compile everything anew that uses a precompiled header.
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE} PARENT_SCOPE)
    add_compile_options($<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess> "$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")
  endif()
endfunction()

# libyaml brings no package for CMake: the target conform_libyaml.
function(conform_find_libyaml)
  find_path(CONFORM_LIBYAML_INCLUDE yaml.h REQUIRED)
  find_library(CONFORM_LIBYAML yaml REQUIRED)
  mark_as_advanced(CONFORM_LIBYAML_INCLUDE CONFORM_LIBYAML)
  add_library(conform_libyaml UNKNOWN IMPORTED GLOBAL)
  set_target_properties(conform_libyaml PROPERTIES IMPORTED_LOCATION ${CONFORM_LIBYAML}
                        INTERFACE_INCLUDE_DIRECTORIES ${CONFORM_LIBYAML_INCLUDE})
endfunction()

# conform_allocate_fast(PROGRAM): malloc of gperftools where it is installed. A run makes and drops small things all the time, above all the
# nodes of exploration and of the proof, which takes two thirds of the time with it. Sanitizers have an allocator of their own.
function(conform_allocate_fast program)
  if(CONFORM_SANITIZE OR NOT CONFORM_TCMALLOC)
    return()
  endif()
  find_library(CONFORM_LIBTCMALLOC tcmalloc_minimal)
  mark_as_advanced(CONFORM_LIBTCMALLOC)
  if(CONFORM_LIBTCMALLOC)
    # The linker would leave out a library of which it needs no symbol that another does not have.
    target_link_options(${program} PRIVATE -Wl,--push-state,--no-as-needed ${CONFORM_LIBTCMALLOC} -Wl,--pop-state)
  endif()
endfunction()

# Half of the compile time of a small file goes into the same headers of the standard library and fmt. One target compiles
# them for all the others; a file must still include what it uses (clang-tidy sees no precompiled header).
function(conform_precompiled_headers)
  add_library(conform_pch OBJECT ${CMAKE_SOURCE_DIR}/cmake/pch.cpp)
  target_link_libraries(conform_pch PRIVATE fmt::fmt)
  set(headers <algorithm> <array> <chrono> <cstddef> <cstdint> <expected> <functional> <map> <memory> <optional> <set> <span>
    <string> <string_view> <utility> <variant> <vector> <fmt/format.h>)
  target_precompile_headers(conform_pch PRIVATE ${headers})
  if(BUILD_TESTING)
    add_library(conform_test_pch OBJECT ${CMAKE_SOURCE_DIR}/cmake/pch.cpp)
    target_link_libraries(conform_test_pch PRIVATE fmt::fmt conform_test_main)
    target_compile_options(conform_test_pch PRIVATE ${CONFORM_TEST_FLAGS})
    target_precompile_headers(conform_test_pch PRIVATE ${headers} <catch.hpp>)
  endif()
endfunction()

# conform_reuse_headers(TARGET [test])
function(conform_reuse_headers target)
  if(CONFORM_PCH)
    target_precompile_headers(${target} REUSE_FROM conform_${ARGN}pch)
  endif()
endfunction()

# conform_library(NAME [COLD] SOURCES a.cpp ... DEPENDS targets...): static library conform_NAME; headers are found by
# their path from the folder above ("can/frame.hpp"). COLD: no part of what runs for each frame.
function(conform_library name)
  cmake_parse_arguments(arg "COLD" "" "SOURCES;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  add_library(conform_${name} STATIC ${arg_SOURCES})
  if(arg_COLD)
    target_compile_options(conform_${name} PRIVATE ${CONFORM_COLD_FLAGS})
  endif()
  target_include_directories(conform_${name} PUBLIC ${CMAKE_CURRENT_SOURCE_DIR}/..)
  target_link_libraries(conform_${name} PUBLIC ${arg_DEPENDS} PRIVATE ${arg_PRIVATE_DEPENDS})
  conform_reuse_headers(conform_${name})
endfunction()

# conform_share(PROGRAM): the program writes its man pages and completions below share/ in the build folder, from where they are
# installed (cmake/install.cmake). Each time it is linked, so that they tell what it takes.
function(conform_share program)
  if(CMAKE_CROSSCOMPILING AND NOT CMAKE_CROSSCOMPILING_EMULATOR)
    message(STATUS "No man pages and completions of ${program}: it does not run here")
    return()
  endif()
  # Who builds twice and wants the same bytes sets SOURCE_DATE_EPOCH.
  string(TIMESTAMP date "%Y-%m-%d" UTC)
  set(folder ${CMAKE_BINARY_DIR}/share/${program})
  add_custom_command(TARGET ${program} POST_BUILD
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${folder}
    COMMAND ${CMAKE_CROSSCOMPILING_EMULATOR} $<TARGET_FILE:${program}> __share ${folder} ${date}
    VERBATIM)
endfunction()

# One object library holds Catch's main (v2) and the include path of the version shim.
function(conform_test_support)
  add_library(conform_test_main STATIC ${CMAKE_SOURCE_DIR}/cmake/testing/main.cpp)
  target_include_directories(conform_test_main PUBLIC ${CMAKE_SOURCE_DIR}/cmake/testing)
  target_compile_options(conform_test_main PRIVATE ${CONFORM_TEST_FLAGS})
  if(Catch2_VERSION VERSION_GREATER_EQUAL 3)
    target_link_libraries(conform_test_main PUBLIC Catch2::Catch2WithMain)
  else()
    target_link_libraries(conform_test_main PUBLIC Catch2::Catch2)
  endif()
endfunction()

# conform_test(NAME [LONG] SOURCES ... DEPENDS ... [LABELS ...]): one Catch2 binary test_NAME, registered with CTest as NAME. LONG: only
# with CONFORM_LONG_TESTS. The label long: most of a minute, which scripts/check leaves to its stage long-tests.
function(conform_test name)
  if(NOT BUILD_TESTING)
    return()
  endif()
  cmake_parse_arguments(arg "LONG" "" "SOURCES;DEPENDS;LABELS" ${ARGN})
  if(arg_LONG AND NOT CONFORM_LONG_TESTS)
    return()
  endif()
  add_executable(test_${name} ${arg_SOURCES})
  target_link_libraries(test_${name} PRIVATE conform_test_main ${arg_DEPENDS})
  target_compile_definitions(test_${name} PRIVATE CONFORM_SOURCE_DIR="${CMAKE_SOURCE_DIR}"
                                                  CONFORM_BINARY_DIR="${CMAKE_BINARY_DIR}")
  target_compile_options(test_${name} PRIVATE ${CONFORM_TEST_FLAGS})
  conform_reuse_headers(test_${name} test_)
  add_test(NAME ${name} COMMAND test_${name})
  set_tests_properties(${name} PROPERTIES LABELS "${arg_LABELS}" SKIP_RETURN_CODE 77)
endfunction()

# conform_fuzz(NAME SOURCES ... DEPENDS ... SEEDS folders): LLVMFuzzerTestOneInput twice. replay_NAME runs the seeds with any
# compiler and is the test NAME_seeds; fuzz_NAME is made with CONFORM_FUZZ and run by the fuzz stage of scripts/check.
function(conform_fuzz name)
  cmake_parse_arguments(arg "" "" "SOURCES;DEPENDS;SEEDS" ${ARGN})
  list(TRANSFORM arg_SEEDS PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  if(NOT BUILD_TESTING AND NOT CONFORM_FUZZ)
    return()
  endif()
  # What both programs need is compiled once.
  if(NOT TARGET conform_replay)
    add_library(conform_replay OBJECT ${CMAKE_SOURCE_DIR}/cmake/testing/replay.cpp)
  endif()
  add_library(target_${name} OBJECT ${arg_SOURCES})
  target_link_libraries(target_${name} PUBLIC ${arg_DEPENDS})
  conform_reuse_headers(target_${name})
  add_executable(replay_${name} $<TARGET_OBJECTS:target_${name}> $<TARGET_OBJECTS:conform_replay>)
  target_link_libraries(replay_${name} PRIVATE ${arg_DEPENDS})
  if(BUILD_TESTING)
    add_test(NAME ${name}_seeds COMMAND replay_${name} ${arg_SEEDS})
  endif()
  if(CONFORM_FUZZ)
    add_executable(fuzz_${name} $<TARGET_OBJECTS:target_${name}>)
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

# Every file pays a second and a half for its headers, precompiled or not: with CONFORM_UNITY those files of a target are compiled as one
# whose names do not meet (scripts/unity-groups). Called when every target is known.
function(conform_unity)
  find_program(CONFORM_PYTHON python3 REQUIRED)
  conform_targets_below(${CMAKE_SOURCE_DIR} targets)
  set(lines "")
  foreach(target IN LISTS targets)
    get_target_property(folder ${target} SOURCE_DIR)
    get_target_property(sources ${target} SOURCES)
    set(line ${target})
    foreach(source IN LISTS sources)
      cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${folder} NORMALIZE)
      cmake_path(IS_PREFIX CMAKE_BINARY_DIR ${source} is_generated)
      # A file of two targets would be in the same group of both.
      if(source MATCHES "\\.cpp$" AND NOT is_generated AND NOT source IN_LIST seen)
        string(APPEND line "\t${source}")
        list(APPEND seen ${source})
      endif()
    endforeach()
    string(APPEND lines "${line}\n")
  endforeach()
  file(WRITE ${CMAKE_BINARY_DIR}/unity-targets.txt "${lines}")
  # A name that a change brings may part a group.
  set_property(DIRECTORY ${CMAKE_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${seen} scripts/unity-groups)
  execute_process(COMMAND ${CONFORM_PYTHON} ${CMAKE_SOURCE_DIR}/scripts/unity-groups
                  INPUT_FILE ${CMAKE_BINARY_DIR}/unity-targets.txt OUTPUT_VARIABLE groups COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]+" groups "${groups}")
  foreach(line IN LISTS groups)
    string(REPLACE "\t" ";" line "${line}")
    list(GET line 0 target)
    list(GET line 1 group)
    list(GET line 2 source)
    # Whoever links another version of some files must not get the others with these in one object (harness/cli/mutants).
    get_target_property(apart ${target} CONFORM_UNITY_APART)
    if(apart)
      get_target_property(folder ${target} SOURCE_DIR)
      file(RELATIVE_PATH relative ${folder} ${source})
      if(relative MATCHES "${apart}")
        string(APPEND group _apart)
      endif()
    endif()
    set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP group_${group})
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    # What a header declares shadows no name of the file before; clang-tidy looks at each file alone, with this warning.
    target_compile_options(${target} PRIVATE -Wno-shadow)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      # For GCC a class is in a header when it is in a file that another includes.
      target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
    endif()
  endforeach()
endfunction()

# conform_targets_below(FOLDER RESULT): those that compile something, without what a build generates.
function(conform_targets_below folder result)
  get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  get_property(folders DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  set(found "")
  foreach(target IN LISTS targets)
    get_target_property(type ${target} TYPE)
    if(type MATCHES "_LIBRARY$|^EXECUTABLE$" AND NOT type STREQUAL "INTERFACE_LIBRARY")
      list(APPEND found ${target})
    endif()
  endforeach()
  foreach(below IN LISTS folders)
    conform_targets_below(${below} more)
    list(APPEND found ${more})
  endforeach()
  set(${result} ${found} PARENT_SCOPE)
endfunction()
