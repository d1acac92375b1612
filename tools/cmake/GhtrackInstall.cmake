# `cmake --install`: the tracker library for find_package(ghtrack), and the program where it was built.

include(CMakePackageConfigHelpers)
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/ghtrack")

install(
  TARGETS ghtrack_tracker ghtrack_detection
  EXPORT ghtrack
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  FILE_SET HEADERS DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/ghtrack")
install(EXPORT ghtrack NAMESPACE ghtrack:: DESTINATION "${package_dir}" FILE ghtrack-targets.cmake)

configure_package_config_file(
  "${CMAKE_CURRENT_LIST_DIR}/ghtrack-config.cmake.in" "${CMAKE_BINARY_DIR}/ghtrack-config.cmake"
  INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${CMAKE_BINARY_DIR}/ghtrack-config-version.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_BINARY_DIR}/ghtrack-config.cmake"
              "${CMAKE_BINARY_DIR}/ghtrack-config-version.cmake" DESTINATION "${package_dir}")
