# The page of `misalign report`: its packages as the lock file pins them, bundled into one file.
if(MISALIGN_REPORT)
  find_program(NODE node)
  find_program(NPM npm)
  if(NODE AND NPM)
    add_executable(npm IMPORTED)
  endif()
endif()
misalign_feature(Node.js "nodejs npm" "the page of reports" npm)
if(NOT TARGET npm)
  return()
endif()
set(REPORT_PAGE ${PROJECT_BINARY_DIR}/report/report_page.html)
set(PACKAGES ${PROJECT_BINARY_DIR}/report/node_modules/.package-lock.json)
set(PACKAGE_FILES package.json package-lock.json .npmrc)
list(TRANSFORM PACKAGE_FILES PREPEND ${PROJECT_SOURCE_DIR}/schema/report/)
add_custom_command(OUTPUT ${PACKAGES}
  COMMAND ${CMAKE_COMMAND} -E make_directory ${PROJECT_BINARY_DIR}/report
  COMMAND ${CMAKE_COMMAND} -E copy ${PACKAGE_FILES} ${PROJECT_BINARY_DIR}/report
  COMMAND ${CMAKE_COMMAND} -E chdir report ${NPM} ci --silent
  COMMAND ${CMAKE_COMMAND} -E touch ${PACKAGES}
  DEPENDS ${PACKAGE_FILES} WORKING_DIRECTORY ${PROJECT_BINARY_DIR} VERBATIM)
set(PAGE ${PROJECT_SOURCE_DIR}/schema/report)
file(GLOB REPORT_FILES CONFIGURE_DEPENDS ${PAGE}/*.js ${PAGE}/*.mjs ${PAGE}/*.css ${PAGE}/*.html)
add_custom_command(OUTPUT ${REPORT_PAGE}
  COMMAND ${NODE} ${PROJECT_SOURCE_DIR}/schema/report/build.mjs ${REPORT_PAGE}
          ${PROJECT_BINARY_DIR}/report
  DEPENDS ${PACKAGES} ${REPORT_FILES} VERBATIM)
