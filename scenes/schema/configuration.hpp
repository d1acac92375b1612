#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "scenes/schema/describe.hpp"
#include "scenes/schema/diagnostic.hpp"
#include "scenes/schema/document.hpp"

namespace ghtrack::schema {

/// Reads a text into an object of a described type; what the text does not mention stays.
/// @throws SceneError with all that is wrong
void read_configuration(std::string_view text, const std::string& name,
                        std::span<const std::string> overrides, const Type& type, void* object);

/// A text that holds one value of any described type, such as a TrackerConfig.
/// @param name  stands for the file in messages
/// @throws SceneError with all that is wrong
template <class T>
T read_configuration_text(std::string_view text, const std::string& name,
                          std::span<const std::string> overrides = {}) {
  T value{};
  read_configuration(text, name, overrides, type_of<T>(), &value);
  return value;
}

/// The same for a file.
template <class T>
T read_configuration_file(const std::filesystem::path& file,
                          std::span<const std::string> overrides = {}) {
  return read_configuration_text<T>(read_document_bytes(file), document_name(file), overrides);
}

/// An object of a described type as a file that reads back to the same.
std::string write_configuration(const Type& type, const void* object);

template <class T>
std::string write_configuration(const T& value) {
  return write_configuration(type_of<T>(), &value);
}

}  // namespace ghtrack::schema
