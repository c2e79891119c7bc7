#include "client/cli/text_table.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_format.h"

namespace argmesh {

TextTable::TextTable(const std::vector<std::string>& headers) {
  for (const std::string& header : headers) {
    const bool right = header.starts_with('>');
    headers_.push_back(right ? header.substr(1) : header);
    aligns_.push_back(right ? Align::kRight : Align::kLeft);
  }
}

void TextTable::AddRow(std::vector<std::string> cells) {
  cells.resize(headers_.size());
  for (std::string& cell : cells) cell = Printable(cell);
  rows_.push_back(std::move(cells));
}

std::string TextTable::ToString() const {
  std::vector<size_t> widths;
  widths.reserve(headers_.size());
  for (size_t c = 0; c < headers_.size(); ++c) {
    size_t width = TextWidth(headers_[c]);
    for (const auto& row : rows_) width = std::max(width, TextWidth(row[c]));
    widths.push_back(width);
  }
  std::vector<std::string> rule;
  rule.reserve(widths.size());
  for (const size_t width : widths) rule.emplace_back(width, '-');
  std::string text = Line(headers_, widths) + Line(rule, widths);
  for (const auto& row : rows_) text += Line(row, widths);
  return text;
}

std::string TextTable::Line(const std::vector<std::string>& cells,
                            const std::vector<size_t>& widths) const {
  std::string line;
  for (size_t c = 0; c < cells.size(); ++c) {
    const std::string padding(widths[c] - TextWidth(cells[c]), ' ');
    if (c > 0) line += "  ";
    line +=
        aligns_[c] == Align::kRight ? padding + cells[c] : cells[c] + padding;
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line + '\n';
}

size_t TextWidth(std::string_view text) {
  return static_cast<size_t>(std::count_if(
      text.begin(), text.end(),
      [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

std::string Printable(std::string_view text) {
  std::string result(text);
  std::replace_if(
      result.begin(), result.end(),
      [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; },
      '?');
  return result;
}

std::string FormatNumber(double value, int decimals) {
  return absl::StrFormat("%.*f", decimals, value);
}

}  // namespace argmesh
