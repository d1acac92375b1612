# `cmake --install`: the tracker library for find_package(ghtrack), and the program where it was built.
# `--component tracker` installs the library alone.

include(CMakePackageConfigHelpers)
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/ghtrack")

install(
  TARGETS ghtrack_tracker ghtrack_detection
  EXPORT ghtrack
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT tracker
  FILE_SET HEADERS DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/ghtrack" COMPONENT tracker)
install(EXPORT ghtrack NAMESPACE ghtrack:: DESTINATION "${package_dir}" FILE ghtrack-targets.cmake
        COMPONENT tracker)

configure_package_config_file(
  "${CMAKE_CURRENT_LIST_DIR}/ghtrack-config.cmake.in" "${CMAKE_BINARY_DIR}/ghtrack-config.cmake"
  INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${CMAKE_BINARY_DIR}/ghtrack-config-version.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_BINARY_DIR}/ghtrack-config.cmake"
              "${CMAKE_BINARY_DIR}/ghtrack-config-version.cmake"
        DESTINATION "${package_dir}" COMPONENT tracker)

if(GHTRACK_PROGRAMS)
  install(
    DIRECTORY "${CMAKE_SOURCE_DIR}/scenes"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/ghtrack"
    FILES_MATCHING
    PATTERN "*.yaml"
    PATTERN "*.csv"
    PATTERN "scene.schema.json"
    PATTERN "README.md"
    PATTERN "schema" EXCLUDE)
endif()
