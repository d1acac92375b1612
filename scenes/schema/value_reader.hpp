#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scenes/schema/diagnostic.hpp"
#include "scenes/schema/node.hpp"
#include "scenes/schema/type.hpp"

namespace ghtrack::schema {

/// Fills values from a document and notes all that is wrong with it.
class ValueReader {
 public:
  /// @param origins  names of the file and of the overrides, as Node::origin counts them
  ValueReader(const std::vector<std::string>& origins, std::vector<Diagnostic>& found)
      : origins_(origins), found_(found) {}

  /// Reads what the node says into an object of that type. Keys that are absent leave the object's
  /// values as they are: these are the defaults.
  void read(const Node& node, const Type& type, void* object, const FieldInfo& info = {});

 private:
  /// Which members of a mapping have been asked for.
  struct Mapping {
    const Node& node;
    std::vector<bool> used;
    const Node::Member* take(std::string_view key);
  };

  void read_real(const Node& node, void* object, const FieldInfo& info);
  void read_integer(const Node& node, const IntegerType& type, void* object, const FieldInfo& info);
  void read_boolean(const Node& node, void* object);
  void read_text(const Node& node, void* object);
  void read_enum(const Node& node, const EnumType& type, void* object);
  void read_list(const Node& node, const ListType& type, void* object, const FieldInfo& info);
  void read_map(const Node& node, const MapType& type, void* object, const FieldInfo& info);
  void read_variant(const Node& node, const VariantType& type, void* object);
  void read_struct(const Node& node, const StructType& type, void* object);

  void read_fields(Mapping& mapping, const StructType& type, void* object);
  void read_field(Mapping& mapping, const FieldType& field, void* object);
  void read_one_of(Mapping& mapping, const FieldType& field, void* object);
  void read_tagged(Mapping& mapping, const FieldType& field, void* object);
  void read_preset(Mapping& mapping, const StructType& type, const FieldType& field, void* object);
  void read_child(const Node::Member& member, const Type& type, void* object,
                  const FieldInfo& info);
  std::string scalar_name(const Node& node, std::string_view key);
  void report_unknown_keys(const Mapping& mapping, const StructType& type, const void* object);
  void run_checks(const Node& node, const StructType& type, const void* object);

  bool expect(const Node& node, Node::Kind kind, std::string_view what);
  void report(const Node& node, const std::string& message) { report_at(node, path_, message); }
  void report_at(const Node& node, const std::string& path, const std::string& message);
  void report_key(const Node::Member& member, const std::string& message);

  const std::vector<std::string>& origins_;
  std::vector<Diagnostic>& found_;
  std::string path_;
};

}  // namespace ghtrack::schema
