#include "tools/html/template.hpp"

#include <kainjow/mustache.hpp>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace ghtrack::html {
namespace {

using kainjow::mustache::data;

data to_mustache(const nlohmann::json& value) {
  switch (value.type()) {
    case nlohmann::json::value_t::object: {
      data object(data::type::object);
      for (const auto& [key, member] : value.items()) object.set(key, to_mustache(member));
      return object;
    }
    case nlohmann::json::value_t::array: {
      data list(data::type::list);
      for (const nlohmann::json& element : value) list.push_back(to_mustache(element));
      return list;
    }
    case nlohmann::json::value_t::null:
      return data(data::type::bool_false);
    case nlohmann::json::value_t::boolean:
      return data(value.get<bool>());
    case nlohmann::json::value_t::string:
      if (value.get_ref<const std::string&>().empty()) return data(data::type::bool_false);
      return data(value.get<std::string>());
    default:
      return data(value.dump());
  }
}

}  // namespace

std::string filled(std::string_view mustache, const nlohmann::json& values) {
  kainjow::mustache::mustache page{std::string(mustache)};
  if (!page.is_valid()) throw std::invalid_argument("template: " + page.error_message());
  return page.render(to_mustache(values));
}

std::string escaped(std::string_view text) {
  return kainjow::mustache::html_escape<std::string>(std::string(text));
}

std::string json_for_script(const nlohmann::json& values) {
  std::string text;
  for (const char c : values.dump()) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

}  // namespace ghtrack::html
