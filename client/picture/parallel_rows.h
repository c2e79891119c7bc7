// Rows of a picture shared out between threads. What a row computes must not
// depend on another row of the same call.
#ifndef ARGMESH_CLIENT_PICTURE_PARALLEL_ROWS_H_
#define ARGMESH_CLIENT_PICTURE_PARALLEL_ROWS_H_

#include <functional>

namespace argmesh {

// Calls row(0) .. row(rows - 1), each once; `threads` 0 for one per core.
void ParallelRows(int rows, int threads, const std::function<void(int)>& row);

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_PICTURE_PARALLEL_ROWS_H_
