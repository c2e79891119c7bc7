// The priority queue of a shortest-path search: pairs of a distance and a
// vertex, nearest first, ties by vertex.
#ifndef ARGMESH_CORE_GEOMETRY_VERTEX_QUEUE_H_
#define ARGMESH_CORE_GEOMETRY_VERTEX_QUEUE_H_

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace argmesh {

// A heap of four children per node over 64-bit keys: the bits of a float >= 0
// are in the order of its value, so one integer comparison orders a pair.
class VertexQueue {
 public:
  bool empty() const { return keys_.empty(); }
  void Clear() { keys_.clear(); }

  // `distance` >= 0.
  void Push(float distance, int32_t vertex) {
    const uint64_t key = uint64_t{std::bit_cast<uint32_t>(distance)} << 32 |
                         static_cast<uint32_t>(vertex);
    size_t at = keys_.size();
    keys_.push_back(key);
    uint64_t* const keys = keys_.data();
    while (at > 0 && key < keys[(at - 1) / 4]) {
      keys[at] = keys[(at - 1) / 4];
      at = (at - 1) / 4;
    }
    keys[at] = key;
  }

  // The nearest; the queue must not be empty.
  std::pair<float, int32_t> Pop() {
    const uint64_t top = keys_.front();
    const uint64_t last = keys_.back();
    keys_.pop_back();
    if (!keys_.empty()) SiftDown(last);
    return {std::bit_cast<float>(static_cast<uint32_t>(top >> 32)),
            static_cast<int32_t>(static_cast<uint32_t>(top))};
  }

 private:
  void SiftDown(uint64_t key) {
    uint64_t* const keys = keys_.data();
    const size_t size = keys_.size();
    size_t at = 0;
    for (size_t child = 1; child < size; child = 4 * at + 1) {
      const size_t end = std::min(child + 4, size);
      size_t least = child;
      for (size_t c = child + 1; c < end; ++c) {
        if (keys[c] < keys[least]) least = c;
      }
      if (keys[least] >= key) break;
      keys[at] = keys[least];
      at = least;
    }
    keys[at] = key;
  }

  std::vector<uint64_t> keys_;
};

}  // namespace argmesh

#endif  // ARGMESH_CORE_GEOMETRY_VERTEX_QUEUE_H_
