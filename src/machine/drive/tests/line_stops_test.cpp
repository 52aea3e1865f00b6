#include "passo/drive/line_stops.hpp"

#include "kit/stage_test.hpp"

namespace passo {
namespace {

using test::xyz;

Segment of_line(std::uint32_t number, double from, double to, SpindleLock lock = SpindleLock::none) {
  return {.curve = Curve::line(xyz(from, 0), xyz(to, 0)), .lock = lock, .source = {.line = number}};
}

// The lines of the items, and "|" where the motion rests.
std::string lines_of(std::vector<PathItem> items, bool stops = true) {
  test::ListSource<PathItem> source{std::move(items)};
  RewindablePath path(source);
  LineStops line_stops(path);
  line_stops.stop_at_lines(stops);
  std::string text;
  for (const PathItem& item : test::drain(line_stops)) {
    const auto* action = std::get_if<Action>(&item);
    const bool rests = action != nullptr && action->kind == Action::Kind::feed_hold;
    text += rests ? "|" : std::to_string(std::visit([](const auto& one) { return one.source.line; }, item));
  }
  return text;
}

TEST(LineStops, rest_after_each_line_with_motion) {
  const std::vector<PathItem> items = {of_line(1, 0, 1), of_line(1, 1, 2), of_line(2, 2, 3),
                                       Action{.kind = Action::Kind::outputs, .source = {.line = 3}}, of_line(4, 3, 4)};
  EXPECT_EQ(lines_of(items), "11|2|34");
  EXPECT_EQ(lines_of(items, false), "11234");
}

TEST(LineStops, leave_out_where_the_program_waits_anyway) {
  EXPECT_EQ(
      lines_of({of_line(1, 0, 1), Action{.kind = Action::Kind::program_stop, .source = {.line = 1}}, of_line(2, 1, 2)}),
      "112");
}

TEST(LineStops, are_none_amid_a_thread_and_where_no_hold_is_heeded) {
  const SpindleLock place = SpindleLock::place;
  EXPECT_EQ(lines_of({of_line(1, 0, 1, place), of_line(2, 1, 2, place), of_line(3, 2, 3), of_line(4, 3, 4)}), "123|4");
  Segment deaf = of_line(1, 0, 1);
  deaf.heeds.feed_hold = false;
  EXPECT_EQ(lines_of({deaf, of_line(2, 1, 2), of_line(3, 2, 3)}), "12|3");
}

TEST(LineStops, begin_anew_where_the_path_was_rewound_to) {
  test::ListSource<PathItem> source{{of_line(1, 0, 1), of_line(2, 1, 2), of_line(3, 2, 3)}};
  RewindablePath path(source);
  path.keep();
  LineStops line_stops(path);
  PathItem item;
  while (line_stops.next(item)) continue;
  path.rewind({.item = 1, .s = Mm(0.5)});
  line_stops.stop_at_lines(true);
  ASSERT_TRUE(line_stops.next(item));
  EXPECT_EQ(std::get<Segment>(item).curve.start()[Axis::x], 1.5);
  ASSERT_TRUE(line_stops.next(item));
  EXPECT_EQ(std::get<Action>(item).kind, Action::Kind::feed_hold);
}

}  // namespace
}  // namespace passo
