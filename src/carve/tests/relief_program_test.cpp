// Programs of reliefs, read again move by move: no move cuts into the surface, no rapid into the stock.
#include "passo/carve/relief_program.hpp"

#include <map>
#include <random>
#include <string>

#include "gouge_oracle.hpp"
#include "kit/seed.hpp"
#include <gmock/gmock.h>

namespace passo {
namespace {

using namespace test;
using testing::HasSubstr;
using testing::Not;

struct ReadMove {
  bool is_rapid = false;
  double from[3] = {};
  double to[3] = {};
  std::size_t tool = 0;  // how many tools were changed before
};

std::vector<ReadMove> moves_of(const std::string& program) {
  std::vector<ReadMove> moves;
  double at[3] = {0, 0, 1000};
  bool is_rapid = true;
  bool knows_x = false;
  std::size_t tool = 0;
  std::size_t begin = 0;
  while (begin < program.size()) {
    const std::size_t end = program.find('\n', begin);
    const std::string line = program.substr(begin, end - begin);
    begin = end + 1;
    if (line.find("M6") != std::string::npos) ++tool;
    if (line.empty() || line[0] == '(' || line[0] == 'M' || line[0] == 'T' || line.starts_with("G17") ||
        line.starts_with("G4")) {
      continue;
    }
    ReadMove move{.tool = tool};
    std::copy_n(at, 3, move.from);
    for (std::size_t i = 0; i < line.size();) {
      const char letter = line[i];
      std::size_t used = 0;
      const double value = std::stod(line.substr(i + 1), &used);
      if (letter == 'G') is_rapid = value == 0;
      if (letter == 'X' || letter == 'Y' || letter == 'Z') at[letter - 'X'] = value;
      if (letter == 'X') knows_x = true;
      i += 1 + used;
      while (i < line.size() && line[i] == ' ') ++i;
    }
    move.is_rapid = is_rapid;
    std::copy_n(at, 3, move.to);
    if (knows_x) moves.push_back(move);
  }
  return moves;
}

struct Written {
  std::string text;
  ReliefReport report;
};
Written written(const HeightGrid& grid, const ReliefProgramOptions& options, bool wants_carved = false) {
  Written program;
  program.report = write_relief(
      grid, options, [&](std::string_view text) { program.text += text; }, [](double) {}, wants_carved);
  return program;
}

const OracleCutter& oracle_of(const char* text) {
  for (const OracleCutter& cutter : oracle_cutters()) {
    if (std::string(cutter.text) == text) return cutter;
  }
  return oracle_cutters().front();
}

// `every`: of the places along the moves, one in so many is checked.
void expect_no_gouge(const HeightGrid& grid, const std::string& program, const std::vector<OracleCutter>& tools,
                     int every) {
  int places = 0;
  for (const ReadMove& move : moves_of(program)) {
    const OracleCutter& cutter = tools[tools.size() > 1 ? move.tool - 1 : 0];
    const double length = std::hypot(move.to[0] - move.from[0], move.to[1] - move.from[1]);
    const int parts = std::max(1, static_cast<int>(length / 0.07));
    for (int i = 0; i <= parts; ++i) {
      if (++places % every != 0 && !move.is_rapid) continue;
      const double share = static_cast<double>(i) / parts;
      const auto at = [&](int axis) { return move.from[axis] + (move.to[axis] - move.from[axis]) * share; };
      ASSERT_GE(at(2), least_tip(grid, cutter, at(0), at(1), 3) - 1.5e-4)
          << cutter.text << " at X" << at(0) << " Y" << at(1) << (move.is_rapid ? ", a rapid" : "");
    }
  }
  EXPECT_GT(places, 1000);
}

ReliefProgramOptions options_of(const char* cutter) {
  ReliefProgramOptions options;
  options.finish.cutter = *parse_cutter(cutter);
  options.finish.step_over = Mm(0.6);
  options.tolerance = Mm(0.02);
  return options;
}

TEST(ReliefProgram, never_cuts_into_a_random_surface) {
  std::mt19937_64 random(seed());
  const FinishWay ways[] = {FinishWay::rows, FinishWay::columns, FinishWay::both, FinishWay::spiral};
  std::size_t i = 0;
  for (const OracleCutter& cutter : oracle_cutters()) {
    const HeightGrid grid = random_surface(random, 40, 30, Mm(0.2), Mm(0.25));
    ReliefProgramOptions options = options_of(cutter.text);
    options.way = ways[i % 4];
    options.ramps = i % 2 == 0;
    ++i;
    expect_no_gouge(grid, written(grid, options).text, {cutter}, 3);
  }
}

HeightGrid hills(std::size_t columns, std::size_t rows, double pitch, double high = 1.5) {
  HeightGrid grid{.columns = columns, .rows = rows, .pitch_x = Mm(pitch), .pitch_y = Mm(pitch)};
  for (std::size_t y = 0; y < rows; ++y) {
    for (std::size_t x = 0; x < columns; ++x) {
      const double u = static_cast<double>(x) * pitch;
      const double v = static_cast<double>(y) * pitch;
      grid.heights.push_back(grid_height(Mm(-2.5 + high * std::sin(u * 1.3) * std::cos(v * 1.1) + (u > 5 ? 1 : 0))));
    }
  }
  return grid;
}

ReliefProgramOptions three_tools() {
  ReliefProgramOptions options = options_of("ball:3");
  options.roughing =
      ReliefRoughing{.tool = {.cutter = *parse_cutter("flat:2.3")}, .step_down = Mm(1), .stock = Mm(0.2)};
  options.rest = ReliefRest{.tool = {.cutter = *parse_cutter("taper:1:10:3")}};
  return options;
}

TEST(ReliefProgram, with_three_tools_never_cuts_into_the_surface) {
  const HeightGrid grid = hills(45, 40, 0.2);
  const Written program = written(grid, three_tools());
  EXPECT_THAT(program.text, HasSubstr("T3 M6"));
  expect_no_gouge(grid, program.text, {oracle_of("flat:2.3"), oracle_of("ball:3"), oracle_of("taper:1:10:3")}, 4);
  ASSERT_EQ(program.report.parts.size(), 3U);
  for (const ReliefPart& part : program.report.parts) EXPECT_GT(part.moves, 10U) << part.what;
}

// The stock as heights at fine places, cut by each place of the tool.
class OracleStock {
 public:
  OracleStock(double width, double length) : columns_(places(width)), rows_(places(length)) {
    heights_.assign(columns_ * rows_, 0);
  }

  // How deep the cutter is in the stock. `share`: of its radius, what counts.
  double depth_of(const OracleCutter& cutter, double x, double y, double z, double share = 1) const {
    double deepest = 0;
    const OracleCutter inner{cutter.text, cutter.radius * share, cutter.height};
    each(inner, x, y, [&](std::size_t i, double height) { deepest = std::max(deepest, heights_[i] - z - height); });
    return deepest;
  }
  void cut(const OracleCutter& cutter, double x, double y, double z) {
    each(cutter, x, y, [&](std::size_t i, double height) { heights_[i] = std::min(heights_[i], z + height); });
  }
  double at(double x, double y) const {
    return heights_[static_cast<std::size_t>((y + beyond) / fine) * columns_ +
                    static_cast<std::size_t>((x + beyond) / fine)];
  }

 private:
  static constexpr double fine = 0.1;
  static constexpr double beyond = 3.5;
  static std::size_t places(double size) { return static_cast<std::size_t>((size + 2 * beyond) / fine) + 1; }

  template <class Act>
  void each(const OracleCutter& cutter, double x, double y, const Act& act) const {
    const auto first = [&](double at) {
      return static_cast<std::size_t>(std::max(0.0, (at - cutter.radius + beyond) / fine));
    };
    const auto end = [&](double at, std::size_t most) {
      return std::min(most, static_cast<std::size_t>((at + cutter.radius + beyond) / fine) + 1);
    };
    for (std::size_t j = first(y); j < end(y, rows_); ++j) {
      const double dy = static_cast<double>(j) * fine - beyond - y;
      for (std::size_t i = first(x); i < end(x, columns_); ++i) {
        const double away = std::hypot(static_cast<double>(i) * fine - beyond - x, dy);
        if (away <= cutter.radius) act(j * columns_ + i, cutter.height(away));
      }
    }
  }

  std::size_t columns_;
  std::size_t rows_;
  std::vector<double> heights_;
};

TEST(ReliefProgram, has_no_rapid_through_the_stock_and_leaves_little) {
  const HeightGrid grid = hills(61, 51, 0.1, 0.8);  // its valleys are wider than the smallest tip
  const Written program = written(grid, three_tools(), true);
  const std::vector<OracleCutter> tools = {oracle_of("flat:2.3"), oracle_of("ball:3"), oracle_of("taper:1:10:3")};
  OracleStock stock(6, 5);
  double deepest = 0;
  for (const ReadMove& move : moves_of(program.text)) {
    const OracleCutter& cutter = tools[move.tool - 1];
    const double length = std::hypot(move.to[0] - move.from[0], move.to[1] - move.from[1], move.to[2] - move.from[2]);
    const int parts = std::max(1, static_cast<int>(length / 0.15));
    for (int i = 0; i <= parts; ++i) {
      const double share = static_cast<double>(i) / parts;
      const auto at = [&](int axis) { return move.from[axis] + (move.to[axis] - move.from[axis]) * share; };
      if (move.tool == 1) {
        // Where it goes from row to row, its rim may meet slivers that the rows have left.
        deepest = std::max(deepest, stock.depth_of(cutter, at(0), at(1), at(2), 0.7));
      }
      if (move.is_rapid) {
        ASSERT_LE(stock.depth_of(cutter, at(0), at(1), at(2)), 1e-3)
            << at(0) << ", " << at(1) << ", " << at(2) << " tool " << move.tool;
      } else {
        stock.cut(cutter, at(0), at(1), at(2));
      }
    }
  }
  EXPECT_LE(deepest, 1.05) << "the roughing cutter goes no deeper than a level";
  // On the nodes, those of edges and corners included. The step at X5 is a cell wide.
  for (double y = 0; y <= 5; y += 0.1) {
    for (double x = 0; x <= 6; x += 0.1) {
      if (std::abs(x - 5) < 0.7) continue;
      const double left = stock.at(x + 1e-9, y + 1e-9) - surface_at(grid, x, y);
      EXPECT_GE(left, -0.02) << x << ", " << y;
      EXPECT_LE(left, 0.2) << x << ", " << y;
      // The view that the program draws of it is the same.
      const auto node = static_cast<std::size_t>(std::lround(y / 0.1)) * grid.columns +
                        static_cast<std::size_t>(std::lround(x / 0.1));
      EXPECT_NEAR(program.report.carved.heights[node], stock.at(x + 1e-9, y + 1e-9), 0.05) << x << ", " << y;
    }
  }
}

TEST(ReliefProgram, has_few_lines_within_the_tolerance) {
  HeightGrid grid{.columns = 401, .rows = 41, .pitch_x = Mm(0.1), .pitch_y = Mm(0.1)};
  for (int i = 0; i < 401 * 41; ++i) grid.heights.push_back(grid_height(Mm(-2 + std::sin((i % 401) * 0.02))));
  ReliefProgramOptions options = options_of("ball:3");
  options.tolerance = Mm(0.0);
  const std::uint64_t exact = written(grid, options).report.parts[0].moves;
  options.tolerance = Mm(0.01);
  const std::uint64_t few = written(grid, options).report.parts[0].moves;
  EXPECT_LT(few * 4, exact);
  HeightGrid flat = grid;
  flat.heights.assign(flat.heights.size(), -1.0F);
  const Written lines = written(flat, options);
  EXPECT_LT(lines.report.parts[0].moves, 40U) << "a row of a flat is one line";
}

TEST(ReliefProgram, goes_down_no_faster_than_the_plunge_feed) {
  const HeightGrid grid = hills(60, 40, 0.2);
  ReliefProgramOptions options = options_of("ball:3");
  options.finish.feed = Mm(1500);
  options.finish.plunge = Mm(200);
  std::size_t slow = 0;
  double feed = 0;
  double at[3] = {0, 0, 5};
  const std::string text = written(grid, options).text;
  for (std::size_t begin = text.find("\nG1 ") + 1; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    double to[3] = {at[0], at[1], at[2]};
    for (std::size_t i = begin; i < end; ++i) {
      if (text[i] == 'F') feed = std::stod(text.substr(i + 1));
      if (text[i] >= 'X' && text[i] <= 'Z') to[text[i] - 'X'] = std::stod(text.substr(i + 1));
    }
    if (text[begin] == 'G' && text[begin + 1] == '0') break;
    const double length = std::hypot(to[0] - at[0], to[1] - at[1], to[2] - at[2]);
    if (length > 0) {
      EXPECT_LE((at[2] - to[2]) / length * feed, 200.001) << text.substr(begin, end - begin);
    }
    if (feed < 1500) ++slow;
    std::copy_n(to, 3, at);
    begin = end + 1;
  }
  EXPECT_GT(slow, 20U);
}

TEST(ReliefProgram, is_the_same_for_any_number_of_threads) {
  const HeightGrid grid = hills(80, 70, 0.1);
  ReliefProgramOptions options = three_tools();
  const std::string one = written(grid, options).text;
  options.threads = 5;
  EXPECT_EQ(written(grid, options).text, one);
}

// A frame at the top stays even: beside the surface no cutter goes below its edge.
TEST(ReliefProgram, goes_on_level_beside_the_surface_unless_that_is_a_body) {
  HeightGrid grid{.columns = 41, .rows = 31, .pitch_x = Mm(0.2), .pitch_y = Mm(0.2)};
  for (int i = 0; i < 41 * 31; ++i) {
    const bool is_frame = i % 41 < 6 || i % 41 > 34 || i / 41 < 6 || i / 41 > 24;
    grid.heights.push_back(is_frame ? 0.0F : -3.0F);
  }
  const auto lowest_beside = [&](const std::string& program) {
    double lowest = 100;
    for (const ReadMove& move : moves_of(program)) {
      const bool is_beside = move.to[0] < 0 || move.to[0] > 8 || move.to[1] < 0 || move.to[1] > 6;
      if (is_beside) lowest = std::min(lowest, move.to[2]);
    }
    return lowest;
  };
  for (const FinishWay way : {FinishWay::both, FinishWay::spiral}) {
    ReliefProgramOptions options = three_tools();
    options.way = way;
    EXPECT_NEAR(lowest_beside(written(grid, options).text), 0, 1e-3);
    options.beside = BesideGrid::nothing;
    EXPECT_NEAR(lowest_beside(written(grid, options).text), -3, 1e-3) << "the sides of a body are cut";
  }
}

TEST(ReliefProgram, is_placed_by_its_origin_and_cuts_its_edges) {
  const HeightGrid grid = hills(11, 21, 0.5);
  for (const FinishWay way : {FinishWay::rows, FinishWay::columns, FinishWay::spiral}) {
    ReliefProgramOptions options = options_of("ball:3");
    options.way = way;
    options.x0 = Mm(-2.5);
    options.y0 = Mm(100);
    double low[2] = {1e9, 1e9};
    double high[2] = {-1e9, -1e9};
    for (const ReadMove& move : moves_of(written(grid, options).text)) {
      for (int axis = 0; axis < 2; ++axis) {
        low[axis] = std::min(low[axis], move.to[axis]);
        high[axis] = std::max(high[axis], move.to[axis]);
      }
    }
    EXPECT_DOUBLE_EQ(low[0], -4);
    EXPECT_DOUBLE_EQ(high[0], 4);
    EXPECT_DOUBLE_EQ(low[1], 98.5);
    EXPECT_DOUBLE_EQ(high[1], 111.5);
  }
}

}  // namespace
}  // namespace passo
