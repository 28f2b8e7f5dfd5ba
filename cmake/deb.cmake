# `cpack --config build/release/CPackConfig.cmake` makes a Debian package of what is installed.

set(CONFORM_DEB_MAINTAINER "canopen-conform maintainers <maintainers@example.org>" CACHE STRING "Maintainer that the .deb names")
# The time of the package and its changelog; who builds twice and wants the same bytes sets SOURCE_DATE_EPOCH.
string(TIMESTAMP CONFORM_DEB_DATE "%a, %d %b %Y %H:%M:%S +0000" UTC)
configure_file(cmake/deb/changelog.in ${CMAKE_BINARY_DIR}/deb/changelog @ONLY)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "${CONFORM_DEB_MAINTAINER}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR})
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_SOURCE_DIR}/cmake/deb/finish.cmake)
set(CPACK_CONFORM_COPYRIGHT ${CMAKE_SOURCE_DIR}/cmake/deb/copyright)
set(CPACK_CONFORM_CHANGELOG ${CMAKE_BINARY_DIR}/deb/changelog)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION net)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "can-utils, cmake, iproute2, user-mode-linux, wireshark")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "conformance tests for CANopen devices (CiA 301)")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"canopen-conform drives a CANopen device over Linux SocketCAN through
scenarios written in YAML and says, requirement by requirement, whether it
conforms to CiA 301: with the clause, what was expected, and the frames.
Reports are for people (HTML, Markdown) and for CI systems (JUnit, JSON).

With it comes canopen-refnode, a CANopen device in software that conforms by
default and can switch on hundreds of known defects, and a CMake package so
that firmware projects run the suite from CTest.")
include(CPack)
