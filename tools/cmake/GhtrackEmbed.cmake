# ghtrack_embed(<target> <kName> <file>)
# The bytes of a file as `const std::string_view ghtrack::embedded::<kName>` of a target. The file may be
# made by the build; declare the name in the source that uses it.
function(ghtrack_embed target name file)
  set(source "${CMAKE_CURRENT_BINARY_DIR}/embedded/${name}.cpp")
  add_custom_command(
    OUTPUT "${source}"
    COMMAND "${CMAKE_COMMAND}" "-DINPUT=${file}" "-DOUTPUT=${source}" "-DNAME=${name}" -P
            "${PROJECT_SOURCE_DIR}/tools/cmake/embed_file.cmake"
    DEPENDS "${file}" "${PROJECT_SOURCE_DIR}/tools/cmake/embed_file.cmake"
    COMMENT "Embedding ${name}"
    VERBATIM)
  set_source_files_properties("${source}" PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
  target_sources(${target} PRIVATE "${source}")
endfunction()
