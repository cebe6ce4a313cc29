# SPDX-License-Identifier: MIT
# Installs the headers, the optional compiled targets and the package files for find_package(diabolo).
include(CMakePackageConfigHelpers)

set(config_dir "${CMAKE_INSTALL_LIBDIR}/cmake/diabolo")
set(installed_targets diabolo)
set(architecture ARCH_INDEPENDENT)
foreach(compiled IN ITEMS batch diagnose)
  string(TOUPPER "DIABOLO_BUILD_${compiled}" option)
  if(${option})
    list(APPEND installed_targets diabolo_${compiled})
    set(architecture "")
  endif()
endforeach()

install(DIRECTORY include/diabolo DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT cpp
        FILES_MATCHING PATTERN "*.hpp")
install(TARGETS ${installed_targets} EXPORT diabolo-targets
        ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT cpp)
install(EXPORT diabolo-targets NAMESPACE diabolo:: DESTINATION "${config_dir}" COMPONENT cpp)

configure_package_config_file(cmake/diabolo-config.cmake.in diabolo-config.cmake
  INSTALL_DESTINATION "${config_dir}")
write_basic_package_version_file(diabolo-config-version.cmake COMPATIBILITY SameMinorVersion
  ${architecture})
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/diabolo-config.cmake"
              "${CMAKE_CURRENT_BINARY_DIR}/diabolo-config-version.cmake"
        DESTINATION "${config_dir}" COMPONENT cpp)
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT cpp)
