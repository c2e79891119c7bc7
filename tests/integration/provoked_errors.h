// Ways to bring about every ErrorReason, each by its name.
//
// Most come over the wire from a server on its own storage. What no request
// can bring about is provoked by a fault: a damaged row, a folder that went, a
// catalog that loads for ever or throws. Late and cancelled calls are asked of
// the engine itself: a client's own clock would answer first.
#ifndef ARGMESH_TESTS_INTEGRATION_PROVOKED_ERRORS_H_
#define ARGMESH_TESTS_INTEGRATION_PROVOKED_ERRORS_H_

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "tests/integration/generic_call.h"
#include "tests/integration/server_fixture.h"

namespace argmesh {

class ProvokedErrors {
 public:
  using Provoke = std::function<ErrorOf()>;
  using Provocations = std::map<std::string, Provoke>;

  // Starts a server with a collection "c" and a shape in it.
  ProvokedErrors();

  // "SHAPE_NOT_FOUND" to what must answer it. They may run in any order, each
  // once, one at a time.
  Provocations All();

 private:
  using Message = google::protobuf::Message;

  // `method` is "ShapeService/GetShape".
  static ErrorOf Call(TestServer& server, const std::string& method,
                      const Message& request, const std::string& key = "");
  // The call of a request that `change` has been done to.
  template <typename Request, typename Change>
  Provoke Calling(const std::string& method, Request request, Change change) {
    change(request);
    return [this, method, request = std::move(request)] {
      return Call(server_, method, request);
    };
  }
  template <typename Request>
  Provoke Calling(const std::string& method, Request request) {
    return Calling(method, std::move(request), [](Request&) {});
  }

  Provocations OfRequests();
  Provocations OfFilters();
  Provocations OfMeshes();
  Provocations OfResources();
  Provocations OfSnapshots();
  Provocations OfGraphs();
  Provocations OfStreams();
  Provocations OfKeys();
  Provocations OfStops();
  Provocations OfFaults();
  Provocations OfFaultyEngines();

  ErrorOf Upload(const std::function<void(v1::UploadShapeHeader&)>& change,
                 const std::string& chunk);
  ErrorOf CallWithKeys(const std::string& key);
  static ErrorOf DamageAGraph();
  static ErrorOf ImportFromOutside();
  ErrorOf CallFaulty(const std::string& method, const Message& request);

  TestServer server_;
};

// Requests of the server's collection and shape.
inline constexpr char kTorusName[] = "collections/c/shapes/torus";
v1::CreateShapeRequest NewShapeOf(const std::string& id,
                                  const std::string& mesh);
v1::SearchShapesRequest SearchFor(const std::string& shape);
template <typename Request>
Request Named(const std::string& name) {
  Request request;
  request.set_name(name);
  return request;
}

}  // namespace argmesh

#endif  // ARGMESH_TESTS_INTEGRATION_PROVOKED_ERRORS_H_
