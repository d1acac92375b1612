# Headers that most sources include, parsed once for all targets instead of once a source. Sources
# include what they use all the same: the preset `clang` builds without precompiled headers.

set(ghtrack_common_headers
    <Eigen/Core>
    <Eigen/Geometry>
    <algorithm>
    <array>
    <charconv>
    <cmath>
    <cstdint>
    <filesystem>
    <functional>
    <limits>
    <map>
    <memory>
    <numbers>
    <numeric>
    <optional>
    <span>
    <sstream>
    <stdexcept>
    <string>
    <string_view>
    <tuple>
    <utility>
    <variant>
    <vector>)

# ghtrack_precompile(<name> HEADERS <header>... [LINK targets...])
# A target whose precompiled headers, the common ones and these, other targets reuse:
#   target_precompile_headers(<target> REUSE_FROM <name>)
function(ghtrack_precompile name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "HEADERS;LINK")
  set(source "${PROJECT_BINARY_DIR}/precompiled/${name}.cpp")
  file(CONFIGURE OUTPUT "${source}" CONTENT "// Carries precompiled headers.\n")
  add_library(${name} OBJECT "${source}")
  target_link_libraries(${name} PRIVATE ghtrack_options Eigen3::Eigen ${arg_LINK})
  target_precompile_headers(${name} PRIVATE ${ghtrack_common_headers} ${arg_HEADERS})
endfunction()
