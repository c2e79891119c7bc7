#include <memory>
#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "client/cli/command_set.h"
#include "client/resource_name.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr char kDeclareDetails[] =
    R"(Says which metadata keys --filter may name, and whether their values are string,
number or bool. The list takes the place of the one before; without any key
nothing is declared any more. Values of all shapes must be of the types.

Examples:
  argmesh declare --collection parts class:string mass:number
  argmesh search --collection parts --filter 'mass < 2' query.stl)";

struct DeclareArguments {
  std::string collection;
  std::vector<std::string> keys;  // NAME:TYPE
};

absl::StatusOr<v1::MetadataKey> ParseKey(const std::string& text) {
  const size_t colon = text.rfind(':');
  v1::MetadataKey key;
  v1::MetadataType type = v1::METADATA_TYPE_UNSPECIFIED;
  if (colon == std::string::npos ||
      !v1::MetadataType_Parse(
          absl::StrCat("METADATA_TYPE_",
                       absl::AsciiStrToUpper(text.substr(colon + 1))),
          &type)) {
    return UsageError(text + ": not KEY:string, KEY:number or KEY:bool");
  }
  key.set_key(text.substr(0, colon));
  key.set_type(type);
  return key;
}

absl::StatusOr<int> Declare(const Session& session,
                            const DeclareArguments& arguments) {
  v1::UpdateCollectionRequest request;
  v1::Collection& collection = *request.mutable_collection();
  collection.set_name(CollectionName(arguments.collection));
  for (const std::string& text : arguments.keys) {
    ARGMESH_ASSIGN_OR_RETURN(*collection.add_metadata_keys(), ParseKey(text));
  }
  request.mutable_update_mask()->add_paths("metadata_keys");
  ARGMESH_ASSIGN_OR_RETURN(const auto client, session.Connect());
  ARGMESH_ASSIGN_OR_RETURN(const v1::Collection updated,
                           client->UpdateCollection(request));
  if (session.options.json) {
    session.Print(ToJson(updated));
  } else {
    session.out << updated.metadata_keys_size() << " keys declared\n";
  }
  return kExitOk;
}

}  // namespace

void AddDeclareCommand(CLI::App& app, CommandSet& commands) {
  const auto arguments = std::make_shared<DeclareArguments>();
  CLI::App* command = commands.Add(
      app,
      {"declare", "Declare the metadata keys that filters may name.",
       kDeclareDetails},
      [arguments](const Session& session) {
        return Declare(session, *arguments);
      });
  AddCollectionOption(command, arguments->collection);
  command->add_option("KEY:TYPE", arguments->keys, "Keys with their types")
      ->type_name("");
}

}  // namespace argmesh
