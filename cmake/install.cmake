# What `cmake --install` leaves beside the programs and the suites.

install(FILES README.md LICENSE CHANGELOG.md CONTRIBUTING.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/canopen-conform)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/canopen-conform)
install(DIRECTORY docs/wireshark DESTINATION ${CMAKE_INSTALL_DATADIR}/canopen-conform)
# What the pages link to.
foreach(file reference-node/README.md reports/junit.xsd reports/schema/result.schema.json reports/schema/comparison.schema.json harness/bundle/manifest.schema.json scripts/install-packages suites/patterns/reference-node.json suites/patterns/worth.json suites/requirements/README.md
        harness/cli/tests/interop/device.js harness/cli/tests/interop/device.yaml
        action.yml Dockerfile)
  get_filename_component(folder ${file} DIRECTORY)
  install(FILES ${file} DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/canopen-conform/${folder})
endforeach()

# find_package(canopen-conform). It knows no path but where it lies itself, so the installed tree may be moved.
include(CMakePackageConfigHelpers)
set(CONFORM_HELPERS ${CMAKE_INSTALL_LIBEXECDIR}/canopen-conform)
set(package ${CMAKE_INSTALL_DATADIR}/cmake/canopen-conform)
configure_package_config_file(cmake/package/canopen-conform-config.cmake.in ${CMAKE_BINARY_DIR}/package/canopen-conform-config.cmake
  INSTALL_DESTINATION ${package} PATH_VARS CMAKE_INSTALL_BINDIR CONFORM_HELPERS)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/package/canopen-conform-config-version.cmake COMPATIBILITY SameMinorVersion
  ARCH_INDEPENDENT)
install(FILES ${CMAKE_BINARY_DIR}/package/canopen-conform-config.cmake ${CMAKE_BINARY_DIR}/package/canopen-conform-config-version.cmake
              cmake/package/canopen-conform-add-test.cmake DESTINATION ${package})
install(PROGRAMS cmake/package/run-test scripts/with-vcan DESTINATION ${CONFORM_HELPERS})
install(FILES scripts/uml-xstate.c DESTINATION ${CONFORM_HELPERS})

# What the programs have written of themselves (conform_share).
set(CONFORM_ZSH_COMPLETIONS ${CMAKE_INSTALL_DATADIR}/zsh/site-functions CACHE STRING "Where the completion of zsh is installed")
foreach(program canopen-conform canopen-refnode)
  set(share ${CMAKE_BINARY_DIR}/share/${program})
  install(DIRECTORY ${share}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR} OPTIONAL)
  install(DIRECTORY ${share}/zsh/site-functions/ DESTINATION ${CONFORM_ZSH_COMPLETIONS} OPTIONAL)
  install(DIRECTORY ${share}/bash-completion ${share}/fish DESTINATION ${CMAKE_INSTALL_DATADIR} OPTIONAL)
endforeach()

include(cmake/deb.cmake)
