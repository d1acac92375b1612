# The target api_pages: what the headers of sim/, sensors/ and tracker/ say, as web pages in
# <build folder>/api/html. A warning of Doxygen is an error.

find_package(Doxygen QUIET)
if(DOXYGEN_FOUND)
  set(DOXYGEN_PROJECT_BRIEF "${PROJECT_DESCRIPTION}")
  set(DOXYGEN_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/api")
  set(DOXYGEN_FILE_PATTERNS *.hpp *.dox)
  set(DOXYGEN_STRIP_FROM_PATH "${PROJECT_SOURCE_DIR}")
  set(DOXYGEN_STRIP_FROM_INC_PATH "${PROJECT_SOURCE_DIR}")
  set(DOXYGEN_JAVADOC_AUTOBRIEF YES)
  set(DOXYGEN_EXTRACT_ALL YES)
  set(DOXYGEN_INPUT_FILTER "awk -f ${CMAKE_CURRENT_LIST_DIR}/doxygen_formulas.awk")
  set(DOXYGEN_WARN_IF_INCOMPLETE_DOC NO)
  set(DOXYGEN_WARN_AS_ERROR FAIL_ON_WARNINGS)
  set(DOXYGEN_QUIET YES)
  set(DOXYGEN_HAVE_DOT NO)
  doxygen_add_docs(
    api_pages
    "${PROJECT_SOURCE_DIR}/sim"
    "${PROJECT_SOURCE_DIR}/sensors"
    "${PROJECT_SOURCE_DIR}/tracker"
    "${PROJECT_SOURCE_DIR}/tools/metrics"
    COMMENT "Writing the API pages to ${PROJECT_BINARY_DIR}/api/html")
endif()
