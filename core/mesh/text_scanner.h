// Words and numbers of a text file of untrusted origin, one line at a time.
//
// A line ends with LF, CR LF or a lone CR. No copy is made, nothing depends on
// the locale, and every byte is looked at a bounded number of times. Errors
// name the format and the line.
//
// Fails    kInvalidArgument     from Malformed and BadNumber
//          kResourceExhausted   a line over the limit: every later word is
//                               empty and status() says why
#ifndef ARGMESH_CORE_MESH_TEXT_SCANNER_H_
#define ARGMESH_CORE_MESH_TEXT_SCANNER_H_

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "absl/status/status.h"

namespace argmesh {

struct TextScannerOptions {
  std::string_view format_name = "text";  // for messages: "OFF"
  bool hash_comments = true;              // '#' begins a comment
  bool continuations = false;        // '\' at a line's end joins the next one
  int64_t max_line_bytes = 1 << 20;  // joined lines together
  int64_t first_line = 1;            // number of the first line
};

class TextScanner {
 public:
  // `bytes` must outlive the scanner.
  TextScanner(std::string_view bytes, const TextScannerOptions& options);

  // The next word of this line; empty at its end.
  std::string_view NextOnLine();
  // The next word of this or a later line; empty at the end of the bytes.
  std::string_view Next();
  // Skips the rest of this line; false when there is no further line.
  bool NextLine();
  // No further word on this line.
  bool AtLineEnd();
  // No further word at all.
  bool AtEnd();

  int64_t line() const { return line_; }
  size_t position() const { return position_; }
  size_t remaining() const { return bytes_.size() - position_; }
  const absl::Status& status() const { return status_; }

  // "OFF line 3: <message>"; status() when that is not OK.
  absl::Status Malformed(std::string_view message) const;
  absl::Status OverLimit(std::string_view message) const;
  // The same status with "OFF line 3: " before its message.
  absl::Status Located(const absl::Status& status) const;
  // Why `word` is no number: missing, not one, or out of range.
  absl::Status BadNumber(std::string_view subject, std::string_view word) const;

 private:
  void SkipBlanks();
  size_t LineEndLength(size_t at) const;
  bool CheckLineLength();

  std::string_view bytes_;
  TextScannerOptions options_;
  size_t position_ = 0;
  size_t line_start_ = 0;
  int64_t line_;
  absl::Status status_;
};

// Finite and within the range of float, with an optional sign ('+' as well);
// what is too small to be a double is 0.
std::optional<double> ParseCoordinate(std::string_view word);

std::optional<int64_t> ParseInteger(std::string_view word);

// True for a coordinate that the formats may carry.
bool IsCoordinate(double value);

// The first bytes of `word` in quotes, unprintable ones escaped.
std::string QuoteWord(std::string_view word);

// `word` with A-Z turned into a-z.
std::string LowerCase(std::string_view word);

}  // namespace argmesh

#endif  // ARGMESH_CORE_MESH_TEXT_SCANNER_H_
