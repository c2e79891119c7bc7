// Random version-4 UUIDs in their text form, from the kernel's generator.
#ifndef ARGMESH_SERVER_ENGINE_UID_H_
#define ARGMESH_SERVER_ENGINE_UID_H_

#include <string>
#include <string_view>

namespace argmesh {

std::string MakeUid();

// "xxxxxxxx-xxxx-xxxx-xxxx-xxxxxxxxxxxx" of hexadecimal digits, any case.
bool IsUid(std::string_view text);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_UID_H_
