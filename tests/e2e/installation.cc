#include "tests/e2e/installation.h"

#include <signal.h>

#include <chrono>
#include <fstream>
#include <iostream>
#include <iterator>
#include <thread>

namespace argmesh {
namespace {

namespace fs = std::filesystem;

constexpr auto kStartTimeout = std::chrono::seconds(60);

int CountOf(const std::string& text, const std::string& in) {
  int count = 0;
  for (size_t at = in.find(text); at != std::string::npos;
       at = in.find(text, at + text.size())) {
    ++count;
  }
  return count;
}

}  // namespace

nlohmann::ordered_json CommandOutcome::Json() const {
  return nlohmann::ordered_json::parse(out, nullptr, false);
}

void Installation::LaunchServer(const std::vector<std::string>& more) {
  server_.reset();
  const fs::path port_file = folder() / "address";
  fs::remove(port_file);
  std::vector<std::string> words = {ARGMESHD_BINARY,
                                    "--data",
                                    (folder() / "store").string(),
                                    "--listen",
                                    address_.empty() ? "127.0.0.1:0" : address_,
                                    "--port-file",
                                    port_file.string()};
  words.insert(words.end(), more.begin(), more.end());
  server_.emplace(words, folder(), "server");
}

bool Installation::StartServer(const std::vector<std::string>& more) {
  LaunchServer(more);
  const auto end = std::chrono::steady_clock::now() + kStartTimeout;
  while (std::chrono::steady_clock::now() < end && server_->Running()) {
    std::string text = ReadFile("address");
    if (text.ends_with('\n')) text.pop_back();
    if (!text.empty()) {
      address_ = text;
      return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  std::cerr << server_->Err();
  return false;
}

bool Installation::WaitForLog(const std::string& text, int times) {
  const auto end = std::chrono::steady_clock::now() + kStartTimeout;
  while (std::chrono::steady_clock::now() < end && ServerRuns()) {
    if (CountOf(text, ServerLog()) >= times) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

void Installation::SignalServer(int signal) { server_->Signal(signal); }
bool Installation::ServerRuns() { return server_ && server_->Running(); }
std::string Installation::ServerLog() const {
  return server_ ? server_->Err() : "";
}
int Installation::WaitForServer() { return server_->Wait(); }

ChildProcess Installation::Start(const std::vector<std::string>& words) {
  std::vector<std::string> line = {ARGMESH_BINARY};
  if (!address_.empty()) line.insert(line.end(), {"--server", address_});
  line.insert(line.end(), words.begin(), words.end());
  return {line, folder(), "command-" + std::to_string(++commands_)};
}

CommandOutcome Installation::Run(const std::vector<std::string>& words) {
  ChildProcess command = Start(words);
  const int exit_code = command.Wait();
  return {exit_code, command.Out(), command.Err()};
}

CommandOutcome Installation::RunServerProgram(
    const std::vector<std::string>& words) {
  std::vector<std::string> line = {ARGMESHD_BINARY};
  line.insert(line.end(), words.begin(), words.end());
  ChildProcess command(line, folder(),
                       "command-" + std::to_string(++commands_));
  const int exit_code = command.Wait();
  return {exit_code, command.Out(), command.Err()};
}

void Installation::WriteFile(const std::string& relative,
                             const std::string& bytes) const {
  const fs::path path = folder() / relative;
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << bytes;
}

std::string Installation::ReadFile(const std::string& relative) const {
  return ReadAll(folder() / relative);
}

}  // namespace argmesh
