# Rooms: each folder of a layer is a target, LAYER_FOLDER, and its place says where it is linked.

# misalign_layer(LAYER LIBRARY...): the archive misalign_LAYER, of the rooms that follow. Whoever links against it, and
# each of its rooms, gets these libraries.
macro(misalign_layer layer)
  add_library(misalign_${layer} STATIC)
  target_link_libraries(misalign_${layer} PUBLIC ${ARGN})
  set(LAYER ${layer})
  set(LAYER_LIBRARIES ${ARGN})
endmacro()

# misalign_room([LIBRARY...]): every source of this folder, as a part of its layer. The libraries are known to this
# room alone.
function(misalign_room)
  get_filename_component(name ${CMAKE_CURRENT_SOURCE_DIR} NAME)
  set(room ${LAYER}_${name})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  add_library(${room} OBJECT ${sources})
  target_link_libraries(${room} PRIVATE ${LAYER_LIBRARIES} ${ARGN})
  target_link_libraries(misalign_${LAYER} PRIVATE ${ARGN})
  target_sources(misalign_${LAYER} PRIVATE $<TARGET_OBJECTS:${room}>)
endfunction()

# misalign_library(LIBRARY...): every source of this folder as an archive of its own, misalign_FOLDER: what the layer's
# other users, tests and Python, shall not link against.
function(misalign_library)
  get_filename_component(name ${CMAKE_CURRENT_SOURCE_DIR} NAME)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  add_library(misalign_${name} STATIC ${sources})
  target_link_libraries(misalign_${name} PUBLIC ${ARGN})
endfunction()

# misalign_headers(PACKAGE::PACKAGE HEADER [LIBRARY] [REQUIRED]): this target, for a library that has no file for CMake.
function(misalign_headers name header)
  cmake_parse_arguments(FIND REQUIRED "" "" ${ARGN})
  string(REGEX REPLACE "::.*" "" package ${name})
  if(CMAKE_DISABLE_FIND_PACKAGE_${package})
    return()
  endif()
  string(MAKE_C_IDENTIFIER ${name} id)
  set(parts ${id}_INCLUDE_DIR)
  find_path(${id}_INCLUDE_DIR ${header})
  foreach(library ${FIND_UNPARSED_ARGUMENTS})
    list(APPEND parts ${id}_LIBRARY)
    find_library(${id}_LIBRARY ${library})
  endforeach()
  foreach(part ${parts})
    if(NOT ${part})
      if(FIND_REQUIRED)
        message(FATAL_ERROR "${package} (${header}) is needed, and was not found")
      endif()
      return()
    endif()
  endforeach()
  add_library(${name} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${name} INTERFACE ${${id}_INCLUDE_DIR})
  target_link_libraries(${name} INTERFACE ${${id}_LIBRARY})
endfunction()
