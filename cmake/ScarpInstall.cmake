# `cmake --install`: beside the program what a CMake project needs to use the library, find_package(scarp CONFIG).
#
# Left out of a build with SCARP_SHARED, whose library shows no more than main() calls (so the packages hold the program
# alone), and of one with sanitizers, which its users would have to have as well.
if(SCARP_SHARED OR SCARP_SANITIZE)
  return()
endif()
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/scarp)

# scarp::scarp: all folders. Of this project's own flags it hands on none.
add_library(scarp_all INTERFACE)
get_property(folders GLOBAL PROPERTY SCARP_FOLDERS)
target_link_libraries(scarp_all INTERFACE ${folders})
set_target_properties(scarp_all PROPERTIES EXPORT_NAME scarp)

# scarp::simd: for code that works on Batch or with the templates of transfer/. How wide a batch is, and so what some of
# these classes look like, goes by the processor that is compiled for, and their names do not always tell: both sides
# of a program must be compiled for the same one. g++ before 13 gets AVX-512 wrong without the second option
# (ScarpTargets.cmake).
add_library(scarp_simd INTERFACE)
target_link_libraries(scarp_simd INTERFACE scarp_all)
target_compile_options(scarp_simd INTERFACE -march=${SCARP_ARCH}
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-fno-tree-slp-vectorize>)
set_target_properties(scarp_simd PROPERTIES EXPORT_NAME simd)

install(TARGETS ${folders} scarp_all scarp_simd EXPORT scarp
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/scarp COMPONENT development
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT scarp NAMESPACE scarp:: FILE scarp-targets.cmake DESTINATION ${package_folder} COMPONENT development)
# The laboratory keeps two headers to itself, written on Eigen, and io one, written on HDF5: both are needed to build only.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/scarp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
  FILES_MATCHING PATTERN "*.hpp" PATTERN "lab/constrained.hpp" EXCLUDE PATTERN "lab/specimen.hpp" EXCLUDE
  PATTERN "io/hdf5_handle.hpp" EXCLUDE)

set(config ${PROJECT_BINARY_DIR}/cmake/scarp-config)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/scarp-config.cmake.in ${config}.cmake
  INSTALL_DESTINATION ${package_folder} NO_SET_AND_CHECK_MACRO)
# Before version 1 a new minor version may change what the headers offer.
write_basic_package_version_file(${config}-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${config}.cmake ${config}-version.cmake ${PROJECT_SOURCE_DIR}/cmake/scarp-hdf5.cmake DESTINATION ${package_folder} COMPONENT development)
