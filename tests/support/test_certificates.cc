#include "tests/support/test_certificates.h"

#include <openssl/bio.h>
#include <openssl/ec.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>

#include <functional>

namespace argmesh {
namespace {

template <typename T>
using Handle = std::unique_ptr<T, void (*)(T*)>;

constexpr long kHour = 3600;
constexpr long kVersion3 = 2;

Handle<EVP_PKEY> MakeKey() { return {EVP_EC_gen("P-256"), EVP_PKEY_free}; }

std::string Written(const std::function<int(BIO*)>& write) {
  const Handle<BIO> out(BIO_new(BIO_s_mem()), [](BIO* bio) { BIO_free(bio); });
  if (write(out.get()) != 1) std::abort();
  char* data = nullptr;
  const long size = BIO_get_mem_data(out.get(), &data);
  return std::string(data, static_cast<size_t>(size));
}

std::string PemOf(X509* certificate) {
  return Written(
      [&](BIO* out) { return PEM_write_bio_X509(out, certificate); });
}

std::string PemOf(EVP_PKEY* key) {
  return Written([&](BIO* out) {
    return PEM_write_bio_PrivateKey(out, key, nullptr, nullptr, 0, nullptr,
                                    nullptr);
  });
}

void AddExtension(X509* certificate, int kind, const std::string& value) {
  const Handle<X509_EXTENSION> extension(
      X509V3_EXT_conf_nid(nullptr, nullptr, kind, value.c_str()),
      X509_EXTENSION_free);
  X509_add_ext(certificate, extension.get(), -1);
}

Handle<X509> MakeCertificate(const std::string& name, long serial,
                             EVP_PKEY* key) {
  Handle<X509> certificate(X509_new(), X509_free);
  X509_set_version(certificate.get(), kVersion3);
  ASN1_INTEGER_set(X509_get_serialNumber(certificate.get()), serial);
  X509_gmtime_adj(X509_getm_notBefore(certificate.get()), -kHour);
  X509_gmtime_adj(X509_getm_notAfter(certificate.get()), kHour);
  X509_set_pubkey(certificate.get(), key);
  X509_NAME_add_entry_by_txt(
      X509_get_subject_name(certificate.get()), "CN", MBSTRING_ASC,
      reinterpret_cast<const unsigned char*>(name.c_str()), -1, -1, 0);
  return certificate;
}

}  // namespace

struct TestAuthority::Parts {
  Handle<EVP_PKEY> key{nullptr, EVP_PKEY_free};
  Handle<X509> certificate{nullptr, X509_free};
};

TestAuthority::TestAuthority(const std::string& name)
    : parts_(std::make_unique<Parts>()) {
  parts_->key = MakeKey();
  parts_->certificate = MakeCertificate(name, 1, parts_->key.get());
  X509* certificate = parts_->certificate.get();
  X509_set_issuer_name(certificate, X509_get_subject_name(certificate));
  AddExtension(certificate, NID_basic_constraints, "critical,CA:TRUE");
  AddExtension(certificate, NID_key_usage, "critical,keyCertSign,cRLSign");
  X509_sign(certificate, parts_->key.get(), EVP_sha256());
}

TestAuthority::~TestAuthority() = default;

std::string TestAuthority::certificate() const {
  return PemOf(parts_->certificate.get());
}

TestCertificate TestAuthority::Issue(const std::string& name,
                                     long serial) const {
  const Handle<EVP_PKEY> key = MakeKey();
  const Handle<X509> certificate = MakeCertificate(name, serial, key.get());
  X509_set_issuer_name(certificate.get(),
                       X509_get_subject_name(parts_->certificate.get()));
  AddExtension(certificate.get(), NID_subject_alt_name,
               "DNS:" + name + ",IP:127.0.0.1");
  X509_sign(certificate.get(), parts_->key.get(), EVP_sha256());
  return {PemOf(certificate.get()), PemOf(key.get())};
}

}  // namespace argmesh
