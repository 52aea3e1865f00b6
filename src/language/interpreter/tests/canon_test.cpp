// Golden text: programs of our own and the canonical calls they mean. Each was compared with `rs274 -g` of LinuxCNC 2.9
// when it was written and is the same to the character (but for the sign of -0.0000).
#include <filesystem>
#include <fstream>
#include <set>

#include "interpreted.hpp"
#include "kit/golden.hpp"
#include <gtest/gtest.h>

#include "passo/interpreter/tool_table_file.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;

const fs::path golden = fs::path(PASSO_SOURCE_DIR) / "src/language/interpreter/tests/golden";

class Golden : public testing::TestWithParam<std::string> {};

TEST_P(Golden, program_prints_its_canonical_calls) {
  const fs::path program = golden / (GetParam() + ".ngc");
  InterpreterOptions options;
  const fs::path table = golden / (GetParam() + ".tbl");
  if (fs::exists(table)) {  // in inches, as rs274 reads it
    Diagnostics diagnostics;
    options.machine_units = LengthUnits::inch;
    ASSERT_TRUE(read_tool_table(table.string(), options.machine_units, options.tools, diagnostics));
  }
  const Interpreted result = interpret_text(contents(program.string()), options);
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  test::expect_golden("src/language/interpreter/tests/golden/" + GetParam() + ".canon", result.canon);
}

std::set<std::string> golden_programs() {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(golden)) {
    if (entry.path().extension() == ".ngc") names.insert(entry.path().stem().string());
  }
  return names;
}

INSTANTIATE_TEST_SUITE_P(Canon, Golden, testing::ValuesIn(golden_programs()),
                         [](const auto& instance) { return instance.param; });

TEST(Canon, a_number_that_rounds_to_nothing_has_no_sign) {
  CanonPrinter printer;
  std::string out;
  Point end;
  end[Axis::x] = -0.00004;
  end[Axis::y] = -0.00006;
  printer.print({operation::StraightFeed{end}, {7, 20}}, out);
  EXPECT_EQ(out, "    1 N20    STRAIGHT_FEED(0.0000, -0.0001, 0.0000, 0.0000, 0.0000, 0.0000)\n");
}

TEST(Canon, feeds_and_lengths_are_told_in_the_units_of_that_place) {
  CanonPrinter printer;
  std::string out;
  printer.print({operation::SetLengthUnits{LengthUnits::inch}, {}}, out);
  out.clear();
  printer.print({operation::SetFeedRate{operation::FeedPerSecond{MmPerSecond(25.4 / 60)}}, {}}, out);
  EXPECT_EQ(out, "    2 N..... SET_FEED_RATE(1.0000)\n");
  out.clear();
  printer.print({operation::SetFeedMode{FeedMode::units_per_revolution}, {}}, out);
  printer.print({operation::SetFeedRate{operation::FeedPerRevolution{Mm(2.54)}}, {}}, out);
  EXPECT_EQ(out, "    3 N..... SET_FEED_MODE(0, 1)\n    4 N..... SET_FEED_RATE(0.1000)\n");
}

}  // namespace
}  // namespace passo
