#include "server/rpc/request_names.h"

#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <iterator>
#include <string_view>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"

namespace argmesh {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

constexpr char kCollections[] = "collections/";

constexpr std::string_view kNameFields[] = {"name", "names", "parent", "shape",
                                            "collection"};

// Messages whose content is no business of names, and may be large.
constexpr std::string_view kContents[] = {"Mesh", "MeshContent", "ShapeGraph",
                                          "CollectionSettings"};

template <size_t N>
bool Contains(const std::string_view (&list)[N], const std::string& text) {
  return std::find(std::begin(list), std::end(list), text) != std::end(list);
}

void Collect(const Message& message, std::vector<std::string>& names);

void CollectStrings(const Message& message, const FieldDescriptor& field,
                    std::vector<std::string>& names) {
  const Reflection& reflection = *message.GetReflection();
  const bool new_collection = field.name() == "collection_id";
  if (!new_collection && !Contains(kNameFields, field.name())) return;
  const auto add = [&](std::string value) {
    if (value.empty()) return;
    names.push_back(new_collection ? absl::StrCat(kCollections, value)
                                   : std::move(value));
  };
  if (!field.is_repeated()) {
    add(reflection.GetString(message, &field));
    return;
  }
  for (int i = 0; i < reflection.FieldSize(message, &field); ++i) {
    add(reflection.GetRepeatedString(message, &field, i));
  }
}

void CollectMessages(const Message& message, const FieldDescriptor& field,
                     std::vector<std::string>& names) {
  const Reflection& reflection = *message.GetReflection();
  if (field.is_map() || Contains(kContents, field.message_type()->name())) {
    return;
  }
  if (!field.is_repeated()) {
    Collect(reflection.GetMessage(message, &field), names);
    return;
  }
  for (int i = 0; i < reflection.FieldSize(message, &field); ++i) {
    Collect(reflection.GetRepeatedMessage(message, &field, i), names);
  }
}

void Collect(const Message& message, std::vector<std::string>& names) {
  std::vector<const FieldDescriptor*> fields;
  message.GetReflection()->ListFields(message, &fields);
  for (const FieldDescriptor* field : fields) {
    switch (field->cpp_type()) {
      case FieldDescriptor::CPPTYPE_STRING:
        CollectStrings(message, *field, names);
        break;
      case FieldDescriptor::CPPTYPE_MESSAGE:
        CollectMessages(message, *field, names);
        break;
      default:
        break;
    }
  }
}

}  // namespace

std::vector<std::string> RequestNames(const Message& request) {
  std::vector<std::string> names;
  Collect(request, names);
  return names;
}

std::string CollectionOfName(const std::string& name) {
  if (!absl::StartsWith(name, kCollections)) return "";
  const size_t begin = sizeof(kCollections) - 1;
  return name.substr(begin, name.find('/', begin) - begin);
}

}  // namespace argmesh
