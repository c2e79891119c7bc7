// Clients in another language, made from nothing but the .proto files and
// what server reflection tells.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "tests/e2e/installation.h"

namespace argmesh {
namespace {

namespace fs = std::filesystem;
using testing::EndsWith;
using testing::HasSubstr;

const fs::path kSources = ARGMESH_SOURCE_FOLDER;

// The .proto files, relative to their folder.
std::vector<std::string> ProtoFiles() {
  std::vector<std::string> files;
  const fs::path root = kSources / "proto";
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (entry.path().extension() == ".proto") {
      files.push_back(entry.path().lexically_relative(root).string());
    }
  }
  return files;
}

// "PACKAGE.SERVICE/METHOD" of every rpc in argmesh/v1.
std::vector<std::string> MethodsOfTheApi() {
  static const std::regex kLine(R"(^(service|  rpc) (\w+).*)");
  std::vector<std::string> methods;
  for (const std::string& file : ProtoFiles()) {
    if (!file.starts_with("argmesh/v1/")) continue;
    std::ifstream lines(kSources / "proto" / file);
    std::string service;
    std::smatch match;
    for (std::string line; std::getline(lines, line);) {
      if (!std::regex_match(line, match, kLine)) continue;
      if (match[1] == "service") {
        service = match[2];
      } else {
        methods.push_back("argmesh.v1." + service + "/" + match[2].str());
      }
    }
  }
  return methods;
}

class PythonTest : public testing::Test {
 protected:
  void SetUp() override {
    // The packages belong to Debian's Python, which need not be the first one
    // in PATH.
    if (Run({"/usr/bin/python3", "-c", "import grpc, google.protobuf"})
            .exit_code != 0) {
      GTEST_SKIP() << "python3-grpcio is not installed";
    }
    const CommandOutcome sample = installation_.Run(
        {"sample", "--out", Path("meshes"), "--shapes-per-class", "1",
         "--classes", "mug", "--vertices", "1500"});
    ASSERT_EQ(sample.exit_code, 0) << sample.err;
    ASSERT_TRUE(installation_.StartServer());
  }

  std::string Path(const std::string& relative) const {
    return (installation_.folder() / relative).string();
  }

  CommandOutcome Run(const std::vector<std::string>& words) {
    std::vector<std::string> line = {"/usr/bin/env",
                                     "PYTHONPATH=" + Path("api")};
    line.insert(line.end(), words.begin(), words.end());
    ChildProcess process(line, installation_.folder(), "python");
    const int exit_code = process.Wait();
    return {exit_code, process.Out(), process.Err()};
  }

  CommandOutcome RunScript(const std::string& name,
                           const std::vector<std::string>& words) {
    std::vector<std::string> line = {"/usr/bin/python3", "-B",
                                     (kSources / "tests/e2e" / name).string(),
                                     installation_.address()};
    line.insert(line.end(), words.begin(), words.end());
    return Run(line);
  }

  const std::string mesh_ = "meshes/mug/mug-01.off";
  Installation installation_;
};

TEST_F(PythonTest, GeneratedCodeStoresAndFinds) {
  fs::create_directories(Path("api"));
  std::vector<std::string> protoc = {
      PROTOC_BINARY, "-I" + (kSources / "proto").string(),
      "--python_out=" + Path("api"), "--grpc_python_out=" + Path("api"),
      std::string("--plugin=protoc-gen-grpc_python=") + PYTHON_PLUGIN};
  for (const std::string& file : ProtoFiles()) protoc.push_back(file);
  const CommandOutcome generated = Run(protoc);
  ASSERT_EQ(generated.exit_code, 0) << generated.err;

  const CommandOutcome client = RunScript("python_client.py", {Path(mesh_)});
  EXPECT_EQ(client.exit_code, 0) << client.err;
  EXPECT_EQ(client.out, "collections/cups/shapes/first 1.000\n");
}

TEST_F(PythonTest, ReflectionTellsAllItTakes) {
  const CommandOutcome ingest = installation_.Run(
      {"ingest", "--collection", "cups", "--json", Path("meshes")});
  ASSERT_EQ(ingest.exit_code, 0) << ingest.err;

  const CommandOutcome client =
      RunScript("python_reflection.py", {"cups", Path(mesh_)});
  EXPECT_EQ(client.exit_code, 0) << client.err;
  const std::vector<std::string> methods = MethodsOfTheApi();
  EXPECT_GT(methods.size(), 20U);
  for (const std::string& method : methods) {
    EXPECT_THAT(client.out, HasSubstr("\nmethod " + method + "\n"));
  }
  EXPECT_THAT(client.out, HasSubstr("service google.longrunning.Operations\n"));
  EXPECT_THAT(client.out, HasSubstr("service grpc.health.v1.Health\n"));
  EXPECT_THAT(client.out, EndsWith(" 1.000\n"));
}

}  // namespace
}  // namespace argmesh
