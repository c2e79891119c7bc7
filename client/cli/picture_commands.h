// The commands below `argmesh picture`, and what they share.
#ifndef ARGMESH_CLIENT_CLI_PICTURE_COMMANDS_H_
#define ARGMESH_CLIENT_CLI_PICTURE_COMMANDS_H_

#include <CLI/CLI.hpp>
#include <string>

#include "absl/status/statusor.h"
#include "client/cli/command_set.h"
#include "client/cli/session.h"
#include "client/picture/figure.h"

namespace argmesh {

struct PictureArguments {
  std::string out;
  int width = 0;   // of a panel, pixels; 0: the figure's own
  std::string up;  // axis the shapes stand on: x y z -x -y -z
  std::string title;
};

// --out, --width, --up, --title.
void AddPictureOptions(CLI::App* command, PictureArguments& arguments);

// A figure with panels of the width asked for.
FigureOptions FigureOptionsOf(const PictureArguments& arguments);

// Writes the PNG file and says so.
absl::StatusOr<int> WriteFigure(const Session& session, const Figure& figure,
                                const PictureArguments& arguments);

// picture_shape_commands.cc: of one shape.
void AddPictureLevelsCommand(CLI::App& group, CommandSet& commands);
void AddPictureModesCommand(CLI::App& group, CommandSet& commands);
void AddPicturePlyCommand(CLI::App& group, CommandSet& commands);
// picture_match_commands.cc: of several.
void AddPictureMatchCommand(CLI::App& group, CommandSet& commands);
void AddPictureResultsCommand(CLI::App& group, CommandSet& commands);
void AddPictureMatrixCommand(CLI::App& group, CommandSet& commands);

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_CLI_PICTURE_COMMANDS_H_
