# What `cmake --install` leaves beside the programs and the suites.

install(FILES README.md LICENSE CHANGELOG.md CONTRIBUTING.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/canopen-conform)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/canopen-conform PATTERN man EXCLUDE)
install(DIRECTORY docs/wireshark DESTINATION ${CMAKE_INSTALL_DATADIR}/canopen-conform)
# What the pages link to.
foreach(file reference-node/README.md reports/junit.xsd reports/schema/result.schema.json reports/schema/comparison.schema.json harness/bundle/manifest.schema.json scripts/install-packages suites/patterns/reference-node.json suites/requirements/README.md
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

install(FILES docs/man/canopen-conform.1 docs/man/canopen-refnode.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)

include(cmake/deb.cmake)
