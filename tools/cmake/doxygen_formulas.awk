# Doxygen's view of a header: indented lines of a doc comment are formulas and keep their shape.
# What is indented below @param, @returns or @throws goes on with its sentence.
function close_formula() {
  if (in_formula) print "/// @endverbatim"
  in_formula = 0
}
/^ *\/\/\/( |$)/ {
  text = $0
  sub(/^ *\/\/\//, "", text)
  if (text ~ /@(param|tparam|returns?|throws?)/) in_tag = 1
  else if (text !~ /^  /) in_tag = 0
  if (text ~ /^   *[^ ]/ && !in_tag) {
    if (!in_formula) print "/// @verbatim"
    in_formula = 1
    print "///" text
    next
  }
  close_formula()
  print
  next
}
{
  close_formula()
  in_tag = 0
  print
}
