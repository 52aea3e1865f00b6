// The sequences of ../shared/golden, if they are there. Independent code computed them; they must match exactly.
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "walk.hpp"
#include <gtest/gtest.h>

#include "passo/interpolate/arcs.hpp"
#include "passo/interpolate/bresenham_line.hpp"
#include "passo/interpolate/dda.hpp"
#include "passo/interpolate/master_slave.hpp"
#include "passo/interpolate/point_comparison_line.hpp"
#include "passo/interpolate/slope_blocks.hpp"
#include "passo/interpolate/slope_recalculated.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;
using Numbers = std::vector<std::int64_t>;

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

// The rows of a file. The key is the first `keys` columns joined; the rest are numbers, without empty ones.
class Golden : public testing::Test {
 protected:
  std::map<std::string, std::vector<Numbers>> read(const std::string& name, std::size_t keys) {
    const fs::path path = fs::path(PASSO_SOURCE_DIR) / "../shared/golden" / name;
    std::map<std::string, std::vector<Numbers>> cases;
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
      const std::vector<std::string> cells = split(line, ',');
      std::string key;
      for (std::size_t i = 0; i < keys; ++i) key += cells[i] + " ";
      Numbers row;
      for (std::size_t i = keys; i < cells.size(); ++i) {
        if (!cells[i].empty()) row.push_back(std::stoll(cells[i]));
      }
      cases[key].push_back(row);
    }
    return cases;
  }
  void SetUp() override {
    if (!fs::exists(fs::path(PASSO_SOURCE_DIR) / "../shared/golden")) GTEST_SKIP() << "../shared/golden is not here";
  }
};

Numbers numbers(const std::string& key) {
  Numbers found;
  for (const std::string& part : split(key, ' ')) found.push_back(std::stoll(part));
  return found;
}

struct Distances {
  explicit Distances(const Numbers& given) : axes(given.size()) {
    for (std::size_t i = 0; i < axes; ++i) all[i] = static_cast<std::int32_t>(given[i]);
  }
  std::size_t axes;
  std::int32_t all[6] = {};
};

// Each row: the number of the pulse, then the place.
template <std::size_t axes, class Interpolator>
void expect_rows(const std::string& key, const std::vector<Numbers>& rows, Interpolator interpolator) {
  const auto found = test::places<axes>(interpolator);
  ASSERT_EQ(found.size(), rows.size()) << key;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t axis = 0; axis + 1 < rows[i].size(); ++axis) {
      ASSERT_EQ(found[i][axis], rows[i][axis + 1]) << key << "pulse " << i + 1;
    }
  }
}

TEST_F(Golden, master_and_slaves_by_rounding_and_lean) {
  const auto cases = read("line_master_slave.csv", 1);
  EXPECT_GE(cases.size(), 5U);
  for (const auto& [key, rows] : cases) {
    const Distances distances(numbers(key));
    expect_rows<6>(key, rows, MasterSlave<6>(distances.all));
    expect_rows<6>(key, rows, BresenhamLine<6>(distances.all));
    expect_rows<6>(key, rows, BresenhamLine<6, std::uint16_t>(distances.all));
  }
}

TEST_F(Golden, dda_with_zero_and_half_load) {
  const auto cases = read("line_dda.csv", 2);
  EXPECT_GE(cases.size(), 4U);
  for (const auto& [key, rows] : cases) {
    Numbers given = numbers(key);
    const DdaLoad load = given.back() != 0 ? DdaLoad::half : DdaLoad::zero;
    given.pop_back();
    expect_rows<6>(key, rows, Dda<6>(Distances(given).all, load));
    expect_rows<6>(key, rows, Dda<6, std::uint16_t>(Distances(given).all, load));
  }
}

TEST_F(Golden, slope_recalculated_and_in_blocks) {
  for (const auto& [key, rows] : read("line_slope_recalculated.csv", 2)) {
    const Numbers d = numbers(key);
    expect_rows<2>(key, rows, SlopeRecalculated<>({static_cast<std::int32_t>(d[0]), static_cast<std::int32_t>(d[1])}));
  }
  for (const auto& [key, rows] : read("line_slope_blocks.csv", 2)) {
    const Numbers d = numbers(key);
    expect_rows<2>(key, rows, SlopeBlocks<>({static_cast<std::int32_t>(d[0]), static_cast<std::int32_t>(d[1])}));
  }
}

// Each row: the number of the pulse, the place, the deviation.
template <class Interpolator>
void expect_comparison(const std::string& key, const std::vector<Numbers>& rows, test::Place<2> start,
                       Interpolator interpolator) {
  std::size_t row = 0;
  test::walk<2>(interpolator, start, [&](Pulse, const test::Place<2>& place, const Interpolator& now) {
    ASSERT_LT(row, rows.size()) << key;
    EXPECT_EQ((Numbers{place[0], place[1], now.deviation()}), Numbers(rows[row].begin() + 1, rows[row].end()))
        << key << "pulse " << row + 1;
    ++row;
  });
  EXPECT_EQ(row, rows.size()) << key;
}

TEST_F(Golden, point_comparison_of_lines_with_every_way_to_judge_the_end) {
  const auto cases = read("line_point_comparison.csv", 2);
  EXPECT_GE(cases.size(), 5U);
  for (const auto& [key, rows] : cases) {
    const Numbers d = numbers(key);
    const std::int32_t end[2] = {static_cast<std::int32_t>(d[0]), static_cast<std::int32_t>(d[1])};
    expect_comparison(key, rows, {}, PointComparisonLine<std::uint32_t, EndByCoordinates>(end));
    expect_comparison(key, rows, {}, PointComparisonLine<std::uint32_t, EndByProjection>(end));
    expect_comparison(key, rows, {}, PointComparisonLine<std::uint32_t, EndByTotal>(end));
    expect_comparison(key, rows, {}, PointComparisonLine<std::uint16_t, EndByTotal>(end));
  }
}

TEST_F(Golden, point_comparison_of_arcs) {
  const auto cases = read("arc_point_comparison.csv", 5);
  EXPECT_GE(cases.size(), 4U);
  for (const auto& [key, rows] : cases) {
    const Numbers d = numbers(key);
    const ArcPoints arc{.start = {static_cast<std::int32_t>(d[0]), static_cast<std::int32_t>(d[1])},
                        .end = {static_cast<std::int32_t>(d[2]), static_cast<std::int32_t>(d[3])},
                        .clockwise = d[4] != 0};
    expect_comparison(key, rows, {d[0], d[1]}, PointComparisonArc<>(arc));
    expect_comparison(key, rows, {d[0], d[1]}, PointComparisonArc<std::uint16_t>(arc));
  }
}

}  // namespace
}  // namespace passo
