// The parts of Leveller: LevelledWriter, KnownWorkPosition and OffCodes.
#include "../levelled_writer.hpp"

#include "../known_work_position.hpp"
#include "../off_codes.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

constexpr AxisSet x_and_y{0b11};
constexpr AxisSet only_z{0b100};

Point at(double x, double z) {
  Point place;
  place[Axis::x] = x;
  place[Axis::z] = z;
  return place;
}

LevelledMove move_between(const Point& from, const Point& to, bool rapid = false) {
  return {.from = from, .to = to, .rapid = rapid, .feed = 100};
}

class LevelledWriterTest : public testing::Test {
 protected:
  // 0.1 higher every 10 mm of X.
  const HeightMap map_{{0, 100}, {0, 100}, {0, 1, 0, 1}};
  const LevelOptions wish_{};
  std::string text_;
  const std::function<void(std::string_view)> write_ = [this](std::string_view text) { text_ += text; };
  LevelledWriter writer_{map_, wish_, 5, write_};
};

TEST_F(LevelledWriterTest, writes_a_move_at_the_height_of_the_surface) {
  writer_.add(move_between(at(10, -1), at(50, -1)));
  EXPECT_EQ(writer_.height(), -0.5);
  EXPECT_EQ(writer_.higher_than(at(50, -1)), 0.5);
  EXPECT_TRUE(writer_.any_levelled());
  EXPECT_EQ(writer_.count().moves_before, 1U);
}

TEST_F(LevelledWriterTest, keeps_the_depth_of_a_hole) {
  writer_.add(move_between(at(50, 2), at(50, -3)));
  EXPECT_EQ(text_, "");  // it may be a hole
  writer_.add(move_between(at(50, -3), at(50, 2), true));
  writer_.end_run();
  EXPECT_NE(text_.find("Z-3 "), std::string::npos) << text_;
  EXPECT_EQ(writer_.count().holes, 1U);
}

TEST_F(LevelledWriterTest, levels_a_plunge_that_goes_on_along_the_surface) {
  writer_.add(move_between(at(50, 2), at(50, -3)));
  writer_.add_line("M8");
  writer_.add(move_between(at(50, -3), at(60, -3)));
  EXPECT_NE(text_.find("Z-2.5"), std::string::npos) << text_;
  EXPECT_LT(text_.find("Z-2.5"), text_.find("M8")) << text_;
  EXPECT_EQ(writer_.count().holes, 0U);
}

TEST_F(LevelledWriterTest, takes_a_retract_of_the_machine_for_the_end_of_a_hole) {
  writer_.add(move_between(at(50, 2), at(50, -3)));
  writer_.end_run(true);
  EXPECT_EQ(writer_.count().holes, 1U);
  EXPECT_EQ(writer_.height(), -3);
}

TEST(KnownWorkPosition, is_known_by_what_the_program_names) {
  KnownWorkPosition said;
  EXPECT_EQ(said.height(), LevelHeight::of_machine);
  said.note_move(x_and_y, false);
  EXPECT_TRUE(said.has_all(x_and_y));
  EXPECT_EQ(said.height(), LevelHeight::of_machine);
  said.note_move({}, true);  // some way along Z
  EXPECT_EQ(said.height(), LevelHeight::of_work);
  said.note_move(only_z, true);
  EXPECT_EQ(said.height(), LevelHeight::known);
  said.note_move({}, true);
  EXPECT_EQ(said.height(), LevelHeight::known);
}

TEST(KnownWorkPosition, is_lost_axis_by_axis) {
  KnownWorkPosition said;
  said.note_move(AxisSet(0b111), true);
  said.lose(x_and_y);
  EXPECT_FALSE(said.has(Axis::x));
  EXPECT_EQ(said.height(), LevelHeight::known);
  said.lose(only_z);
  EXPECT_EQ(said.height(), LevelHeight::of_work);
  said.leave_work();
  EXPECT_EQ(said.height(), LevelHeight::of_machine);
  said.lose(only_z);
  EXPECT_EQ(said.height(), LevelHeight::of_machine);
}

TEST(KnownWorkPosition, is_known_in_x_and_y_after_a_cycle) {
  KnownWorkPosition said;
  said.note_cycle(LevelHeight::of_machine);
  EXPECT_TRUE(said.has_all(x_and_y));
  EXPECT_FALSE(said.has(Axis::z));
  said.note_cycle(LevelHeight::known);
  EXPECT_TRUE(said.has(Axis::z));
}

TEST(OffCodes, leave_out_what_is_off_already) {
  OffCodes codes;
  EXPECT_FALSE(codes.is_off_already("M5"));
  EXPECT_TRUE(codes.is_off_already("M5"));
  EXPECT_FALSE(codes.is_off_already("M3"));
  EXPECT_FALSE(codes.is_off_already("M9"));
  EXPECT_TRUE(codes.is_off_already("M9"));
  EXPECT_FALSE(codes.is_off_already("M5"));
  EXPECT_FALSE(codes.is_off_already("M8"));
  EXPECT_FALSE(codes.is_off_already("M9"));
}

}  // namespace
}  // namespace passo
