#include "client/picture/figure_matrix.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"
#include "client/picture/palette.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr int kMaxNames = 500;
constexpr int kPad = 8;

absl::Status Check(const Eigen::MatrixXd& values, size_t rows, size_t columns,
                   const MatrixFigureOptions& options) {
  if (values.size() == 0) {
    return absl::InvalidArgumentError("the matrix is empty");
  }
  if (values.rows() != static_cast<Eigen::Index>(rows) ||
      values.cols() != static_cast<Eigen::Index>(columns)) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "%d row names and %d column names for a matrix of %d x %d", rows,
        columns, values.rows(), values.cols()));
  }
  if (std::max(rows, columns) > kMaxNames) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "matrix of %d x %d is over the limit of %d", rows, columns, kMaxNames));
  }
  if (options.cell_pixels < 4 || options.cell_pixels > 500) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "cell_pixels %d is outside 4 .. 500", options.cell_pixels));
  }
  if (options.caption_pixels < 4 || options.caption_pixels > 500) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "caption_pixels %d is outside 4 .. 500", options.caption_pixels));
  }
  return absl::OkStatus();
}

class MatrixPainter {
 public:
  MatrixPainter(const Eigen::MatrixXd& values,
                const MatrixFigureOptions& options)
      : values_(values),
        options_(options),
        font_(options.font == nullptr ? CaptionFont::Default() : *options.font),
        low_(options.low),
        high_(options.high) {
    if (low_ < high_) return;
    low_ = std::numeric_limits<double>::infinity();
    high_ = -low_;
    for (const double value : values.reshaped()) {
      if (!std::isfinite(value)) continue;
      low_ = std::min(low_, value);
      high_ = std::max(high_, value);
    }
  }

  Figure Paint(const std::vector<std::string>& row_names,
               const std::vector<std::string>& column_names) {
    left_ = LongestName(row_names) + 2 * kPad;
    const int title = options_.title.empty() ? 0 : Line();
    top_ = title + LongestName(column_names) + 2 * kPad;
    const int cell = options_.cell_pixels;
    const auto columns = static_cast<int>(values_.cols());
    const auto rows = static_cast<int>(values_.rows());
    Figure figure{.image = Image(left_ + columns * cell + kPad,
                                 top_ + rows * cell + kPad)};
    Image& image = figure.image;
    Write(image, {0, 0, image.width(), Line()}, options_.title,
          CaptionAlign::kCenter, false);
    for (int c = 0; c < columns; ++c) {
      Write(image,
            {left_ + c * cell, title + kPad, cell, top_ - title - 2 * kPad},
            column_names[static_cast<size_t>(c)], CaptionAlign::kLeft, true);
    }
    for (int r = 0; r < rows; ++r) {
      Write(image, {kPad, top_ + r * cell, left_ - 2 * kPad, cell},
            row_names[static_cast<size_t>(r)], CaptionAlign::kRight, false);
      for (int c = 0; c < columns; ++c) PaintCell(image, r, c);
    }
    figure.captions_left_out = !drawn_;
    return figure;
  }

 private:
  int Line() const { return 2 * options_.caption_pixels; }

  int LongestName(const std::vector<std::string>& names) const {
    int longest = 0;
    for (const std::string& name : names) {
      longest = std::max(longest,
                         font_.Rasterize(name, options_.caption_pixels).width);
    }
    return std::min(longest, 20 * options_.caption_pixels);
  }

  void Write(Image& image, const PixelBox& box, const std::string& text,
             CaptionAlign align, bool upward) {
    drawn_ = font_.Draw(image, box, text,
                        {.pixels = options_.caption_pixels,
                         .align = align,
                         .upward = upward}) &&
             drawn_;
  }

  void PaintCell(Image& image, int r, int c) {
    const int cell = options_.cell_pixels;
    const PixelBox box{left_ + c * cell, top_ + r * cell, cell, cell};
    const double value = values_(r, c);
    RgbColor color = kPaleGrey;
    if (std::isfinite(value)) {
      color = ScaleColor(high_ > low_ ? (value - low_) / (high_ - low_) : 0.5);
    }
    const int line = cell >= 12 ? 1 : 0;
    image.FillRectangle(box.x, box.y, cell - line, cell - line, color);
    if (!options_.values || cell < 20 || !std::isfinite(value)) return;
    const CaptionStyle style{
        .pixels = std::min(options_.caption_pixels - 1, cell * 3 / 8),
        .color = LabOfRgb(color)[0] < 60 ? kWhite : kInk,
        .align = CaptionAlign::kCenter};
    drawn_ =
        font_.Draw(image, box, absl::StrFormat("%.2f", value), style) && drawn_;
  }

  const Eigen::MatrixXd& values_;
  const MatrixFigureOptions& options_;
  const CaptionFont& font_;
  double low_;
  double high_;
  int left_ = 0;
  int top_ = 0;
  bool drawn_ = true;
};

}  // namespace

absl::StatusOr<Figure> RenderMatrix(
    const Eigen::MatrixXd& values, const std::vector<std::string>& row_names,
    const std::vector<std::string>& column_names,
    const MatrixFigureOptions& options) {
  ARGMESH_RETURN_IF_ERROR(
      Check(values, row_names.size(), column_names.size(), options));
  return MatrixPainter(values, options).Paint(row_names, column_names);
}

}  // namespace argmesh
