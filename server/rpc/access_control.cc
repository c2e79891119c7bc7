#include "server/rpc/access_control.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/time/clock.h"
#include "server/engine/error_reason.h"
#include "server/rpc/request_names.h"

namespace argmesh {
namespace {

constexpr char kAuthorization[] = "authorization";
constexpr std::string_view kBearer = "Bearer ";

absl::Status KeyInvalid() {
  return MakeError(ErrorReason::kKeyInvalid,
                   "the key is malformed, unknown or revoked");
}

absl::Status Denied(const Caller& caller, std::string_view method,
                    const std::string& why) {
  return MakeError(
      ErrorReason::kPermissionDenied,
      absl::StrFormat("%s: %s", std::string(method), why),
      {{"method", std::string(method)}, {"principal", caller.principal}});
}

std::string CertificateName(const grpc::ServerContextBase& context) {
  const auto auth = context.auth_context();
  if (auth == nullptr || !auth->IsPeerAuthenticated()) return "";
  const auto identity = auth->GetPeerIdentity();
  if (identity.empty()) return "";
  return absl::StrCat(
      "cert:", std::string(identity.front().data(), identity.front().size()));
}

}  // namespace

bool Caller::Covers(std::string_view collection) const {
  return collections.empty() ||
         std::find(collections.begin(), collections.end(), collection) !=
             collections.end();
}

void AccessControl::SetKeys(std::shared_ptr<const KeyRing> keys) {
  if (keys != nullptr) quotas_.KeepOnly(*keys);
  const std::lock_guard lock(mutex_);
  keys_ = std::move(keys);
}

std::shared_ptr<const KeyRing> AccessControl::keys() const {
  const std::lock_guard lock(mutex_);
  return keys_;
}

bool AccessControl::has_keys() const { return keys() != nullptr; }

absl::StatusOr<Caller> AccessControl::Authenticate(
    const grpc::ServerContextBase& context) const {
  const std::shared_ptr<const KeyRing> ring = keys();
  if (ring == nullptr) {
    Caller everybody;
    everybody.principal = CertificateName(context);
    return everybody;
  }
  const auto& metadata = context.client_metadata();
  const auto header = metadata.find(kAuthorization);
  if (header == metadata.end()) {
    return MakeError(ErrorReason::kKeyMissing,
                     "the call carries no key: send authorization: Bearer KEY");
  }
  return CallerOfBearer(
      *ring, std::string_view(header->second.data(), header->second.size()),
      absl::Now());
}

absl::StatusOr<Caller> CallerOfBearer(const KeyRing& keys,
                                      std::string_view header, absl::Time now) {
  if (!header.starts_with(kBearer)) return KeyInvalid();
  const absl::StatusOr<PresentedKey> presented =
      ParseKeyText(header.substr(kBearer.size()));
  if (!presented.ok()) return KeyInvalid();
  const auto found = keys.find(presented->id);
  // An unknown id takes as long as a wrong secret.
  const Sha256Digest& stored = found == keys.end()
                                   ? presented->secret_sha256
                                   : found->second.secret_sha256;
  const bool same = SameSecret(stored, presented->secret_sha256);
  if (found == keys.end() || !same) return KeyInvalid();
  const ApiKey& key = found->second;
  if (key.expire_time <= now) {
    return MakeError(ErrorReason::kKeyExpired,
                     absl::StrFormat("key %s expired at %s", key.id,
                                     absl::FormatTime(key.expire_time,
                                                      absl::UTCTimeZone())));
  }
  return Caller{.principal = key.id,
                .role = key.role,
                .collections = key.collections,
                .limits = key.limits};
}

absl::Status CheckRole(const Caller& caller, std::string_view method) {
  const AccessRule* rule = FindAccessRule(method);
  if (rule == nullptr) return Denied(caller, method, "no rule allows it");
  if (caller.role < rule->role) {
    return Denied(caller, method,
                  absl::StrFormat("needs the role %s, the key has %s",
                                  std::string(AccessRoleName(rule->role)),
                                  std::string(AccessRoleName(caller.role))));
  }
  if (rule->scope == AccessScope::kServer && !caller.collections.empty()) {
    return Denied(caller, method,
                  "needs a key that is not bound to collections");
  }
  return absl::OkStatus();
}

absl::Status CheckNames(const Caller& caller, std::string_view method,
                        const std::vector<std::string>& names) {
  const AccessRule* rule = FindAccessRule(method);
  if (rule == nullptr) return Denied(caller, method, "no rule allows it");
  if (rule->scope != AccessScope::kCollection || caller.collections.empty()) {
    return absl::OkStatus();
  }
  if (names.empty()) {
    return Denied(caller, method, "the request names no collection");
  }
  for (const std::string& name : names) {
    if (!caller.Covers(CollectionOfName(name))) {
      return Denied(caller, method,
                    absl::StrFormat("the key is not for %s", name));
    }
  }
  return absl::OkStatus();
}

}  // namespace argmesh
