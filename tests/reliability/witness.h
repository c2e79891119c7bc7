// An ordinary client beside whatever is done to the server: is it answered,
// and how fast?
#ifndef ARGMESH_TESTS_RELIABILITY_WITNESS_H_
#define ARGMESH_TESTS_RELIABILITY_WITNESS_H_

#include <atomic>
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace argmesh {

struct Testimony {
  std::vector<double> milliseconds;  // of the calls that were answered, sorted
  int failed = 0;
  std::string failure;  // the first one's message

  // 0 .. 1; 0 without calls.
  double Quantile(double share) const;
  double p99() const { return Quantile(0.99); }
};

class Witness {
 public:
  // A call; empty when it was answered, else why not.
  using Call = std::function<std::string()>;

  // Makes one call after the other until the testimony is taken.
  explicit Witness(Call call);
  ~Witness();
  Witness(const Witness&) = delete;
  Witness& operator=(const Witness&) = delete;

  // Once.
  Testimony Take();

 private:
  void Run();

  const Call call_;
  Testimony testimony_;
  std::atomic<bool> stopped_{false};
  std::thread thread_;
};

}  // namespace argmesh

#endif  // ARGMESH_TESTS_RELIABILITY_WITNESS_H_
