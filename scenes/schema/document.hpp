#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/schema/diagnostic.hpp"
#include "scenes/schema/node.hpp"

namespace ghtrack::schema {

/// What a strict parser accepts of YAML: one document of at most 1 MiB in UTF-8, scalars, lists and
/// mappings with unique text keys. No anchors, aliases, tags or merge keys, nesting up to 32 deep.
inline constexpr std::size_t kMaxDocumentBytes = std::size_t{1} << 20U;
inline constexpr std::size_t kMaxScalarBytes = std::size_t{1} << 16U;
inline constexpr std::size_t kMaxNodes = 200'000;
inline constexpr std::size_t kMaxDepth = 32;

/// What a file is called in messages: its path, or "standard input" for `-`.
std::string document_name(const std::filesystem::path& file);

/// Bytes of a regular file, or of standard input (`-`) and what else the process has open under
/// /dev/fd. Never waits for another pipe or a device.
/// @throws SceneError if it cannot be read or is longer than kMaxDocumentBytes
std::string read_document_bytes(const std::filesystem::path& file);

/// The document as a tree. Problems that leave the rest readable, such as a duplicate key, are
/// added to `found`.
/// @param name  of the file, for messages
/// @throws SceneError if the text cannot be read as a document
Node parse_document(std::string_view text, const std::string& name, std::vector<Diagnostic>& found);

}  // namespace ghtrack::schema
