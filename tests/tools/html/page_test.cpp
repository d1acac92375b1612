#include "tools/html/page.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tools/html/template.hpp"

namespace ghtrack::html {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// Property: what a user names cannot become an element or leave an attribute.
TEST(Template, EscapesValues) {
  EXPECT_EQ(
      filled("<p title=\"{{name}}\">{{name}}</p>", {{"name", "<img src=x \"'&>"}}),
      "<p title=\"&lt;img src=x &quot;&apos;&amp;&gt;\">&lt;img src=x &quot;&apos;&amp;&gt;</p>");
}

// Property: lists repeat, empty lists and nulls take the other branch.
TEST(Template, RepeatsListsAndKnowsEmptyOnes) {
  const std::string_view mustache = "{{#rows}}[{{name}}]{{/rows}}{{^rows}}none{{/rows}}";
  EXPECT_EQ(filled(mustache, {{"rows", {{{"name", "a"}}, {{"name", "b"}}}}}), "[a][b]");
  EXPECT_EQ(filled(mustache, {{"rows", nlohmann::json::array()}}), "none");
  EXPECT_EQ(filled(mustache, {{"rows", nullptr}}), "none");
}

// Property: a template is checked, because its author errs.
TEST(Template, RefusesWhatIsNoMustache) {
  EXPECT_THROW(filled("{{#open}}", {}), std::invalid_argument);
}

// Property: no string in the data can end the script element that carries them.
TEST(Template, DataForAScriptCannotEndIt) {
  const nlohmann::json values = {{"name", "</script><script>alert(1)"}};
  EXPECT_THAT(json_for_script(values), Not(HasSubstr("<")));
  EXPECT_EQ(nlohmann::json::parse(json_for_script(values)), values);
}

// Derived: the hash of "alert(1)" as `printf 'alert(1)' | openssl dgst -sha256 -binary | base64`
// prints it.
TEST(Page, AllowsItsOwnScriptsByTheirHashAndNoOthers) {
  const std::string html = to_html({.title = "a < b",
                                    .description = "d",
                                    .body = "<main></main>",
                                    .styles = {"p{}"},
                                    .scripts = {"alert(1)"}});
  EXPECT_THAT(html, HasSubstr("script-src &apos;sha256-"
                              "bhHHL3z2vDgxUt0W3dWQOrprscmda2Y5pLsLg4GF+pI=&apos;;"));
  EXPECT_THAT(html, HasSubstr("default-src &apos;none&apos;"));
  EXPECT_THAT(html, Not(HasSubstr("unsafe")));
  EXPECT_THAT(html, HasSubstr("<title>a &lt; b</title>"));
}

// Property: WebAssembly is allowed only where a page says that it needs it.
TEST(Page, AllowsWebAssemblyOnRequest) {
  const std::string html = to_html({.title = "t",
                                    .description = "d",
                                    .body = "",
                                    .styles = {},
                                    .scripts = {},
                                    .runs_wasm = true});
  EXPECT_THAT(html, HasSubstr("&apos;wasm-unsafe-eval&apos;"));
}

}  // namespace
}  // namespace ghtrack::html
