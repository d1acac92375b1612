# Every target of the project is made here, so that all share one standard, one set of warnings and one layout.

include(GNUInstallDirs)
if(PROJECT_IS_TOP_LEVEL)
  set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
  if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release)
  endif()
  # Sources of one folder are compiled a few at a time, since what they include costs more than what
  # they say. The presets `debug` and `clang` compile each alone: for who writes, and for includes.
  option(CMAKE_UNITY_BUILD "Compile several sources of a folder as one" ON)
  set(CMAKE_UNITY_BUILD_BATCH_SIZE 4)
endif()

add_library(ghtrack_options INTERFACE)
target_compile_features(ghtrack_options INTERFACE cxx_std_20)
target_compile_options(
  ghtrack_options
  INTERFACE # The same bits from every compiler: no fused multiply-add, no reordering of sums.
            -ffp-contract=off -fno-math-errno
            # Everything alike, modules and programs, so that they share precompiled headers.
            -fPIC -fno-semantic-interposition
            -Wall -Wextra -Wpedantic -Wconversion
            -Wno-sign-conversion
            # Where sources are compiled as one, a local name may be that of another source's constant,
            # and GCC takes them for headers, whose unnamed namespaces it warns of.
            $<IF:$<AND:$<CXX_COMPILER_ID:GNU>,$<BOOL:${CMAKE_UNITY_BUILD}>>,-Wshadow=local;-Wno-subobject-linkage,-Wshadow>
            # False alarms of GCC 12 on concatenated strings and on variants (GCC PR 105651, 105562).
            $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict -Wno-maybe-uninitialized -Wno-stringop-overflow
            -Wno-stringop-overread -Wno-array-bounds>
            $<$<BOOL:${GHTRACK_WARNINGS_AS_ERRORS}>:-Werror>)

# ghtrack_add_library(<name> SOURCES ... [QUICKLY sources...] HEADERS ... [PUBLIC targets...]
#                     [PRIVATE targets...] [PRECOMPILED target])
# A library named ghtrack::<name>, whose headers are included from the root: "tracker/track.hpp".
# QUICKLY: sources to which ghtrack_compile_quickly applies.
function(ghtrack_add_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "PRECOMPILED" "SOURCES;QUICKLY;HEADERS;PUBLIC;PRIVATE")
  if(NOT arg_PRECOMPILED)
    set(arg_PRECOMPILED ghtrack_common_headers)
  endif()
  set(target ghtrack_${name})
  if(arg_SOURCES)
    add_library(${target} STATIC ${arg_SOURCES})
    set(scope PUBLIC)
    target_link_libraries(${target} PUBLIC ${arg_PUBLIC} PRIVATE $<BUILD_INTERFACE:ghtrack_options> ${arg_PRIVATE})
    target_precompile_headers(${target} REUSE_FROM ${arg_PRECOMPILED})
    if(arg_QUICKLY)
      add_library(${target}_quickly OBJECT ${arg_QUICKLY})
      target_link_libraries(${target}_quickly PRIVATE ghtrack_options ${arg_PUBLIC} ${arg_PRIVATE})
      target_precompile_headers(${target}_quickly REUSE_FROM ${arg_PRECOMPILED})
      ghtrack_compile_quickly(${target}_quickly)
      target_sources(${target} PRIVATE $<TARGET_OBJECTS:${target}_quickly>)
    endif()
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
    target_link_libraries(${target} INTERFACE ${arg_PUBLIC})
  endif()
  add_library(ghtrack::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} OUTPUT_NAME ghtrack_${name})
  target_compile_features(${target} ${scope} cxx_std_20)
  target_sources(${target} ${scope} FILE_SET HEADERS BASE_DIRS "${PROJECT_SOURCE_DIR}" FILES ${arg_HEADERS})
endfunction()

# ghtrack_compile_quickly(<target>...)
# For what runs once or waits for files, such as reading options and writing text: a third less to
# compile, and no result depends on it.
function(ghtrack_compile_quickly)
  foreach(target IN LISTS ARGN)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endforeach()
endfunction()

# ghtrack_add_test(<folder> SOURCES ... LINK targets... [DEFINITIONS ...])
# One test program per folder of tests/, with the folder's name as its ctest label.
function(ghtrack_add_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LINK;DEFINITIONS")
  set(target ${name}_tests)
  add_executable(${target} ${arg_SOURCES})
  target_link_libraries(${target} PRIVATE ghtrack_options ${arg_LINK} GTest::gmock GTest::gtest_main)
  target_compile_definitions(${target} PRIVATE GHTRACK_SOURCE_DIR="${PROJECT_SOURCE_DIR}" ${arg_DEFINITIONS})
  target_precompile_headers(${target} REUSE_FROM ghtrack_test_headers)
  ghtrack_compile_quickly(${target})
  # A test of half a minute takes ten times as long with the sanitizers.
  set(timeout 300)
  if(CMAKE_CXX_FLAGS MATCHES "sanitize=")
    set(timeout 900)
  endif()
  gtest_discover_tests(${target} NO_PRETTY_VALUES NO_PRETTY_TYPES
                       PROPERTIES LABELS ${name} TIMEOUT ${timeout} DISCOVERY_TIMEOUT 60)
endfunction()
