# What `cpack` makes of the parts that scripts/install.cmake installs: Debian packages (scripts/package.sh).
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME misalign)
set(CPACK_PACKAGE_VENDOR "The misalign developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program dev)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
# No address is known that would reach them.
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The misalign developers <developers@misalign.invalid>")
set(CPACK_DEBIAN_PACKAGE_SOURCE misalign)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Of one version of misalign the later system's package is the later one.
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
if(EXISTS /etc/os-release)
  file(STRINGS /etc/os-release OS_LINES REGEX "^(ID|VERSION_ID)=")
  list(TRANSFORM OS_LINES REPLACE "^[A-Z_]+=\"?([^\"]*)\"?$" "\\1")
  list(SORT OS_LINES ORDER DESCENDING)  # debian;12
  list(JOIN OS_LINES "" OS_NAME)
  string(REPLACE debian deb OS_NAME "${OS_NAME}")
  string(APPEND CPACK_DEBIAN_PACKAGE_RELEASE "~${OS_NAME}")
endif()

# Open MPI's library starts parts of its own even for one rank, and `--ranks` calls mpirun.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME misalign)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS openmpi-bin)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "calculix-ccx, sqlite3, python3-misalign")
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "find origami that simple springs deploy
Draws random shifts of the vertices of a perforated rigid origami sheet,
follows the exact folding motion of each sheet, and keeps those of which
every diagonal of every hole goes one way, in an SQLite catalogue: to query,
to replay, to report and to export. Runs on one core or on many by MPI.")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME libmisalign-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libeigen3-dev (>= 3.4)")
if(HAS_SUNDIALS)
  string(APPEND CPACK_DEBIAN_DEV_PACKAGE_DEPENDS ", libsundials-dev")
endif()
if(HAS_FLINT)
  string(APPEND CPACK_DEBIAN_DEV_PACKAGE_DEPENDS ", libflint-dev")
endif()
if(ARB_LIBRARY)
  string(APPEND CPACK_DEBIAN_DEV_PACKAGE_DEPENDS ", libflint-arb-dev")
endif()
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS "cmake, misalign")
set(CPACK_DEBIAN_DEV_DESCRIPTION "solver of misalign, to link against
The static library and the headers by which misalign follows the folding
motion of rigid origami sheets with holes, with a package file for CMake and
an example.")

if(TARGET _misalign)  # the module is made for one version of Python
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-misalign)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  math(EXPR PYTHON_NEXT "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${PYTHON_NEXT}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-pandas, python3-matplotlib")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/scripts/python3-misalign/postinst
                                                ${PROJECT_SOURCE_DIR}/scripts/python3-misalign/prerm)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_STRICT_PERMISSION TRUE)
  set(CPACK_DEBIAN_PYTHON_DESCRIPTION "folding and judging of misaligned origami in Python
What misalign computes and keeps, as NumPy arrays and pandas tables: paths of
patterns, verdicts of many sheets at once, candidates of catalogues.")
endif()

# What Debian asks for beside what is installed everywhere: scripts/debian_files.cmake, before each package is made.
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_BINARY_DIR}/debian_files.cmake)
configure_file(scripts/debian_files.cmake.in debian_files.cmake @ONLY)
include(CPack)
