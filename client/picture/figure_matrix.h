// A matrix as a heat map with named rows and columns: darker is higher.
#ifndef ARGMESH_CLIENT_PICTURE_FIGURE_MATRIX_H_
#define ARGMESH_CLIENT_PICTURE_FIGURE_MATRIX_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "client/picture/figure.h"

namespace argmesh {

struct MatrixFigureOptions {
  int cell_pixels = 46;     // side of a cell, 4 .. 500
  int caption_pixels = 14;  // height of the font, 4 .. 500
  bool values = true;       // written into the cells, two digits
  // Values drawn white and darkest; equal for the matrix's own range.
  double low = 0;
  double high = 0;
  std::string title = {};             // above everything; may be empty
  const CaptionFont* font = nullptr;  // CaptionFont::Default() for null
};

// Entries that are not finite are drawn pale grey.
// Fails    kInvalidArgument  an empty matrix, names that do not match it, more
//                            than 500 rows or columns, an option outside its
//                            range
// Cost     O(pixels).
absl::StatusOr<Figure> RenderMatrix(
    const Eigen::MatrixXd& values, const std::vector<std::string>& row_names,
    const std::vector<std::string>& column_names,
    const MatrixFigureOptions& options = {});

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_PICTURE_FIGURE_MATRIX_H_
