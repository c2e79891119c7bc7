// Seeded random numbers that are the same on every machine and compiler.
//
// Source   Steele, Lea, Flood, "Fast Splittable Pseudorandom Number
//          Generators" (SplitMix64), OOPSLA 2014.
// Repeats  equal seeds give equal streams; nothing reads the clock.
// Cost     O(1) each. One generator belongs to one thread.
#ifndef ARGMESH_CORE_BASE_RANDOM_H_
#define ARGMESH_CORE_BASE_RANDOM_H_

#include <cstdint>

namespace argmesh {

class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}

  uint64_t NextU64();
  // Uniform in [0, 1).
  double Uniform();
  double Uniform(double low, double high);
  // Uniform in [0, bound); bound > 0.
  uint64_t Below(uint64_t bound);
  // Standard normal by Box-Muller.
  double Normal();

 private:
  uint64_t state_;
};

}  // namespace argmesh

#endif  // ARGMESH_CORE_BASE_RANDOM_H_
