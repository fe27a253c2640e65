# SPDX-License-Identifier: GPL-3.0-or-later
# OpenMeshCore from OpenMesh's own sources, compiled into what links it: for a Python module that must bring along all
# it needs. Only the half-edge mesh is built; reading and writing files is left out.
#
# SEAMWIRE_OPENMESH_SOURCES: a folder that holds src/OpenMesh/Core, as in OpenMesh's releases, or OpenMesh/src/..., as in
# the source package of its Python module.

file(TO_CMAKE_PATH "${SEAMWIRE_OPENMESH_SOURCES}" openmesh_root)
if(EXISTS "${openmesh_root}/OpenMesh/src/OpenMesh/Core")
  string(APPEND openmesh_root "/OpenMesh")
endif()
if(NOT EXISTS "${openmesh_root}/src/OpenMesh/Core/Mesh/PolyConnectivity.cc")
  message(FATAL_ERROR "SEAMWIRE_OPENMESH_SOURCES: no src/OpenMesh/Core in ${SEAMWIRE_OPENMESH_SOURCES}")
endif()

file(GLOB openmesh_sources CONFIGURE_DEPENDS
  "${openmesh_root}/src/OpenMesh/Core/Mesh/*.cc"
  "${openmesh_root}/src/OpenMesh/Core/System/*.cc"
  "${openmesh_root}/src/OpenMesh/Core/Utils/*.cc"
)
# Only reading files needs it, and it takes as long to compile as ten other sources.
list(REMOVE_ITEM openmesh_sources "${openmesh_root}/src/OpenMesh/Core/Utils/PropertyCreator.cc")
add_library(OpenMeshCore STATIC ${openmesh_sources})
target_include_directories(OpenMeshCore SYSTEM PUBLIC "${openmesh_root}/src")
target_compile_features(OpenMeshCore PUBLIC cxx_std_20)
set_target_properties(OpenMeshCore PROPERTIES
  POSITION_INDEPENDENT_CODE ON
  CXX_VISIBILITY_PRESET hidden
  VISIBILITY_INLINES_HIDDEN ON
)
if(MSVC)
  target_compile_definitions(OpenMeshCore PUBLIC _USE_MATH_DEFINES NOMINMAX)
  target_compile_options(OpenMeshCore PUBLIC /bigobj)
endif()
