# cmake -DINPUT=… -DOUTPUT=… -DNAME=… -P embed_file.cmake: writes a C++ source with the bytes of INPUT.
file(READ "${INPUT}" hex HEX)
string(REGEX REPLACE "(..)" "'\\\\x\\1'," bytes "${hex}")
string(LENGTH "${hex}" digits)
math(EXPR size "${digits} / 2")
file(
  WRITE "${OUTPUT}"
  "#include <string_view>
namespace ghtrack::embedded {
extern const std::string_view ${NAME};
namespace {
constexpr char bytes[] = {${bytes}'\\0'};
}
constinit const std::string_view ${NAME}(bytes, ${size});
}  // namespace ghtrack::embedded
")
