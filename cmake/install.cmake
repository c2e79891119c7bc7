# What `cmake --install` leaves: the two programs, and the package "argmesh"
# with the core and the client library, as argmesh::core_... and argmesh::client.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

list(TRANSFORM core_modules PREPEND core_ OUTPUT_VARIABLE libraries)
if(ARGMESH_BUILD_SERVICE)
  list(APPEND libraries proto client)
  install(TARGETS argmesh argmeshd)
  install(DIRECTORY ${PROJECT_BINARY_DIR}/proto/gen/
          DESTINATION include/argmesh FILES_MATCHING PATTERN "*.h")
  install(DIRECTORY client DESTINATION include/argmesh
          FILES_MATCHING PATTERN "*.h"
          PATTERN cli EXCLUDE PATTERN picture EXCLUDE)
endif()
argmesh_install_libraries(${libraries})

install(DIRECTORY core DESTINATION include/argmesh
        FILES_MATCHING PATTERN "*.h")

set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/argmesh)
configure_package_config_file(
  cmake/argmeshConfig.cmake.in argmeshConfig.cmake
  INSTALL_DESTINATION ${config_folder})
write_basic_package_version_file(argmeshConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/argmeshConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/argmeshConfigVersion.cmake
        DESTINATION ${config_folder})
install(EXPORT argmeshTargets NAMESPACE argmesh::
        DESTINATION ${config_folder})
