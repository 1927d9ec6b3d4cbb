# The Python package: `import misalign` with PYTHONPATH=<build>/python, or once it is installed.
# The interpreter is the one that the system's NumPy is for, unless -DPython_EXECUTABLE names another.
if(NOT Python_EXECUTABLE AND NOT Python_ROOT_DIR AND EXISTS /usr/bin/python3)
  set(Python_EXECUTABLE /usr/bin/python3)
endif()
find_package(Python 3.9 REQUIRED COMPONENTS Interpreter Development.Module)
find_package(pybind11 2.10 REQUIRED)

pybind11_add_module(_misalign MODULE NO_EXTRAS
  search/python/catalogues.cpp
  search/python/errors.cpp
  search/python/folding.cpp
  search/python/histories.cpp
  search/python/judging.cpp
  search/python/model_shelf.cpp
  search/python/module.cpp
  search/python/sheet_source.cpp
  search/python/sheets.cpp
  search/python/shift_blocks.cpp
  search/python/stations.cpp
  search/python/table_columns.cpp)
target_link_libraries(_misalign PRIVATE misalign_search)
target_compile_definitions(_misalign PRIVATE MISALIGN_VERSION="${PROJECT_VERSION}")
target_compile_options(_misalign PRIVATE -O1)  # what is hot is in the libraries
set_target_properties(_misalign PROPERTIES
  LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/python/misalign UNITY_BUILD_BATCH_SIZE 6)

# Beside it what is not compiled.
file(GLOB PYTHON_FILES CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/search/python/misalign/*.py
     ${PROJECT_SOURCE_DIR}/search/python/misalign/*.pyi ${PROJECT_SOURCE_DIR}/search/python/misalign/py.typed)
foreach(file ${PYTHON_FILES})
  get_filename_component(name ${file} NAME)
  set(copy ${PROJECT_BINARY_DIR}/python/misalign/${name})
  add_custom_command(OUTPUT ${copy} COMMAND ${CMAKE_COMMAND} -E copy ${file} ${copy} DEPENDS ${file})
  list(APPEND PYTHON_COPIES ${copy})
endforeach()
add_custom_target(python_package ALL DEPENDS ${PYTHON_COPIES})
add_dependencies(python_package _misalign)

# Where the interpreter looks below the prefix (Debian's /usr/local: dist-packages); else where it looks
# below that of a user, or of a virtual environment.
if(NOT DEFINED MISALIGN_PYTHON_DIR)
  execute_process(COMMAND ${Python_EXECUTABLE} -c "
import os, site, sys
prefix = sys.argv[1].rstrip('/')
places = [os.path.relpath(path, prefix) for path in site.getsitepackages()]
places = [path for path in places if not path.startswith(('..', 'local/'))]
print(places[0] if places else 'lib/python%d.%d/site-packages' % sys.version_info[:2])"
    ${CMAKE_INSTALL_PREFIX} OUTPUT_VARIABLE MISALIGN_PYTHON_DIR OUTPUT_STRIP_TRAILING_WHITESPACE
    COMMAND_ERROR_IS_FATAL ANY)
endif()
set(MISALIGN_PYTHON_DIR ${MISALIGN_PYTHON_DIR} CACHE STRING "Where the Python package goes, below the prefix")
