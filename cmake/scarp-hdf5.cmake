# scarp_hdf5: the C library of HDF5 without MPI. CMake's own module asks a compiler wrapper and the C language, which
# this project has no use for.
if(NOT TARGET scarp_hdf5)
  find_path(SCARP_HDF5_INCLUDE hdf5.h PATH_SUFFIXES hdf5/serial)
  find_library(SCARP_HDF5_LIBRARY NAMES hdf5_serial hdf5)
  if(NOT SCARP_HDF5_INCLUDE OR NOT SCARP_HDF5_LIBRARY)
    message(FATAL_ERROR "HDF5 was not found: install libhdf5-dev (tools/install-deps.sh)")
  endif()
  mark_as_advanced(SCARP_HDF5_INCLUDE SCARP_HDF5_LIBRARY)
  add_library(scarp_hdf5 UNKNOWN IMPORTED)
  set_target_properties(scarp_hdf5 PROPERTIES IMPORTED_LOCATION "${SCARP_HDF5_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${SCARP_HDF5_INCLUDE}")
endif()
