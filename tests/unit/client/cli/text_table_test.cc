#include "client/cli/text_table.h"

#include <gtest/gtest.h>

namespace argmesh {
namespace {

TEST(TextTable, AlignsColumnsAndEndsLinesWithoutSpaces) {
  TextTable table({"name", ">score", "note"});
  table.AddRow({"a", "0.5", "x"});
  table.AddRow({"longer", "10.25"});
  EXPECT_EQ(table.ToString(),
            "name    score  note\n"
            "------  -----  ----\n"
            "a         0.5  x\n"
            "longer  10.25\n");
}

TEST(TextTable, CountsCharactersRatherThanBytes) {
  TextTable table({"n", "x"});
  table.AddRow({"é", "1"});
  table.AddRow({"ab", "2"});
  EXPECT_EQ(table.ToString(), "n   x\n--  -\né   1\nab  2\n");
}

TEST(TextTable, KeepsControlCharactersFromTheTerminal) {
  TextTable table({"n"});
  table.AddRow({"a\x1b[31m\nb"});
  EXPECT_EQ(table.ToString(), "n\n--------\na?[31m?b\n");
}

TEST(TextTable, HasAHeaderWithoutRows) {
  EXPECT_EQ(TextTable({"a", ">b"}).ToString(), "a  b\n-  -\n");
}

}  // namespace
}  // namespace argmesh
