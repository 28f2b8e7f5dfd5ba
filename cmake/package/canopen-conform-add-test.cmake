# SPDX-License-Identifier: Apache-2.0
#
# canopen_conform_add_test(
#   NAME test
#   FIRMWARE command [argument...] | INTERFACE can0 | SIMULATE
#   [PROFILE device.yaml] [EDS device.eds] [NODE 5]
#   [SUITES id...] [EXCLUDE id...] [OWN_SUITES folder...]
#   [ALLOW read-only|config|nvm|motion]
#   [WAIVERS file...] [BASELINE result.json] [STRICT]
#   [ARGUMENTS argument...]
#   [LABELS label...] [TIMEOUT seconds] [ENVIRONMENT NAME=value...])
#
# Adds a CTest test that is one run of canopen-conform.
#   FIRMWARE   the device is this command, a target or a program, on the interface vcan0 that the test gets for itself
#   INTERFACE  the device hangs on this interface; without ALLOW it is only read
#   SIMULATE   the twin of the description (EDS, or that of PROFILE), or else the reference node
#   SUITES     scenarios, by id or leading path (cia301/sdo); all without it
#   OWN_SUITES folders of own scenarios and requirements
#   ARGUMENTS  what else `canopen-conform run` is to be given
# Files are relative to the source folder. Reports (junit.xml, report.html, result.json, summary.md), the capture run.pcapng
# and firmware.log are left in canopen-conform/NAME of the build folder. Where no vcan is possible, or no such interface is
# there, the test is skipped and says why; with CANOPEN_CONFORM_NO_SKIP in the environment it fails.
cmake_policy(VERSION 3.16...3.31)

function(canopen_conform_add_test)
  set(one NAME INTERFACE PROFILE EDS NODE ALLOW BASELINE TIMEOUT)
  set(many FIRMWARE SUITES EXCLUDE OWN_SUITES WAIVERS ARGUMENTS LABELS ENVIRONMENT)
  cmake_parse_arguments(PARSE_ARGV 0 arg "SIMULATE;STRICT" "${one}" "${many}")
  set(who "canopen_conform_add_test(NAME ${arg_NAME})")
  if(NOT arg_NAME)
    message(FATAL_ERROR "canopen_conform_add_test: NAME is missing")
  endif()
  if(DEFINED arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "${who}: not understood: ${arg_UNPARSED_ARGUMENTS}")
  endif()
  if(arg_KEYWORDS_MISSING_VALUES)
    message(FATAL_ERROR "${who}: without a value: ${arg_KEYWORDS_MISSING_VALUES}")
  endif()
  set(ways "")
  foreach(way FIRMWARE INTERFACE SIMULATE)
    if(arg_${way})
      list(APPEND ways ${way})
    endif()
  endforeach()
  list(LENGTH ways count)
  if(NOT count EQUAL 1)
    message(FATAL_ERROR "${who}: one of FIRMWARE, INTERFACE and SIMULATE says where the device is")
  endif()
  if(DEFINED arg_ALLOW AND NOT arg_ALLOW MATCHES "^(read-only|config|nvm|motion)$")
    message(FATAL_ERROR "${who}: ALLOW is '${arg_ALLOW}'; there are: read-only, config, nvm, motion")
  endif()

  string(REGEX REPLACE "[^A-Za-z0-9._-]" "-" folder "${arg_NAME}")
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/canopen-conform/${folder}")
  get_property(folders GLOBAL PROPERTY CANOPEN_CONFORM_FOLDERS)
  if(folder IN_LIST folders)
    message(FATAL_ERROR "${who}: another test leaves its reports in ${folder}, too")
  endif()
  set_property(GLOBAL APPEND PROPERTY CANOPEN_CONFORM_FOLDERS "${folder}")

  set(run "")
  foreach(pair PROFILE:--device EDS:--eds BASELINE:--baseline OWN_SUITES:--suites WAIVERS:--waivers)
    string(REPLACE ":" ";" pair ${pair})
    list(GET pair 0 key)
    list(GET pair 1 option)
    foreach(file IN LISTS arg_${key})
      get_filename_component(file "${file}" ABSOLUTE)
      list(APPEND run ${option} "${file}")
    endforeach()
  endforeach()
  foreach(pair NODE:--node ALLOW:--allow EXCLUDE:--exclude)
    string(REPLACE ":" ";" pair ${pair})
    list(GET pair 0 key)
    list(GET pair 1 option)
    foreach(value IN LISTS arg_${key})
      list(APPEND run ${option} "${value}")
    endforeach()
  endforeach()
  if(arg_STRICT)
    list(APPEND run --strict)
  endif()
  list(APPEND run ${arg_ARGUMENTS})
  if(arg_SUITES)
    list(APPEND run -- ${arg_SUITES})
  endif()

  if(arg_SIMULATE)
    set(device simulate)
  elseif(arg_INTERFACE)
    set(device interface "${arg_INTERFACE}")
  else()
    list(LENGTH arg_FIRMWARE count)
    list(GET arg_FIRMWARE 0 program)
    if(TARGET "${program}")
      list(REMOVE_AT arg_FIRMWARE 0)
      list(INSERT arg_FIRMWARE 0 "$<TARGET_FILE:${program}>")
    endif()
    set(device firmware ${count} ${arg_FIRMWARE})
  endif()

  get_property(helpers GLOBAL PROPERTY CANOPEN_CONFORM_HELPERS)
  add_test(NAME "${arg_NAME}"
           COMMAND "${helpers}/run-test" "$<TARGET_FILE:canopen-conform::canopen-conform>" "${folder}" ${device} ${run}
           WORKING_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}")
  set_tests_properties("${arg_NAME}" PROPERTIES SKIP_RETURN_CODE 77 LABELS "canopen-conform;${arg_LABELS}")
  if(arg_INTERFACE)
    set_tests_properties("${arg_NAME}" PROPERTIES RESOURCE_LOCK "canopen-conform:${arg_INTERFACE}")
  elseif(arg_FIRMWARE)
    # Where no network namespace can be made, with-vcan falls back on the one vcan0 of the machine.
    set_tests_properties("${arg_NAME}" PROPERTIES RESOURCE_LOCK canopen-conform:vcan0)
  endif()
  if(DEFINED arg_TIMEOUT)
    set_tests_properties("${arg_NAME}" PROPERTIES TIMEOUT "${arg_TIMEOUT}")
  endif()
  if(arg_ENVIRONMENT)
    set_tests_properties("${arg_NAME}" PROPERTIES ENVIRONMENT "${arg_ENVIRONMENT}")
  endif()
endfunction()
