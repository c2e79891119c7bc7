// One line on the terminal that shows how far a long command is: a bar, the
// count, the rate and the time left. Nothing at all when the stream is no
// terminal, so that logs stay readable.
#ifndef ARGMESH_CLIENT_CLI_PROGRESS_LINE_H_
#define ARGMESH_CLIENT_CLI_PROGRESS_LINE_H_

#include <cstddef>
#include <ostream>
#include <string>
#include <string_view>

#include "absl/time/time.h"

namespace argmesh {

// "ingest [=====>    ] 12/25  3.1/s  eta 4s". No time left is shown before the
// first item is done.
std::string FormatProgress(std::string_view label, size_t done, size_t total,
                           absl::Duration elapsed);

// Belongs to one thread at a time.
class ProgressLine {
 public:
  ProgressLine(std::ostream& out, bool is_terminal, std::string_view label,
               size_t total);
  ~ProgressLine();  // removes the line

  // Redraws at most ten times a second.
  void Advance(size_t done);
  // There is more, or less, to do than was known.
  void SetTotal(size_t total) { total_ = total; }
  // Prints a line above the progress line.
  void Print(std::string_view line);
  // Removes the line.
  void Clear();

 private:
  void Draw();

  std::ostream& out_;
  const bool is_terminal_;
  const std::string label_;
  size_t total_;
  const absl::Time start_;
  absl::Time drawn_ = absl::InfinitePast();
  size_t done_ = 0;
  size_t width_ = 0;  // of the line on the screen
};

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_CLI_PROGRESS_LINE_H_
