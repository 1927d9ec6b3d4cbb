# Libraries without which misalign still builds and searches: each is looked for by the one folder that uses it, with
# QUIET, and left out where it is not found or -DCMAKE_DISABLE_FIND_PACKAGE_NAME=ON says so (preset core: all of them).

# misalign_feature(LIBRARY PACKAGE PURPOSE TARGETS [SOURCE...]): whether the first of these targets was found, in the
# table of all. FEATURES gets the targets for misalign_room; without them the room's sources named here are left out.
macro(misalign_feature library package purpose targets)
  set(found ${targets})
  list(GET found 0 first)
  set(is_in false)
  if(TARGET ${first})
    set(is_in true)
    list(APPEND FEATURES ${found})
  else()
    message(STATUS "${library} (${package}) not found: this build is without ${purpose}")
    foreach(source ${ARGN})
      if(NOT EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${source})
        message(FATAL_ERROR "${CMAKE_CURRENT_SOURCE_DIR}/${source}: there is no such source")
      endif()
      set_source_files_properties(${source} PROPERTIES HEADER_FILE_ONLY ON)
    endforeach()
  endif()
  set_property(GLOBAL PROPERTY MISALIGN_HAS_${library} ${is_in})
  set_property(GLOBAL APPEND PROPERTY MISALIGN_FEATURES "{\"${library}\", \"${package}\", \"${purpose}\", ${is_in}}")
endmacro()

# The table as generated/features.hpp, once every folder has looked.
function(misalign_write_features)
  get_property(rows GLOBAL PROPERTY MISALIGN_FEATURES)
  list(JOIN rows ",\n    " rows)
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/features.hpp @ONLY CONTENT [=[
// Libraries that misalign can do without, and whether this build has them.
#pragma once

#include <string_view>

namespace misalign {

struct Feature {
  std::string_view library;
  std::string_view package;  ///< Debian's
  std::string_view purpose;  ///< what needs it
  bool is_in;
};

inline constexpr Feature kFeatures[] = {
    @rows@};

/// Whether this build has it; of a name in the table alone.
consteval bool has(std::string_view library) {
  for (const Feature& feature : kFeatures) {
    if (feature.library == library) return feature.is_in;
  }
  throw "no such library";
}

}  // namespace misalign
]=])
endfunction()
