# cmake -DINPUT=… -DOUTPUT=… -DNAME=… -P embed_file.cmake: writes a C++ source with the bytes of INPUT,
# which the assembler takes from the file itself.
file(SIZE "${INPUT}" size)
file(
  WRITE "${OUTPUT}"
  "#include <string_view>
__asm__(
    \".section .rodata\\n\"
    \".hidden ghtrack_embedded_${NAME}\\n\"
    \".global ghtrack_embedded_${NAME}\\n\"
    \"ghtrack_embedded_${NAME}:\\n\"
    \".incbin \\\"${INPUT}\\\"\\n\"
    \".byte 0\\n\"
    \".previous\\n\");
extern \"C\" const char ghtrack_embedded_${NAME}[];
namespace ghtrack::embedded {
extern const std::string_view ${NAME};
constinit const std::string_view ${NAME}(ghtrack_embedded_${NAME}, ${size});
}  // namespace ghtrack::embedded
")
