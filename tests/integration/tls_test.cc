// Encryption: certificates of the server and of clients, and their exchange
// while calls run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openssl/bio.h>
#include <openssl/pem.h>
#include <openssl/x509.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "tests/integration/server_fixture.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/test_certificates.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;

long SerialOf(const std::string& pem) {
  BIO* in = BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size()));
  X509* certificate = PEM_read_bio_X509(in, nullptr, nullptr, nullptr);
  BIO_free(in);
  if (certificate == nullptr) return -1;
  const long serial = ASN1_INTEGER_get(X509_get0_serialNumber(certificate));
  X509_free(certificate);
  return serial;
}

class TlsTest : public ::testing::Test {
 protected:
  // Under another name first: the server never sees half a file.
  std::string Write(const std::string& name, const std::string& text) const {
    const std::filesystem::path path = folder_.path() / name;
    std::ofstream(path.string() + ".part") << text;
    std::filesystem::rename(path.string() + ".part", path);
    return path;
  }

  TlsOptions Files(const TestCertificate& certificate) const {
    return {.certificate = Write("cert.pem", certificate.certificate),
            .private_key = Write("key.pem", certificate.private_key),
            .client_authorities = ""};
  }

  void Start(const TlsOptions& tls) {
    TestServerOptions options;
    options.rpc.tls = tls;
    server_ = std::make_unique<TestServer>(options);
    server_->Start();
  }

  // A connection of its own.
  std::shared_ptr<grpc::Channel> Connect(
      const std::shared_ptr<grpc::ChannelCredentials>& credentials) const {
    grpc::ChannelArguments arguments;
    arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
    return grpc::CreateCustomChannel(server_->rpc().address(), credentials,
                                     arguments);
  }
  std::shared_ptr<grpc::ChannelCredentials> Trusting(
      const TestAuthority& authority, const TestCertificate& own = {}) const {
    return grpc::SslCredentials({.pem_root_certs = authority.certificate(),
                                 .pem_private_key = own.private_key,
                                 .pem_cert_chain = own.certificate});
  }

  static grpc::Status Ask(const std::shared_ptr<grpc::Channel>& channel,
                          long* serial = nullptr) {
    const auto stub = v1::AdminService::NewStub(channel);
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() +
                         std::chrono::seconds(20));
    v1::GetServerInfoResponse response;
    const grpc::Status status =
        stub->GetServerInfo(&context, v1::GetServerInfoRequest(), &response);
    if (serial != nullptr && status.ok()) {
      const auto pem = context.auth_context()->FindPropertyValues(
          GRPC_X509_PEM_CERT_PROPERTY_NAME);
      *serial = pem.empty()
                    ? -1
                    : SerialOf(std::string(pem[0].data(), pem[0].size()));
    }
    return status;
  }

  const TemporaryDirectory folder_;
  const TestAuthority authority_{"argmesh test"};
  const TestAuthority stranger_{"somebody else"};
  std::unique_ptr<TestServer> server_;
};

TEST_F(TlsTest, ServesWhoTrustsItsAuthorityAndNobodyInPlainText) {
  Start(Files(authority_.Issue("localhost", 7)));
  long serial = 0;
  const grpc::Status trusting = Ask(Connect(Trusting(authority_)), &serial);
  EXPECT_TRUE(trusting.ok()) << trusting.error_message();
  EXPECT_EQ(serial, 7);
  EXPECT_EQ(Ask(Connect(Trusting(stranger_))).error_code(),
            grpc::StatusCode::UNAVAILABLE);
  EXPECT_EQ(Ask(Connect(grpc::InsecureChannelCredentials())).error_code(),
            grpc::StatusCode::UNAVAILABLE);
}

TEST_F(TlsTest, AsksClientsForACertificateOfItsAuthorities) {
  TlsOptions tls = Files(authority_.Issue("localhost", 7));
  tls.client_authorities = Write("ca.pem", authority_.certificate());
  Start(tls);
  const grpc::Status known =
      Ask(Connect(Trusting(authority_, authority_.Issue("builder", 8))));
  EXPECT_TRUE(known.ok()) << known.error_message();
  EXPECT_EQ(Ask(Connect(Trusting(authority_))).error_code(),
            grpc::StatusCode::UNAVAILABLE);
  EXPECT_EQ(Ask(Connect(Trusting(authority_, stranger_.Issue("builder", 8))))
                .error_code(),
            grpc::StatusCode::UNAVAILABLE);
}

TEST_F(TlsTest, ExchangesItsCertificateWithoutFailingACall) {
  Start(Files(authority_.Issue("localhost", 7)));
  const auto before = Connect(Trusting(authority_));
  ASSERT_TRUE(Ask(before).ok());
  std::atomic<bool> done{false};
  std::atomic<int> failed{0};
  std::atomic<int> answered{0};
  // One connection that stays, and new ones all the time.
  std::thread staying([&] {
    while (!done) ++(Ask(before).ok() ? answered : failed);
  });
  std::thread coming([&] {
    while (!done) {
      ++(Ask(Connect(Trusting(authority_))).ok() ? answered : failed);
    }
  });
  Files(authority_.Issue("localhost", 8));
  const absl::Time end = absl::Now() + absl::Seconds(60);
  long serial = 7;
  while (serial == 7 && absl::Now() < end) {
    if (!Ask(Connect(Trusting(authority_)), &serial).ok()) ++failed;
  }
  done = true;
  staying.join();
  coming.join();
  EXPECT_EQ(serial, 8);
  EXPECT_EQ(failed, 0);
  EXPECT_GT(answered, 0);
}

TEST_F(TlsTest, ChecksItsFilesBeforeItServes) {
  const TestCertificate one = authority_.Issue("localhost", 1);
  const TestCertificate two = authority_.Issue("localhost", 2);
  const std::string certificate = Write("one.pem", one.certificate);
  const std::string key = Write("one.key", one.private_key);
  const std::string other_key = Write("two.key", two.private_key);
  const std::string text = Write("text", "nothing of that kind");
  EXPECT_TRUE(CheckTls({}).ok());
  EXPECT_TRUE(CheckTls({certificate, key, ""}).ok());
  const std::vector<std::pair<TlsOptions, std::string>> cases = {
      {{certificate, "", ""}, "--tls-key"},
      {{"", key, ""}, "--tls-cert"},
      {{"", "", certificate}, "--tls-client-ca"},
      {{"/no/such/file", key, ""}, "/no/such/file"},
      {{text, key, ""}, text},
      {{certificate, text, ""}, text},
      {{certificate, other_key, ""}, other_key},
      {{certificate, key, text}, text}};
  for (const auto& [options, part] : cases) {
    const absl::Status status = CheckTls(options);
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
    EXPECT_THAT(std::string(status.message()), HasSubstr(part));
  }
}

TEST_F(TlsTest, ListensToOtherMachinesOnlyEncryptedAndToKnownCallers) {
  RpcServerOptions options;
  options.listen = "0.0.0.0:0";
  const TlsOptions tls = Files(authority_.Issue("localhost", 1));
  const auto keys = std::make_shared<const KeyRing>();
  EXPECT_FALSE(CheckListenAddress(options).ok());
  options.keys = keys;
  EXPECT_FALSE(CheckListenAddress(options).ok()) << "keys in plain text";
  options.tls = tls;
  EXPECT_TRUE(CheckListenAddress(options).ok());
  options.keys = nullptr;
  EXPECT_FALSE(CheckListenAddress(options).ok()) << "encrypted for everybody";
  options.tls.client_authorities = tls.certificate;
  EXPECT_TRUE(CheckListenAddress(options).ok());
  options.tls = {};
  options.insecure_remote = true;
  EXPECT_TRUE(CheckListenAddress(options).ok());
}

}  // namespace
}  // namespace argmesh
