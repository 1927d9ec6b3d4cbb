# What `cmake --install` puts where. The pages and completions are made by the program itself.
# Parts, which become packages of their own (scripts/package.cmake): `program`, what nothing else is said of;
# `dev`, for programs that link against the solver.
include(GNUInstallDirs)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)
install(TARGETS misalign RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
file(GLOB SCHEMA_FILES CONFIGURE_DEPENDS schema/*.sql schema/*.json schema/*.md)
install(FILES ${SCHEMA_FILES} DESTINATION ${CMAKE_INSTALL_DATADIR}/misalign/schema)
install(DIRECTORY schema/migrations schema/queries schema/versions
        DESTINATION ${CMAKE_INSTALL_DATADIR}/misalign/schema)
# Beside each other: campaigns name the files of ../patterns.
install(DIRECTORY search/campaigns search/patterns search/wishes DESTINATION ${CMAKE_INSTALL_DATADIR}/misalign)
install(FILES README.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
# The manual, where README's links find it, and the site of it if there is one (scripts/site.sh; `misalign help --site`).
install(DIRECTORY search/manual DESTINATION ${CMAKE_INSTALL_DOCDIR}/search)
install(DIRECTORY build/site/html DESTINATION ${CMAKE_INSTALL_DOCDIR} OPTIONAL)

# find_package(misalign): the target misalign::solver, used as solver/example does. Left out are headers of what is
# inside: the yardstick, and what needs xsimd or FLINT.
set(CONFIG_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/misalign)
set_target_properties(misalign_solver PROPERTIES EXPORT_NAME solver)
set_target_properties(misalign_options PROPERTIES EXPORT_NAME options)
install(TARGETS misalign_solver misalign_options EXPORT misalignTargets COMPONENT dev
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/misalign)
install(EXPORT misalignTargets NAMESPACE misalign:: DESTINATION ${CONFIG_DIR} COMPONENT dev)
install(DIRECTORY solver DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/misalign COMPONENT dev
        FILES_MATCHING PATTERN "*.hpp" PATTERN example EXCLUDE PATTERN reference EXCLUDE
        REGEX "/(arb_model|energy_check|expansion_test|lane_batch|panel_check)\\.hpp$" EXCLUDE
        REGEX "/(product_kernel|product_sums|product_table|proven_interval|shift_expansion)\\.hpp$" EXCLUDE)
include(CMakePackageConfigHelpers)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/misalignConfigVersion.cmake
                                 COMPATIBILITY SameMajorVersion)
get_property(HAS_SUNDIALS GLOBAL PROPERTY MISALIGN_HAS_SUNDIALS)
get_property(HAS_FLINT GLOBAL PROPERTY MISALIGN_HAS_FLINT)
configure_file(scripts/misalignConfig.cmake.in misalignConfig.cmake @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/misalignConfig.cmake scripts/FindFLINT.cmake
              ${PROJECT_BINARY_DIR}/misalignConfigVersion.cmake
        DESTINATION ${CONFIG_DIR} COMPONENT dev)
install(FILES solver/example/CMakeLists.txt solver/example/fold_sheet.cpp
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libmisalign-dev/examples COMPONENT dev)

set(COMPLETION ${PROJECT_BINARY_DIR}/completion)
file(MAKE_DIRECTORY ${COMPLETION})
add_custom_command(OUTPUT ${COMPLETION}/misalign ${COMPLETION}/_misalign
  COMMAND misalign completion bash > ${COMPLETION}/misalign
  COMMAND misalign completion zsh > ${COMPLETION}/_misalign
  DEPENDS misalign VERBATIM)
add_custom_target(completion ALL DEPENDS ${COMPLETION}/misalign ${COMPLETION}/_misalign)
install(FILES ${COMPLETION}/misalign DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${COMPLETION}/_misalign DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)

if(MISALIGN_MAN_PAGES)
  find_program(HELP2MAN help2man)
  if(HELP2MAN)
    add_executable(help2man IMPORTED)
  endif()
endif()
misalign_feature(help2man help2man "manual pages" help2man)
if(NOT TARGET help2man)
  return()
endif()
# The same pages from the same commit, whenever they are made.
set(PAGES_DATE $ENV{SOURCE_DATE_EPOCH})
if(NOT PAGES_DATE)
  execute_process(COMMAND git -C ${PROJECT_SOURCE_DIR} log -1 --format=%ct
                  OUTPUT_VARIABLE PAGES_DATE OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(NOT PAGES_DATE)
  set(PAGES_DATE 0)
endif()
set(ENV{SOURCE_DATE_EPOCH} ${PAGES_DATE})
string(TIMESTAMP PAGES_DATE %Y-%m-%d UTC)
set(PAGES_SCRIPT ${PROJECT_SOURCE_DIR}/scripts/man_pages.sh)
set(PAGES_COMMON ${PROJECT_SOURCE_DIR}/search/man/common.h2m)
add_custom_command(OUTPUT ${PROJECT_BINARY_DIR}/man/misalign.1
  COMMAND ${PAGES_SCRIPT} $<TARGET_FILE:misalign> ${HELP2MAN} ${PROJECT_VERSION} ${PAGES_DATE}
          ${PAGES_COMMON} ${PROJECT_BINARY_DIR}/man
  DEPENDS misalign ${PAGES_SCRIPT} ${PAGES_COMMON} VERBATIM)
add_custom_target(man ALL DEPENDS ${PROJECT_BINARY_DIR}/man/misalign.1)
install(DIRECTORY ${PROJECT_BINARY_DIR}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1
        FILES_MATCHING PATTERN "*.1")
