#include "passo/cam/route.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "../piece_order.hpp"
#include "../place_tree.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

DrawnPoint at_mm(int x, int y) {
  return {Nanometres{x * 1'000'000LL}, Nanometres{y * 1'000'000LL}};
}
std::vector<DrawnPoint> scattered(std::size_t count, unsigned seed) {
  std::mt19937_64 random(seed);
  std::vector<DrawnPoint> places;
  for (std::size_t i = 0; i < count; ++i) {
    places.push_back({Nanometres{static_cast<std::int64_t>(random() % 100'000'000)},
                      Nanometres{static_cast<std::int64_t>(random() % 100'000'000)}});
  }
  return places;
}
bool holds_each_once(std::vector<std::uint32_t> order, std::size_t count) {
  std::ranges::sort(order);
  std::vector<std::uint32_t> all(count);
  std::iota(all.begin(), all.end(), 0U);
  return order == all;
}

// Places on a coarse grid: many lie as far as a split of the tree, and many are equal.
TEST(PlaceTree, finds_the_nearest_places_wherever_they_lie) {
  std::mt19937_64 random(11);
  for (std::size_t count = 2; count < 200; count += 7) {
    std::vector<DrawnPoint> places;
    for (std::size_t i = 0; i < count; ++i) {
      places.push_back(at_mm(static_cast<int>(random() % 12), static_cast<int>(random() % 5)));
    }
    PlaceTree tree(places);
    std::vector<std::uint32_t> found;
    for (std::uint32_t index = 0; index < count; ++index) {
      const std::size_t wanted = std::min<std::size_t>(8, count - 1);
      tree.nearest(index, wanted, found);
      ASSERT_EQ(found.size(), wanted);
      std::vector<double> distances;
      for (std::uint32_t other = 0; other < count; ++other) {
        if (other != index) distances.push_back(distance_nm(places[index], places[other]));
      }
      std::ranges::sort(distances);
      for (std::size_t i = 0; i < wanted; ++i) EXPECT_EQ(distance_nm(places[index], places[found[i]]), distances[i]);
    }
  }
}

TEST(Route, holds_each_place_once) {
  for (std::size_t count = 0; count < 40; ++count) {
    const std::vector<DrawnPoint> places = scattered(count, static_cast<unsigned>(count));
    for (const std::uint64_t steps : {0ULL, 50ULL, 5000ULL}) {
      EXPECT_TRUE(holds_each_once(shorten_route(places, {}, at_mm(50, 0), steps), count)) << count << " " << steps;
    }
  }
}

// All orders tried out: with few places the route is the best there is.
TEST(Route, is_the_shortest_of_all_for_few_places) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    const std::size_t count = 1 + seed % 7;
    const std::vector<DrawnPoint> places = scattered(count, 1000 + seed);
    const DrawnPoint start = at_mm(0, 0);
    // One in four may end anywhere.
    const auto end = seed % 4 == 3 ? std::nullopt : std::optional(at_mm(static_cast<int>(seed % 3) * 40, 10));
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0U);
    double best = 1e300;
    do best = std::min(best, route_length(places, order, start, end));
    while (std::ranges::next_permutation(order).found);
    const double found =
        route_length(places, shorten_route(places, start, end, enough_steps(count, 20'000)), start, end);
    EXPECT_LE(found, best * 1.0000001 + 1) << "seed " << seed << ", " << count << " places";
  }
}

TEST(Route, of_few_places_gets_no_shorter_by_more_steps) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const std::size_t count = 10 + 5 * seed;
    const std::vector<DrawnPoint> places = scattered(count, 2000 + seed);
    const auto found = [&](std::uint64_t steps) {
      return route_length(places, shorten_route(places, {}, DrawnPoint{}, steps), {}, DrawnPoint{});
    };
    EXPECT_LE(found(enough_steps(count, 20'000)), found(20'000 * count) * 1.001) << count << " places";
  }
}

TEST(Route, a_grid_is_walked_without_a_detour) {
  std::vector<DrawnPoint> places;
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 30; ++x) places.push_back(at_mm(10 + (x * 7) % 30, 10 + (y * 3) % 20));
  }
  const double found =
      route_length(places, shorten_route(places, {}, DrawnPoint{}, 20'000'000), {}, DrawnPoint{}) / 1e6;
  // 599 ways of 1 mm, one from (0, 0) to (10, 10) and one back from beside it.
  EXPECT_LT(found, (599 + 2 * 14.9) * 1.02);
}

// Of scattered places the best tour is about 0.7124 √(n A) long (Beardwood, Halton, Hammersley).
TEST(Route, of_scattered_places_is_near_the_known_constant) {
  const std::size_t count = 2000;
  const std::vector<DrawnPoint> places = scattered(count, 7);
  const double found =
      route_length(places, shorten_route(places, {}, DrawnPoint{}, 10'000'000), {}, DrawnPoint{}) / 1e6;
  const double constant = 0.7124 * std::sqrt(static_cast<double>(count) * 100 * 100) * (1 + 0.33 / 44);
  EXPECT_LT(found, constant * 1.07);
}

TEST(Route, is_the_same_each_time_and_takes_equal_places) {
  const std::vector<DrawnPoint> places = scattered(300, 3);
  EXPECT_EQ(shorten_route(places, {}, DrawnPoint{}, 100'000), shorten_route(places, {}, DrawnPoint{}, 100'000));
  EXPECT_TRUE(holds_each_once(shorten_route(std::vector<DrawnPoint>(500), {}, DrawnPoint{}, 100'000), 500));
}

double length_of(const std::vector<RoutePiece>& pieces, const std::vector<PlacedPiece>& order, DrawnPoint park) {
  double length = 0;
  DrawnPoint at = park;
  for (const PlacedPiece& placed : order) {
    const RoutePiece& piece = pieces[placed.piece];
    length += distance_nm(at, placed.is_turned ? piece.end : piece.start);
    at = placed.is_turned ? piece.start : piece.end;
  }
  return length + distance_nm(at, park);
}

// The shortest of all orders and directions.
double shortest_of(const std::vector<RoutePiece>& pieces, DrawnPoint park) {
  std::vector<std::uint32_t> order(pieces.size());
  std::iota(order.begin(), order.end(), 0U);
  double best = 1e300;
  do {
    for (unsigned turns = 0; turns < 1U << pieces.size(); ++turns) {
      std::vector<PlacedPiece> placed;
      bool is_allowed = true;
      for (const std::uint32_t index : order) {
        const bool is_turned = (turns >> index & 1U) != 0;
        is_allowed = is_allowed && (!is_turned || pieces[index].may_be_turned);
        placed.push_back({index, is_turned});
      }
      if (is_allowed) best = std::min(best, length_of(pieces, placed, park));
    }
  } while (std::ranges::next_permutation(order).found);
  return best;
}

TEST(PieceOrder, is_near_the_shortest_of_all_orders_and_turns_no_piece_that_must_not_be) {
  const DrawnPoint park = at_mm(0, 0);
  double all = 0;
  double best = 0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const std::vector<DrawnPoint> places = scattered(10, seed);
    std::vector<RoutePiece> pieces;
    for (std::size_t i = 0; i < 5; ++i) pieces.push_back({places[2 * i], places[2 * i + 1], i % 2 == 0});
    const std::vector<PlacedPiece> order = shorten_piece_order(pieces, park, park, 100'000);
    std::vector<bool> is_there(pieces.size());
    for (const PlacedPiece& placed : order) {
      is_there[placed.piece] = true;
      EXPECT_TRUE(!placed.is_turned || pieces[placed.piece].may_be_turned);
    }
    EXPECT_EQ(std::ranges::count(is_there, true), 5);
    all += length_of(pieces, order, park);
    best += shortest_of(pieces, park);
  }
  EXPECT_GE(all, best * 0.9999);
  EXPECT_LE(all, best * 1.05);
}

TEST(PieceOrder, without_steps_the_given_order_stays) {
  const std::vector<RoutePiece> pieces = {{at_mm(9, 0), at_mm(8, 0)}, {at_mm(1, 0), at_mm(2, 0)}};
  const std::vector<PlacedPiece> order = shorten_piece_order(pieces, at_mm(0, 0), at_mm(0, 0), 0);
  ASSERT_EQ(order.size(), 2U);
  EXPECT_EQ(order[0].piece, 0U);
  EXPECT_TRUE(shorten_piece_order({}, {}, {}, 100).empty());
}

}  // namespace
}  // namespace passo
