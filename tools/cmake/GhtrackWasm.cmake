# C++ for WebAssembly with Debian's clang, lld, wasi-libc and libc++, beside the native build.

find_program(GHTRACK_WASM_CXX NAMES clang++ clang++-14 DOC "clang++ for wasm32-wasi")
set(GHTRACK_WASM_FLAGS
    --target=wasm32-wasi
    -std=c++20
    -O2
    -flto
    # The same bits as the native build, see GhtrackTargets.cmake.
    -ffp-contract=off
    -fno-math-errno
    -fno-rtti
    -fvisibility=hidden
    -DNDEBUG)

# ghtrack_find_wasm(<variable>)
# Whether a program with a container and an exported function can be compiled and linked.
function(ghtrack_find_wasm variable)
  if(NOT DEFINED GHTRACK_WASM_WORKS)
    set(probe "${PROJECT_BINARY_DIR}/CMakeFiles/wasm_probe")
    file(WRITE "${probe}.cpp" "#include <vector>\n#include <cmath>\n"
         "extern \"C\" [[clang::export_name(\"f\")]] double f(int n) {\n"
         "  return std::sqrt(std::vector<double>(n, 2.0).back());\n}\n")
    set(status 1)
    if(GHTRACK_WASM_CXX)
      execute_process(
        COMMAND "${GHTRACK_WASM_CXX}" ${GHTRACK_WASM_FLAGS} -fno-exceptions -mexec-model=reactor "${probe}.cpp" -o
                "${probe}.wasm"
        RESULT_VARIABLE status
        OUTPUT_QUIET ERROR_FILE "${probe}.log")
    endif()
    if(status EQUAL 0)
      set(GHTRACK_WASM_WORKS ON CACHE INTERNAL "clang++ makes WebAssembly")
    else()
      # Not remembered, so that installing the packages is enough.
      set(GHTRACK_WASM_WORKS OFF)
    endif()
  endif()
  set(${variable} ${GHTRACK_WASM_WORKS} PARENT_SCOPE)
endfunction()

# ghtrack_add_wasm(<file.wasm> SOURCES ... [INCLUDES folders...] [DEFINITIONS ...])
# One module without imports: what the sources export, and `memory`. The sources of a folder are
# compiled together, a few at a time, as most of the work is in the headers that they share.
function(ghtrack_add_wasm wasm)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;INCLUDES;DEFINITIONS")
  list(TRANSFORM arg_INCLUDES PREPEND -isystem)
  list(TRANSFORM arg_DEFINITIONS PREPEND -D)
  set(most_together 7)
  set(parts)
  foreach(source IN LISTS arg_SOURCES)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY "${PROJECT_SOURCE_DIR}")
    cmake_path(GET source PARENT_PATH part)
    cmake_path(RELATIVE_PATH part BASE_DIRECTORY "${PROJECT_SOURCE_DIR}")
    string(REPLACE "/" "_" part "${part}")
    list(LENGTH sources_${part} count)
    while(count EQUAL most_together)
      string(APPEND part "_")
      list(LENGTH sources_${part} count)
    endwhile()
    list(APPEND parts "${part}")
    list(APPEND sources_${part} "${source}")
    string(APPEND text_${part} "#include \"${source}\"\n")
  endforeach()
  list(REMOVE_DUPLICATES parts)
  set(objects)
  foreach(part IN LISTS parts)
    set(together "${CMAKE_CURRENT_BINARY_DIR}/wasm/${part}.cpp")
    file(CONFIGURE OUTPUT "${together}" CONTENT "${text_${part}}")
    set(object "${together}.o")
    add_custom_command(
      OUTPUT "${object}"
      COMMAND ${CMAKE_CXX_COMPILER_LAUNCHER} "${GHTRACK_WASM_CXX}" ${GHTRACK_WASM_FLAGS}
              "-I${PROJECT_SOURCE_DIR}" ${arg_INCLUDES} ${arg_DEFINITIONS} -MD -MF "${object}.d" -c "${together}" -o "${object}"
      DEPENDS "${together}" ${sources_${part}}
      DEPFILE "${object}.d"
      COMMENT "Building WebAssembly object ${part}"
      VERBATIM COMMAND_EXPAND_LISTS)
    list(APPEND objects "${object}")
  endforeach()
  add_custom_command(
    OUTPUT "${wasm}"
    COMMAND "${GHTRACK_WASM_CXX}" ${GHTRACK_WASM_FLAGS} -mexec-model=reactor -Wl,--strip-all
            ${objects} -o "${wasm}"
    DEPENDS ${objects}
    COMMENT "Linking ${wasm}"
    VERBATIM)
endfunction()
