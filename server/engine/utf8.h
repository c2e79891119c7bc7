// Whether bytes are well-formed UTF-8 (RFC 3629): no overlong forms, no
// surrogates, nothing above U+10FFFF. Cost O(bytes).
#ifndef ARGMESH_SERVER_ENGINE_UTF8_H_
#define ARGMESH_SERVER_ENGINE_UTF8_H_

#include <string_view>

namespace argmesh {

bool IsUtf8(std::string_view text);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_UTF8_H_
