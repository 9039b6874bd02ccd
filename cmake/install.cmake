# `cmake --install`: the program, and the libraries from the scene to its files as a package for
# find_package(prehensile). What makes pages, MJCF files and benchmarks is the program's own.
include(CMakePackageConfigHelpers)

set(layers scene optimisation mechanics primitives planner)
if(PREHENSILE_MESHES)
  list(APPEND layers mesh)
endif()
if(PREHENSILE_APPS)
  list(APPEND layers io)
  install(TARGETS prehensile RUNTIME)
endif()
list(TRANSFORM layers PREPEND prehensile_ OUTPUT_VARIABLE libraries)
install(TARGETS ${libraries} EXPORT prehensileTargets ARCHIVE)
# Headers that need what is not built, and folders without any header.
set(left_out PATTERN fcl EXCLUDE PATTERN absent EXCLUDE)
if(NOT PREHENSILE_OMPL)
  list(APPEND left_out PATTERN ompl EXCLUDE PATTERN ompl_interface.h EXCLUDE)
endif()
foreach(layer ${layers})
  install(DIRECTORY ${layer}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/prehensile/${layer}
    FILES_MATCHING PATTERN "*.h" ${left_out})
endforeach()

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/prehensile)
install(EXPORT prehensileTargets NAMESPACE prehensile:: DESTINATION ${package_folder})
configure_package_config_file(cmake/prehensileConfig.cmake.in
  ${PROJECT_BINARY_DIR}/generated/prehensileConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/generated/prehensileConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/generated/prehensileConfig.cmake
  ${PROJECT_BINARY_DIR}/generated/prehensileConfigVersion.cmake
  cmake/dependencies.cmake cmake/FindIpopt.cmake DESTINATION ${package_folder})
