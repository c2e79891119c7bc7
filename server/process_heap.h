// What the process takes of the machine's memory beyond what it uses.
#ifndef ARGMESH_SERVER_PROCESS_HEAP_H_
#define ARGMESH_SERVER_PROCESS_HEAP_H_

namespace argmesh {

// Before the first thread: glibc makes two heaps a CPU at most, each as large
// as the threads that share it need at once, and what is large lies in none of
// them and goes back when it is freed.
void LimitHeaps();

// Gives free pages of all heaps back. Others' allocations wait meanwhile: 1 ms
// for a heap of 20 MiB. Thread-safe.
void TrimHeaps();

}  // namespace argmesh

#endif  // ARGMESH_SERVER_PROCESS_HEAP_H_
