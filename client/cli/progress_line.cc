#include "client/cli/progress_line.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_format.h"
#include "absl/time/clock.h"

namespace argmesh {
namespace {

constexpr size_t kBarWidth = 28;

std::string FormatSeconds(double seconds) {
  const auto whole = static_cast<int64_t>(std::ceil(seconds));
  if (whole < 60) return absl::StrFormat("%ds", whole);
  if (whole < 3600) return absl::StrFormat("%dm%02ds", whole / 60, whole % 60);
  return absl::StrFormat("%dh%02dm", whole / 3600, whole / 60 % 60);
}

}  // namespace

std::string FormatProgress(std::string_view label, size_t done, size_t total,
                           absl::Duration elapsed) {
  done = std::min(done, total);
  const size_t filled = total == 0 ? kBarWidth : kBarWidth * done / total;
  std::string bar(filled, '=');
  if (filled < kBarWidth) bar += '>';
  bar.resize(kBarWidth, ' ');
  std::string line =
      absl::StrFormat("%s [%s] %d/%d", std::string(label), bar, done, total);
  const double seconds = absl::ToDoubleSeconds(elapsed);
  if (done == 0 || seconds <= 0) return line;
  const double rate = static_cast<double>(done) / seconds;
  line += absl::StrFormat("  %.1f/s", rate);
  if (done < total) {
    line += "  eta " + FormatSeconds(static_cast<double>(total - done) / rate);
  }
  return line;
}

ProgressLine::ProgressLine(std::ostream& out, bool is_terminal,
                           std::string_view label, size_t total)
    : out_(out),
      is_terminal_(is_terminal),
      label_(label),
      total_(total),
      start_(absl::Now()) {}

ProgressLine::~ProgressLine() { Clear(); }

void ProgressLine::Advance(size_t done) {
  done_ = done;
  if (!is_terminal_) return;
  const absl::Time now = absl::Now();
  if (done < total_ && now - drawn_ < absl::Milliseconds(100)) return;
  drawn_ = now;
  Draw();
}

void ProgressLine::Print(std::string_view line) {
  const bool shown = width_ > 0;
  Clear();
  out_ << line << '\n';
  if (shown) Draw();
}

void ProgressLine::Clear() {
  if (width_ == 0) return;
  out_ << '\r' << std::string(width_, ' ') << '\r' << std::flush;
  width_ = 0;
}

void ProgressLine::Draw() {
  std::string line =
      FormatProgress(label_, done_, total_, absl::Now() - start_);
  const size_t width = line.size();
  if (width < width_) line.resize(width_, ' ');
  out_ << '\r' << line << std::flush;
  width_ = width;
}

}  // namespace argmesh
