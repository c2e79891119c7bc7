#include "core/access/key_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <string>

#include "tests/support/temporary_directory.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

ApiKey Key(const std::string& id, AccessRole role) {
  ApiKey key;
  key.id = id;
  key.secret_sha256 = HashKeySecret("secret of " + id);
  key.role = role;
  key.create_time = absl::FromUnixSeconds(1'700'000'000);
  return key;
}

KeyRing TwoKeys() {
  ApiKey bound = Key("ci", AccessRole::kWrite);
  bound.collections = {"parts", "tools"};
  bound.expire_time = absl::FromUnixSeconds(1'800'000'000);
  bound.limits = {
      .requests_per_second = 0.5, .burst = 3, .concurrent_calls = 4};
  return {{"ci", bound}, {"ops", Key("ops", AccessRole::kAdmin)}};
}

void ExpectEqual(const KeyRing& a, const KeyRing& b) {
  ASSERT_EQ(a.size(), b.size());
  for (const auto& [id, key] : a) {
    ASSERT_TRUE(b.contains(id));
    const ApiKey& other = b.find(id)->second;
    EXPECT_EQ(key.secret_sha256, other.secret_sha256);
    EXPECT_EQ(key.role, other.role);
    EXPECT_EQ(key.collections, other.collections);
    EXPECT_EQ(key.limits, other.limits);
    EXPECT_EQ(key.create_time, other.create_time);
    EXPECT_EQ(key.expire_time, other.expire_time);
  }
}

TEST(ParseKeys, ReadsBackWhatFormatKeysWrites) {
  const auto parsed = ParseKeys(FormatKeys(TwoKeys()));
  ASSERT_TRUE(parsed.ok()) << parsed.status();
  ExpectEqual(*parsed, TwoKeys());
  EXPECT_TRUE(ParseKeys(FormatKeys({})).value().empty());
}

TEST(ParseKeys, NamesWhatIsWrong) {
  const std::string digest(64, 'a');
  const std::string time = "\"create_time\":\"2026-01-31T00:00:00+00:00\"";
  const auto one = [&](const std::string& fields) {
    return "{\"keys\":[{" + fields + "}]}";
  };
  const std::string good =
      "\"id\":\"ci\",\"sha256\":\"" + digest + "\",\"role\":\"read\"," + time;
  ASSERT_TRUE(ParseKeys(one(good)).ok());
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "JSON"},
      {"[]", "object"},
      {"{}", "keys"},
      {"{\"keys\":{}}", "keys"},
      {"{\"keys\":[],\"more\":1}", "more"},
      {"{\"keys\":[1]}", "key 1"},
      {one(""), "id"},
      {one(good + ",\"expires\":\"never\""), "expires"},
      {one(good + ",\"expire_time\":\"tomorrow\""), "tomorrow"},
      {one(good + ",\"expire_time\":7"), "expire_time"},
      {one(good + ",\"collections\":[]"), "collections"},
      {one(good + ",\"requests_per_second\":\"many\""), "requests_per_second"},
      {one(good + ",\"requests_per_second\":-1,\"burst\":1"),
       "requests_per_second"},
      {one(good + ",\"requests_per_second\":2"), "burst"},
      {one(good + ",\"requests_per_second\":2,\"burst\":1.5"), "burst"},
      {one(good + ",\"burst\":9999999"), "burst"},
      {one(good + ",\"concurrent_calls\":-1"), "concurrent_calls"},
      {one(good + ",\"collections\":[\"Parts\"]"), "Parts"},
      {one(good + ",\"collections\":\"parts\""), "collections"},
      {one("\"id\":\"ci\",\"sha256\":\"" + digest + "\",\"role\":\"root\"," +
           time),
       "root"},
      {one("\"id\":\"ci\",\"sha256\":\"" + digest.substr(1) +
           "\",\"role\":\"read\"," + time),
       "sha256"},
      {one("\"id\":\"../x\",\"sha256\":\"" + digest + "\",\"role\":\"read\"," +
           time),
       "../x"},
      {"{\"keys\":[{" + good + "},{" + good + "}]}", "two"}};
  for (const auto& [text, part] : cases) {
    const auto parsed = ParseKeys(text);
    ASSERT_EQ(parsed.status().code(), absl::StatusCode::kInvalidArgument)
        << text;
    EXPECT_THAT(std::string(parsed.status().message()), HasSubstr(part))
        << text;
  }
}

TEST(KeyFile, IsWrittenForItsOwnerAndReadBack) {
  const TemporaryDirectory folder;
  const std::string path = folder.path() / "keys.json";
  EXPECT_EQ(ReadKeyFile(path).status().code(), absl::StatusCode::kNotFound);
  ASSERT_TRUE(WriteKeyFile(path, TwoKeys()).ok());
  struct stat status {};
  ASSERT_EQ(stat(path.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600U);
  const auto read = ReadKeyFile(path);
  ASSERT_TRUE(read.ok()) << read.status();
  ExpectEqual(*read, TwoKeys());
}

TEST(KeyFile, KeepsThePermissionsItHad) {
  const TemporaryDirectory folder;
  const std::string path = folder.path() / "keys.json";
  ASSERT_TRUE(WriteKeyFile(path, {}).ok());
  ASSERT_EQ(chmod(path.c_str(), 0640), 0);
  ASSERT_TRUE(WriteKeyFile(path, TwoKeys()).ok());
  struct stat status {};
  ASSERT_EQ(stat(path.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0640U);
}

TEST(KeyFile, IsRefusedWhenOthersMayWriteToIt) {
  const TemporaryDirectory folder;
  const std::string path = folder.path() / "keys.json";
  ASSERT_TRUE(WriteKeyFile(path, TwoKeys()).ok());
  for (const mode_t mode : {0620U, 0602U}) {
    ASSERT_EQ(chmod(path.c_str(), mode), 0);
    EXPECT_EQ(ReadKeyFile(path).status().code(),
              absl::StatusCode::kFailedPrecondition);
  }
}

TEST(KeyFile, HoldsNoSecret) {
  ApiKey key = Key("ci", AccessRole::kRead);
  const std::string secret = MakeKeySecret();
  key.secret_sha256 = HashKeySecret(secret);
  EXPECT_THAT(FormatKeys({{"ci", key}}), Not(HasSubstr(secret)));
}

}  // namespace
}  // namespace argmesh
