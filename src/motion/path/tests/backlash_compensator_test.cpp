#include "passo/path/backlash_compensator.hpp"

#include <numbers>
#include <string>
#include <vector>

#include "kit/list_source.hpp"
#include <gtest/gtest.h>

#include "passo/path/path_text.hpp"

namespace passo {
namespace {

Point at(double x, double y) {
  Point point;
  point[Axis::x] = x;
  point[Axis::y] = y;
  return point;
}

Segment line(const Point& from, const Point& to) {
  return {.curve = Curve::line(from, to), .speed = MmPerSecond(10)};
}

Segment circle() {
  return {.curve = Curve::arc(at(5, 0), at(5, 0), Axis::x, Axis::y, 0, 0, 2 * std::numbers::pi),
          .speed = MmPerSecond(10)};
}

BacklashOptions xy_backlash(const Point& start) {
  BacklashOptions options{.start = start, .backlash = {}, .least = {}, .downs = {}};
  for (const Axis axis : {Axis::x, Axis::y}) {
    options.backlash[axis] = 0.15;
    options.least[axis] = 0.001;
  }
  return options;
}

std::vector<Segment> segments_of(std::vector<PathItem> path, const BacklashOptions& options) {
  test::ListSource<PathItem> source(std::move(path));
  BacklashCompensator taker(source, options);
  std::vector<Segment> all;
  for (PathItem item; taker.next(item);) {
    if (const auto* segment = std::get_if<Segment>(&item)) all.push_back(*segment);
  }
  return all;
}

// One letter for each segment: p: a piece of the path, x, y: an axis takes up its backlash; b: both do. A capital
// letter: for motion up.
std::string shape_of(const std::vector<Segment>& segments) {
  std::string shape;
  for (const Segment& one : segments) {
    const bool x = one.curve.start()[Axis::x] != one.curve.end()[Axis::x];
    const bool y = one.curve.start()[Axis::y] != one.curve.end()[Axis::y];
    if (!one.takes_up_backlash) {
      shape += 'p';
    } else if (x && y) {
      shape += 'b';
    } else if (x) {
      shape += one.downs.has(Axis::x) ? 'x' : 'X';
    } else {
      shape += one.downs.has(Axis::y) ? 'y' : 'Y';
    }
  }
  return shape;
}

TEST(BacklashCompensator, without_backlash_all_passes_unchanged) {
  const auto all = segments_of({line(at(0, 0), at(5, 0)), line(at(5, 0), at(0, 0)), circle()}, {});
  EXPECT_EQ(shape_of(all), "ppp");
  EXPECT_EQ(all[0].mode, PathMode::continuous);
}

TEST(BacklashCompensator, a_circle_rests_at_each_quadrant_and_nowhere_else) {
  const auto all = segments_of({circle()}, xy_backlash(at(5, 0)));
  EXPECT_EQ(shape_of(all), "xpypXpYp");
  EXPECT_NEAR(all[1].curve.end()[Axis::y], 5, 1e-9);
  EXPECT_EQ(all[1].mode, PathMode::exact_stop);
  EXPECT_EQ(all[2].curve.end(), all[1].curve.end()) << "the tool stands";
  EXPECT_NEAR(all[2].curve.start()[Axis::y], 5.15, 1e-9);
  EXPECT_EQ(all[3].curve.start(), all[1].curve.end());
  EXPECT_TRUE(all[3].downs.has(Axis::x) && all[3].downs.has(Axis::y));
  EXPECT_EQ(all.back().curve.end(), at(5, 0));
  EXPECT_TRUE(all.back().downs.empty());
}

TEST(BacklashCompensator, axes_that_turn_back_together_take_up_together_and_the_path_ends_with_all_up) {
  const auto all = segments_of({line(at(0, 0), at(3, 3)), line(at(3, 3), at(1, 1))}, xy_backlash({}));
  EXPECT_EQ(shape_of(all), "pbpb");
  EXPECT_TRUE(all[1].downs.has(Axis::x) && all[1].downs.has(Axis::y));
  EXPECT_TRUE(all[3].downs.empty());
  EXPECT_EQ(all[3].curve.end(), at(1, 1));
}

TEST(BacklashCompensator, an_axis_that_goes_back_by_a_hair_has_not_turned_back) {
  const auto all = segments_of(
      {line(at(0, 0), at(3, 0)), line(at(3, 0), at(2.9995, 1)), line(at(2.9995, 1), at(2.9985, 2))}, xy_backlash({}));
  EXPECT_EQ(shape_of(all), "ppxpX") << "but two hairs are too much";
}

TEST(BacklashCompensator, the_number_of_items_does_not_depend_on_where_the_backlash_was_if_items_are_counted) {
  for (const bool down : {false, true}) {
    BacklashOptions options = xy_backlash({});
    options.counts_items = true;
    if (down) options.downs.add(Axis::x);
    test::ListSource<PathItem> source({line(at(0, 0), at(-3, 0))});
    BacklashCompensator taker(source, options);
    int items = 0;
    for (PathItem item; taker.next(item);) ++items;
    EXPECT_EQ(items, 4) << "the start, down, the line, up";
  }
}

TEST(BacklashCompensator, after_a_probe_move_it_asks_where_the_machine_rests) {
  test::ListSource<PathItem> source(
      {line(at(0, 0), at(3, 0)), line(at(3, 0), at(-3, 0)), Action{.kind = Action::Kind::probe_end}});
  BacklashCompensator taker(source, xy_backlash({}));
  taker.ask_after_probe([] {
    BacklashAtRest rest{.downs = {}, .place = at(2, 0)};
    rest.downs.add(Axis::x);
    return rest;
  });
  PathItem item;
  while (taker.next(item) && std::holds_alternative<Segment>(item)) {
  }
  ASSERT_TRUE(taker.next(item));
  EXPECT_EQ(std::get<Segment>(item).curve.end(), at(2, 0)) << "the move had ended at a contact";
  EXPECT_FALSE(taker.next(item));
}

TEST(BacklashCompensator, the_backlash_is_taken_up_before_the_index_is_awaited) {
  test::ListSource<PathItem> source(
      {line(at(0, 0), at(3, 0)), Action{.kind = Action::Kind::await_index}, line(at(3, 0), at(-3, 0))});
  BacklashCompensator taker(source, xy_backlash({}));
  std::string order;
  for (PathItem item; taker.next(item);) {
    const auto* segment = std::get_if<Segment>(&item);
    order += segment == nullptr ? 'i' : segment->takes_up_backlash ? 'x' : 'p';
  }
  EXPECT_EQ(order, "pxipx");
}

}  // namespace
}  // namespace passo
