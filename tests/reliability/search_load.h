// Searches by a mesh, the dearest question, asked of a server from four
// connections: as fast as it answers, or as often as one likes.
#ifndef ARGMESH_TESTS_RELIABILITY_SEARCH_LOAD_H_
#define ARGMESH_TESTS_RELIABILITY_SEARCH_LOAD_H_

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "argmesh/v1/search_service.grpc.pb.h"
#include "tests/reliability/witness.h"

namespace argmesh {

// What was refused did not fail.
struct LoadOutcome : Testimony {
  int refused = 0;     // with RESOURCE_EXHAUSTED
  double seconds = 0;  // until the last call ended

  double answered_per_second() const;
};

class SearchLoad {
 public:
  SearchLoad(const std::string& address, v1::SearchShapesRequest request);
  ~SearchLoad();

  // So many callers, each asking again as soon as it is answered.
  LoadOutcome Closed(int callers, std::chrono::milliseconds time);
  // So many calls a second, whether or not earlier ones have been answered.
  LoadOutcome Open(double calls_per_second, std::chrono::milliseconds time);

 private:
  class Tally;

  const v1::SearchShapesRequest request_;
  std::vector<std::unique_ptr<v1::SearchService::Stub>> stubs_;
};

}  // namespace argmesh

#endif  // ARGMESH_TESTS_RELIABILITY_SEARCH_LOAD_H_
