// PathRecorder: records the motion for pictures, in bounded memory.
//
// The path becomes one polyline in machine coordinates, with a speed for each piece. Lines are split where their speed
// changes; arcs and cubics become chords. When the polyline is full, nearly collinear pieces are joined with a
// tolerance, which doubles until there is room again. If even a coarse polyline is too long, e.g. for kilometres of
// path over the same area, evenly spread stretches are omitted. Extents stay exact.
//
// A job of any length takes most_vertices of 20 bytes (2 MB). A line takes about 0.3 µs.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "passo/geometry/curve.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo {

class PathRecorder {
 public:
  static constexpr std::size_t most_vertices = 100'000;

  enum class Kind : std::uint8_t { jump, rapid, feed };  // jump: the polyline is interrupted and restarts here
  // Coordinates are relative to base(), so that single precision suffices for a picture, even if the path is small and
  // far from machine zero.
  struct Vertex {
    float x = 0;
    float y = 0;
    float z = 0;
    float speed = 0;  // mm/s, of the piece that ends here
    Kind kind = Kind::jump;
    std::uint8_t tool = 0;  // index into tools()
    std::uint8_t load = 0;  // utilisation in percent; the value of load_of_next()
  };
  static constexpr double most_load = 2.5;

  // Sets the torque utilisation of the motors from the next move on. 1: all of the guaranteed torque.
  void load_of_next(double load) { load_ = static_cast<std::uint8_t>(100 * std::min(load, most_load)); }

  // `machine_minus_work` is the work offset at this item.
  void watch(const MotionItem& item, const Point& machine_minus_work);

  const std::vector<Vertex>& vertices() const { return vertices_; }
  const Point& base() const { return base_; }
  // Returns true if nothing moved along X, Y or Z. The extents are then undefined.
  bool empty() const { return !any_; }
  const Box& extents() const { return extents_; }  // machine coordinates
  // Returns the extents of the feed moves only; those of all moves if there is no feed move.
  const Box& feed_extents() const { return any_feed_ ? feed_extents_ : extents_; }
  // The tools in use, each once, in order of first use. 0: the tool before the first change. Tools beyond the first
  // most_tools count as the last of these.
  static constexpr std::size_t most_tools = 255;
  const std::vector<std::int32_t>& tools() const { return tools_; }
  // Returns the maximum speed of the feed moves, mm/s. 0 if there were only rapids.
  MmPerSecond fastest_feed() const { return MmPerSecond(fastest_feed_); }
  Seconds time() const { return time_; }
  // Returns the work zeros used while the path moved, each once, in machine coordinates. At most nine (G54…G59.3).
  const std::vector<Point>& origins() const { return origins_; }

 private:
  void change_tool(std::int32_t tool);
  void watch_move(const PlannedMove& move, const Point& origin);
  void record(const PlannedMove& move);
  void record(const PlannedMove& move, const Phase& phase, Mm end);
  void add(const Point& point, double speed, Kind kind);
  void make_room();
  void thin();

  std::vector<Vertex> vertices_;
  Point base_;
  Box extents_;
  bool any_ = false;
  Box feed_extents_;
  bool any_feed_ = false;
  std::vector<std::int32_t> tools_ = {0};
  std::uint8_t tool_ = 0;
  std::uint8_t load_ = 0;
  double fastest_feed_ = 0;
  Seconds time_{0};
  std::vector<Point> origins_;

  double tolerance_ = 0;  // mm, current tolerance of the joining; 0: nothing has been joined yet
  // One in this many stretches of moves is kept, the others are omitted.
  std::uint64_t keep_one_of_ = 1;
  std::uint64_t moves_ = 0;
};

}  // namespace passo
