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

# misalign_headers(NAME HEADER [LIBRARY]): the target NAME, for a library that has no file for CMake.
function(misalign_headers name header)
  string(MAKE_C_IDENTIFIER ${name} id)
  find_path(${id}_INCLUDE_DIR ${header} REQUIRED)
  add_library(${name} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${name} INTERFACE ${${id}_INCLUDE_DIR})
  if(ARGN)
    find_library(${id}_LIBRARY ${ARGN} REQUIRED)
    target_link_libraries(${name} INTERFACE ${${id}_LIBRARY})
  endif()
endfunction()
