#include "passo/report/trace_csv.hpp"

#include <algorithm>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "kit/seed.hpp"

namespace passo {
namespace {

const std::vector<TraceMotor> xyz = {{.axis = Axis::x}, {.axis = Axis::y}, {.axis = Axis::z}};

class Csv {
 public:
  explicit Csv(TraceOptions options) : trace_(options, [this](std::string_view piece) { take(piece); }) {}
  TraceCsv* operator->() { return &trace_; }
  std::string finished() {
    trace_.finish(Ticks{0});
    return text_;
  }
  std::size_t largest_piece = 0;
  std::size_t pieces = 0;

 private:
  void take(std::string_view piece) {
    text_ += piece;
    ++pieces;
    largest_piece = std::max(largest_piece, piece.size());
  }
  std::string text_;
  TraceCsv trace_;
};

std::string time_of(std::int64_t ticks, double clock) {
  Csv csv({.motors = {{.axis = Axis::x}}, .clock = Hertz(clock)});
  csv->on_steps(Ticks{ticks}, 1, 0);
  const std::string text = csv.finished();
  return text.substr(4, text.find(',', 4) - 4);
}

TEST(TraceCsv, of_a_job_without_steps_is_its_header) {
  EXPECT_EQ(Csv({.motors = xyz}).finished(), "t,x,y,z\n");
}

TEST(TraceCsv, names_the_axes_in_the_order_of_the_motors) {
  EXPECT_EQ(Csv({.motors = {{.axis = Axis::z}, {.axis = Axis::a}, {.axis = Axis::x}}}).finished(), "t,z,a,x\n");
}

TEST(TraceCsv, has_a_row_for_each_event_with_the_direction_of_each_step) {
  Csv csv({.motors = xyz});
  csv->on_steps(Ticks{16}, 0b101, 0b100);
  csv->on_steps(Ticks{160'000'000}, 0b010, 0b101);  // a motor that does not step has no direction
  EXPECT_EQ(csv.finished(), "t,x,y,z\n0.000001000,1,0,-1\n10.000000000,0,1,0\n");
}

TEST(TraceCsv, shows_the_windings_that_the_board_switches) {
  Csv csv({.motors = {{.axis = Axis::x}, {.axis = Axis::y}}, .windings = *Excitation::named("wave")});
  csv->on_steps(Ticks{16}, 0b01, 0);
  csv->on_steps(Ticks{32}, 0b11, 0b10);
  EXPECT_EQ(csv.finished(),
            "t,x,y,x_f1,x_f2,x_f3,x_f4,y_f1,y_f2,y_f3,y_f4\n"
            "0.000001000,1,0,0,1,0,0,0,0,0,0\n0.000002000,1,-1,0,0,1,0,0,0,0,1\n");
}

TEST(TraceCsv, shows_the_direction_of_the_axis_where_the_motor_is_inverted) {
  Csv csv({.motors = {{.axis = Axis::x}, {.axis = Axis::y, .inverted = true}}});
  csv->on_steps(Ticks{16}, 0b11, 0b10);
  csv->on_steps(Ticks{32}, 0b11, 0b01);
  csv->on_steps(Ticks{48}, 0b01, 0b00);
  EXPECT_EQ(csv.finished(), "t,x,y\n0.000001000,1,1\n0.000002000,-1,-1\n0.000003000,1,0\n");
}

TEST(TraceCsv, rounds_half_a_nanosecond_up) {
  EXPECT_EQ(time_of(1, 16e6), "0.000000063");  // 62.5 ns
  EXPECT_EQ(time_of(3, 16e6), "0.000000188");  // 187.5 ns
  EXPECT_EQ(time_of(1, 3e6), "0.000000333");
  EXPECT_EQ(time_of(2, 3e6), "0.000000667");
}

TEST(TraceCsv, carries_a_rounded_nanosecond_into_the_next_second) {
  // One tick before the full second is 0.3 ns before it.
  EXPECT_EQ(time_of(2'999'999'999, 3e9), "1.000000000");
  EXPECT_EQ(time_of(3'000'000'000, 3e9), "1.000000000");
}

TEST(TraceCsv, stays_exact_after_a_year) {
  EXPECT_EQ(time_of(16'000'000LL * 31'536'000 + 1, 16e6), "31536000.000000063");
}

TEST(TraceCsv, tells_the_nearest_nanosecond_for_random_clocks_and_times) {
  const std::uint64_t seed = test::seed();
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  for (int i = 0; i < 2000; ++i) {
    const auto hertz = static_cast<std::int64_t>(1 + random() % 4'000'000'000);
    const auto ticks = static_cast<std::int64_t>(random() % 100'000'000'000);
    const std::string text = time_of(ticks, static_cast<double>(hertz));
    const std::size_t point = text.find('.');
    ASSERT_EQ(text.size() - point, 10U);
    // |t − ticks/hertz| is at most half a nanosecond. To use whole numbers, the unit is 1/(2·10⁹·hertz) seconds.
    const auto nanoseconds = std::stoll(text.substr(point + 1));
    const std::int64_t rest = ticks - std::stoll(text.substr(0, point)) * hertz;
    __extension__ using Wide = __int128;
    const Wide twice_off = Wide{2} * (Wide{nanoseconds} * hertz - Wide{rest} * 1'000'000'000);
    ASSERT_LE(twice_off, hertz) << ticks << " at " << hertz;
    ASSERT_GT(twice_off, -hertz) << ticks << " at " << hertz;
  }
}

TEST(TraceCsv, hands_on_a_long_job_in_pieces_of_bounded_size) {
  Csv csv({.motors = xyz});
  constexpr int rows = 100'000;
  for (int i = 1; i <= rows; ++i) csv->on_steps(Ticks{i * 160}, 1, 0);
  const std::string text = csv.finished();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), rows + 1);
  EXPECT_LE(csv.largest_piece, 64U * 1024);
  EXPECT_GT(csv.pieces, 10U);
  EXPECT_TRUE(text.ends_with("\n1.000000000,1,0,0\n"));
}

}  // namespace
}  // namespace passo
