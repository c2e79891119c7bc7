// A temporary directory that files are put into, with the folders they need.
#ifndef ARGMESH_TESTS_UNIT_CLIENT_CLI_SCRATCH_FOLDER_H_
#define ARGMESH_TESTS_UNIT_CLIENT_CLI_SCRATCH_FOLDER_H_

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/temporary_directory.h"

namespace argmesh {

class ScratchFolder : public TemporaryDirectory {
 public:
  std::string Add(const std::string& relative, const std::string& bytes) const {
    const std::filesystem::path file = path() / relative;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << bytes;
    return file.string();
  }
};

}  // namespace argmesh

#endif  // ARGMESH_TESTS_UNIT_CLIENT_CLI_SCRATCH_FOLDER_H_
