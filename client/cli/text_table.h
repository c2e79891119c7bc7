// A table for people: aligned columns, two spaces between them.
#ifndef ARGMESH_CLIENT_CLI_TEXT_TABLE_H_
#define ARGMESH_CLIENT_CLI_TEXT_TABLE_H_

#include <string>
#include <string_view>
#include <vector>

namespace argmesh {

enum class Align { kLeft, kRight };

class TextTable {
 public:
  // A header that begins with '>' makes a right-aligned column, without it.
  explicit TextTable(const std::vector<std::string>& headers);

  // As many cells as there are columns; missing ones are empty. Control
  // characters in a cell are shown as '?', so that a name in a file cannot
  // drive the terminal.
  void AddRow(std::vector<std::string> cells);
  bool empty() const { return rows_.empty(); }

  // Header, rule, rows; each line ends with '\n' and without spaces.
  std::string ToString() const;

 private:
  std::string Line(const std::vector<std::string>& cells,
                   const std::vector<size_t>& widths) const;

  std::vector<std::string> headers_;
  std::vector<Align> aligns_;
  std::vector<std::vector<std::string>> rows_;
};

// Characters of UTF-8 text.
size_t TextWidth(std::string_view text);

// The text without control characters.
std::string Printable(std::string_view text);

// Fixed decimals: FormatNumber(0.12345, 3) is "0.123".
std::string FormatNumber(double value, int decimals);

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_CLI_TEXT_TABLE_H_
