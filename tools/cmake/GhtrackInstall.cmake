# `cmake --install`: the tracker library for find_package(ghtrack), and the program where it was
# built; `--component tracker` installs the library alone. `cpack` makes a Debian package of it all.

include(CMakePackageConfigHelpers)
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/ghtrack")

install(
  TARGETS ghtrack_tracker ghtrack_detection ghtrack_portable_math
  EXPORT ghtrack
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT tracker
  FILE_SET HEADERS DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/ghtrack" COMPONENT tracker)
install(EXPORT ghtrack NAMESPACE ghtrack:: DESTINATION "${package_dir}" FILE ghtrack-targets.cmake
        COMPONENT tracker)

configure_package_config_file(
  "${CMAKE_CURRENT_LIST_DIR}/ghtrack-config.cmake.in" "${PROJECT_BINARY_DIR}/ghtrack-config.cmake"
  INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/ghtrack-config-version.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/ghtrack-config.cmake"
              "${PROJECT_BINARY_DIR}/ghtrack-config-version.cmake"
        DESTINATION "${package_dir}" COMPONENT tracker)
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}" RENAME copyright
        COMPONENT tracker)

if(GHTRACK_PROGRAMS)
  install(
    DIRECTORY "${PROJECT_SOURCE_DIR}/scenes"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/ghtrack"
    FILES_MATCHING
    PATTERN "*.yaml"
    PATTERN "*.csv"
    PATTERN "scene.schema.json"
    PATTERN "README.md"
    PATTERN "schema" EXCLUDE)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME ghtrack)
set(CPACK_PACKAGE_CONTACT "the ghtrack authors <ghtrack@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS fonts-dejavu-core)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS ffmpeg)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libeigen3-dev, openmpi-bin")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
include(CPack)
