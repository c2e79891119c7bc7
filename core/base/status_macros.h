// Early return on error for absl::Status and absl::StatusOr.
//
//   ARGMESH_RETURN_IF_ERROR(Check(x));
//   ARGMESH_ASSIGN_OR_RETURN(const TriangleMesh mesh, ParseMesh(bytes));
#ifndef ARGMESH_CORE_BASE_STATUS_MACROS_H_
#define ARGMESH_CORE_BASE_STATUS_MACROS_H_

#include <utility>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

#define ARGMESH_RETURN_IF_ERROR(expr)                   \
  do {                                                  \
    if (absl::Status status_ = (expr); !status_.ok()) { \
      return status_;                                   \
    }                                                   \
  } while (false)

#define ARGMESH_ASSIGN_OR_RETURN(lhs, expr)                                   \
  ARGMESH_ASSIGN_OR_RETURN_IMPL_(ARGMESH_MACRO_CONCAT_(status_or_, __LINE__), \
                                 lhs, expr)

#define ARGMESH_MACRO_CONCAT_INNER_(a, b) a##b
#define ARGMESH_MACRO_CONCAT_(a, b) ARGMESH_MACRO_CONCAT_INNER_(a, b)
// `lhs` may declare a variable, so it has no parentheses.
// NOLINTBEGIN(bugprone-macro-parentheses)
#define ARGMESH_ASSIGN_OR_RETURN_IMPL_(tmp, lhs, expr) \
  auto tmp = (expr);                                   \
  if (!tmp.ok()) return std::move(tmp).status();       \
  lhs = std::move(tmp).value()
// NOLINTEND(bugprone-macro-parentheses)

#endif  // ARGMESH_CORE_BASE_STATUS_MACROS_H_
