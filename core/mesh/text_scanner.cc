#include "core/mesh/text_scanner.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

#include "absl/strings/ascii.h"
#include "absl/strings/escaping.h"
#include "absl/strings/str_format.h"

namespace argmesh {
namespace {

bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
bool IsLineEnd(char c) { return c == '\n' || c == '\r'; }

std::string_view WithoutPlus(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') {
    word.remove_prefix(1);
  }
  return word;
}

// from_chars reports both ends of the range alike. Words this short with a
// negative exponent can only be too small.
bool IsUnderflow(std::string_view word) {
  constexpr size_t kMaxWord = 64;
  const size_t exponent = word.find_first_of("eE");
  return word.size() <= kMaxWord && exponent != std::string_view::npos &&
         exponent + 1 < word.size() && word[exponent + 1] == '-';
}

}  // namespace

TextScanner::TextScanner(std::string_view bytes,
                         const TextScannerOptions& options)
    : bytes_(bytes), options_(options), line_(options.first_line) {}

size_t TextScanner::LineEndLength(size_t at) const {
  if (at >= bytes_.size() || !IsLineEnd(bytes_[at])) return 0;
  const bool pair =
      bytes_[at] == '\r' && at + 1 < bytes_.size() && bytes_[at + 1] == '\n';
  return pair ? 2 : 1;
}

bool TextScanner::CheckLineLength() {
  const size_t length = position_ - line_start_;
  if (length <= static_cast<size_t>(options_.max_line_bytes)) return true;
  status_ = OverLimit(absl::StrFormat("the line has more than %d bytes",
                                      options_.max_line_bytes));
  position_ = bytes_.size();
  return false;
}

void TextScanner::SkipBlanks() {
  while (position_ < bytes_.size()) {
    if (IsBlank(bytes_[position_])) {
      ++position_;
      continue;
    }
    if (!options_.continuations || bytes_[position_] != '\\') return;
    const size_t line_end = LineEndLength(position_ + 1);
    if (line_end == 0) return;
    position_ += 1 + line_end;
    ++line_;
  }
}

std::string_view TextScanner::NextOnLine() {
  SkipBlanks();
  const size_t begin = position_;
  while (position_ < bytes_.size()) {
    const char c = bytes_[position_];
    if (IsBlank(c) || IsLineEnd(c)) break;
    if (c == '#' && options_.hash_comments) break;
    if (c == '\\' && options_.continuations &&
        LineEndLength(position_ + 1) > 0) {
      break;
    }
    ++position_;
  }
  const size_t length = position_ - begin;
  if (!CheckLineLength()) return {};
  return bytes_.substr(begin, length);
}

bool TextScanner::NextLine() {
  bool joins = options_.continuations;
  while (position_ < bytes_.size() && !IsLineEnd(bytes_[position_])) {
    // A '\' that ends a comment joins nothing: it may be a path.
    if (options_.hash_comments && bytes_[position_] == '#') joins = false;
    if (joins && bytes_[position_] == '\\') {
      const size_t joined = LineEndLength(position_ + 1);
      if (joined > 0) ++line_;
      position_ += joined;
    }
    ++position_;
  }
  if (!CheckLineLength() || position_ >= bytes_.size()) return false;
  position_ += LineEndLength(position_);
  line_start_ = position_;
  if (position_ >= bytes_.size()) return false;
  ++line_;
  return true;
}

std::string_view TextScanner::Next() {
  while (true) {
    const std::string_view word = NextOnLine();
    if (!word.empty()) return word;
    if (!NextLine()) return {};
  }
}

bool TextScanner::AtLineEnd() {
  SkipBlanks();
  return position_ >= bytes_.size() || IsLineEnd(bytes_[position_]) ||
         (options_.hash_comments && bytes_[position_] == '#');
}

bool TextScanner::AtEnd() {
  while (AtLineEnd()) {
    if (!NextLine()) return true;
  }
  return false;
}

absl::Status TextScanner::Malformed(std::string_view message) const {
  return Located(absl::InvalidArgumentError(std::string(message)));
}

absl::Status TextScanner::OverLimit(std::string_view message) const {
  return Located(absl::ResourceExhaustedError(std::string(message)));
}

absl::Status TextScanner::Located(const absl::Status& status) const {
  if (!status_.ok()) return status_;
  if (status.ok()) return status;
  return absl::Status(
      status.code(),
      absl::StrFormat("%s line %d: %s", std::string(options_.format_name),
                      line_, std::string(status.message())));
}

absl::Status TextScanner::BadNumber(std::string_view subject,
                                    std::string_view word) const {
  std::string why;
  double value = 0;
  const std::string_view digits = WithoutPlus(word);
  const char* end = digits.data() + digits.size();
  if (word.empty()) {
    why = position_ >= bytes_.size() ? "the bytes end here"
                                     : "a number is missing";
  } else if (const auto result = std::from_chars(digits.data(), end, value);
             result.ptr != end || result.ec == std::errc::invalid_argument) {
    why = QuoteWord(word) + " is not a number";
  } else if (std::isfinite(value) && result.ec == std::errc() &&
             IsCoordinate(value)) {
    why = QuoteWord(word) + " is not a whole number";
  } else {
    why = QuoteWord(word) + " is not finite or beyond the range of float";
  }
  return Malformed(absl::StrFormat("%s: %s", std::string(subject), why));
}

bool IsCoordinate(double value) {
  // False for NaN as well.
  return std::abs(value) <=
         static_cast<double>(std::numeric_limits<float>::max());
}

std::optional<double> ParseCoordinate(std::string_view word) {
  word = WithoutPlus(word);
  double value = 0;
  const char* end = word.data() + word.size();
  const auto result = std::from_chars(word.data(), end, value);
  if (result.ptr != end) return std::nullopt;
  if (result.ec == std::errc::result_out_of_range && IsUnderflow(word)) {
    return 0.0;
  }
  if (result.ec != std::errc() || !IsCoordinate(value)) return std::nullopt;
  return value;
}

std::optional<int64_t> ParseInteger(std::string_view word) {
  word = WithoutPlus(word);
  int64_t value = 0;
  const char* end = word.data() + word.size();
  const auto result = std::from_chars(word.data(), end, value);
  if (result.ptr != end || result.ec != std::errc()) return std::nullopt;
  return value;
}

std::string QuoteWord(std::string_view word) {
  constexpr size_t kMaxQuoted = 40;
  const std::string begin(word.substr(0, kMaxQuoted));
  return '"' + absl::CHexEscape(begin) +
         (word.size() > kMaxQuoted ? "...\"" : "\"");
}

std::string LowerCase(std::string_view word) {
  return absl::AsciiStrToLower(std::string(word));
}

}  // namespace argmesh
