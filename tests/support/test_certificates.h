// Certificates for tests: an authority of their own, made in memory.
#ifndef ARGMESH_TESTS_SUPPORT_TEST_CERTIFICATES_H_
#define ARGMESH_TESTS_SUPPORT_TEST_CERTIFICATES_H_

#include <memory>
#include <string>

namespace argmesh {

struct TestCertificate {
  std::string certificate;  // PEM
  std::string private_key;  // PEM
};

class TestAuthority {
 public:
  explicit TestAuthority(const std::string& name);
  ~TestAuthority();

  std::string certificate() const;  // PEM
  // For DNS name `name` and 127.0.0.1, valid for an hour.
  TestCertificate Issue(const std::string& name, long serial) const;

 private:
  struct Parts;
  const std::unique_ptr<Parts> parts_;
};

}  // namespace argmesh

#endif  // ARGMESH_TESTS_SUPPORT_TEST_CERTIFICATES_H_
