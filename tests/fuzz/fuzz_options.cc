// What an operator writes: the server's configuration and the key file. An
// error that says what is wrong, or options that are the same when they are
// written and read again.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/access/key_file.h"
#include "server/options.h"
#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/require.h"

namespace argmesh {
namespace {

std::optional<std::string> NoVariable(const std::string&) {
  return std::nullopt;
}

absl::StatusOr<ParsedOptions> ParseFile(std::string_view content) {
  static const MemoryFile file;
  file.Store(content);
  return ParseServerOptions({"--config", file.path()}, NoVariable, "fuzz");
}

void FuzzConfiguration(std::string_view content) {
  const auto parsed = ParseFile(content);
  if (!parsed.ok()) {
    Require(parsed.status().code() == absl::StatusCode::kInvalidArgument &&
                !parsed.status().message().empty(),
            "an error of the configuration");
    return;
  }
  if (parsed->answer) return;
  const std::string written = FormatServerOptions(parsed->options);
  const auto again = ParseFile(written);
  Require(again.ok() && FormatServerOptions(again->options) == written,
          "the configuration comes back");
}

void FuzzKeys(std::string_view content) {
  const auto keys = ParseKeys(content);
  if (!keys.ok()) {
    Require(keys.status().code() == absl::StatusCode::kInvalidArgument &&
                !keys.status().message().empty(),
            "an error of the key file");
    return;
  }
  const std::string written = FormatKeys(*keys);
  const auto again = ParseKeys(written);
  Require(again.ok() && FormatKeys(*again) == written, "the keys come back");
}

}  // namespace
}  // namespace argmesh

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view content(reinterpret_cast<const char*>(data), size);
  argmesh::FuzzConfiguration(content);
  argmesh::FuzzKeys(content);
  return 0;
}
