#include "client/cli/picture_commands.h"

#include <map>

#include "client/picture/image.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr char kPictureDetails[] =
    R"(Meshes and components come from the server; pictures are PNG files.

Examples:
  argmesh picture levels --collection parts valve-7 --out levels.png
  argmesh picture match --collection parts valve-7 valve-9 --out match.png
  argmesh picture results --collection parts --shape valve-7 --out found.png)";

}  // namespace

void AddPictureOptions(CLI::App* command, PictureArguments& arguments) {
  command->add_option("--out,-o", arguments.out, "PNG file to write")
      ->required()
      ->type_name("FILE");
  command->add_option("--width", arguments.width, "Width of a panel in pixels")
      ->type_name("PIXELS")
      ->check(CLI::Range(16, 4096));
  command
      ->add_option(
          "--up", arguments.up,
          "Axis the shapes stand on; by their own shape when not given")
      ->type_name("AXIS")
      ->check(CLI::IsMember({"x", "y", "z", "-x", "-y", "-z"}));
  command->add_option("--title", arguments.title, "Written above the picture")
      ->type_name("TEXT");
}

FigureOptions FigureOptionsOf(const PictureArguments& arguments) {
  static const std::map<std::string, Eigen::Vector3d> kAxes = {
      {"x", {1, 0, 0}},   {"y", {0, 1, 0}},   {"z", {0, 0, 1}},
      {"-x", {-1, 0, 0}}, {"-y", {0, -1, 0}}, {"-z", {0, 0, -1}}};
  FigureOptions options;
  if (arguments.width > 0) {
    options.panel_height = std::max(
        16, arguments.width * options.panel_height / options.panel_width);
    options.panel_width = arguments.width;
  }
  if (!arguments.up.empty()) options.render.view.up = kAxes.at(arguments.up);
  options.title = arguments.title;
  return options;
}

absl::StatusOr<int> WriteFigure(const Session& session, const Figure& figure,
                                const PictureArguments& arguments) {
  ARGMESH_RETURN_IF_ERROR(WritePng(figure.image, arguments.out));
  if (figure.captions_left_out) {
    session.Note("no font was found: the picture has no captions");
  }
  if (session.options.json) {
    session.Print({{"out", arguments.out},
                   {"width", figure.image.width()},
                   {"height", figure.image.height()},
                   {"captions", !figure.captions_left_out}});
  } else {
    session.out << arguments.out << ": " << figure.image.width() << " x "
                << figure.image.height() << " pixels\n";
  }
  return kExitOk;
}

void AddPictureCommands(CLI::App& app, CommandSet& commands) {
  CLI::App* group = commands.AddGroup(
      app, {"picture", "Draw shapes, components, matches and results.",
            kPictureDetails});
  AddPictureLevelsCommand(*group, commands);
  AddPictureModesCommand(*group, commands);
  AddPictureMatchCommand(*group, commands);
  AddPictureResultsCommand(*group, commands);
  AddPictureMatrixCommand(*group, commands);
  AddPicturePlyCommand(*group, commands);
}

}  // namespace argmesh
