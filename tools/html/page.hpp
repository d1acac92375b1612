#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ghtrack::html {

/// A web page in one file that needs no network. Its Content-Security-Policy lets it run and show
/// exactly the scripts and styles given here, and load nothing.
struct Page {
  std::string title;                      // plain text
  std::string description;                // plain text
  std::string body;                       // HTML, made by a template that escapes
  std::vector<std::string_view> styles;   // CSS
  std::vector<std::string_view> scripts;  // run in this order, after the body
  bool runs_wasm = false;
};

std::string to_html(const Page& page);

/// Colours, type and controls that all pages share: light and dark, on screens and on paper.
std::string_view base_style();

}  // namespace ghtrack::html
