// Writes the playground as a page by itself: write_playground FILE.html

#include <cstdio>
#include <fstream>

#include "tools/html/page.hpp"
#include "tools/playground/playground.hpp"

int main(int count, char** arguments) {
  const auto part = ghtrack::playground();
  if (count != 2 || !part) return 2;
  const ghtrack::html::Page page{
      .title = "The g-h filter, live",
      .description =
          "Sliders for the gains and the initial guess of a g-h or g-h-k filter, its "
          "estimates, stability, damping, noise reduction and lag.",
      .body = "<main>\n<h1>The g-h filter, live</h1>\n" + part->section + "</main>",
      .styles = {ghtrack::html::base_style(), part->style},
      .scripts = {part->script},
      .runs_wasm = true};
  std::ofstream file(arguments[1], std::ios::binary);
  file << ghtrack::html::to_html(page);
  file.close();
  if (!file) std::fprintf(stderr, "%s cannot be written\n", arguments[1]);
  return file ? 0 : 1;
}
