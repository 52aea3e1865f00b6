// ProgramPath: the path of a program as points, for viewers. It is generated while the program is checked.
//
// The points are stored in chunks. Each chunk has its own bounding box, in which a point has 16 bits per coordinate: 12
// bytes per point in total, with an error of at most 1/131,000 of the box. Point i of a chunk is the end of the motion
// from point i - 1; the first point of a chunk is the last one of the previous chunk. Coarser levels omit points that
// make no visible difference.
//
// Lengths are mm, in machine coordinates of X, Y and Z. Memory is bounded: points beyond `most_points` are omitted.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/geometry/curve.hpp"
#include "passo/interpreter/frame.hpp"
#include "passo/path/segment.hpp"

namespace passo {

class ProgramPath {
 public:
  static constexpr std::size_t chunk_points = 16'384;
  static constexpr std::size_t most_points = 24'000'000;
  static constexpr unsigned levels = 3;  // 0: all points
  static constexpr std::uint16_t flag_rapid = 1;
  // Returns bits 8 to 15 of the flags: the programmed speed, as 16 (log2(mm/s) + 6), 1 to 255; 0: a rapid, or no speed.
  static std::uint16_t speed_flags(MmPerSecond speed);
  // Bits 1 to 7 of the flags: the index of the current tool in tools().
  static constexpr std::size_t most_tools = 128;

  using Coordinates = std::array<double, 3>;
  // In an empty box, low is above high.
  struct Range {
    Coordinates low{1e300, 1e300, 1e300};
    Coordinates high{-1e300, -1e300, -1e300};
    bool empty() const { return low[0] > high[0]; }
    void add(const Coordinates& place);
    double diagonal() const;
  };

  // Adds an item. Arcs become chords that deviate by less than `chord_error`. `frame` is the current work frame.
  void add(const PathItem& item, const Frame& frame = {});
  // Must be called after the last item.
  void finish();

  bool complete() const { return complete_; }
  bool cut_off() const { return cut_off_; }
  std::size_t points() const { return points_; }
  std::size_t chunks() const { return chunks_.size(); }
  const Range& all() const { return all_; }    // machine coordinates
  const Range& cuts() const { return cuts_; }  // range of the feed moves only, machine coordinates
  // The range of programmed speeds of the feed moves. Empty: there is none.
  struct Speeds {
    MmPerSecond low{1e300};
    MmPerSecond high{0};
    bool empty() const { return low > high; }
  };
  const Speeds& speeds() const { return speeds_; }
  struct UsedTool {
    std::int32_t number = 0;  // 0: the program has not loaded a tool
    double zero_z = 0;        // mm: machine Z of the work zero with this tool's length, at its first motion
    bool feeds = false;       // false: the tool makes rapids only
  };
  // The tools in order of their first motion. Tools beyond most_tools count as the last of these.
  const std::vector<UsedTool>& tools() const { return tools_; }
  const Range& work() const { return work_; }  // feed moves only, along the axes of the active work coordinate system
  // The range of all motions, including rapids, on each axis. Empty: nothing moves.
  struct Reach {
    Box machine;
    Box work;  // along the axes of the active work coordinate system
  };
  const std::optional<Reach>& reach() const { return reach_; }
  std::size_t bytes() const { return points_ * (sizeof(Packed) + sizeof(std::uint32_t)); }

  // Returns a chunk in the format of docs/api/openapi.json, little-endian. `chunk` < chunks(), `level` < levels.
  std::string chunk(std::size_t chunk, unsigned level) const;

 private:
  static constexpr double chord_error = 0.005;

  struct Packed {
    std::array<std::uint16_t, 3> place;
    std::uint16_t flags;
  };
  struct Chunk {
    std::array<float, 3> origin;
    std::array<float, 3> step;
    std::vector<Packed> points;
    std::vector<std::uint32_t> lines;
  };
  struct Fresh {
    Coordinates place;
    std::uint32_t line;
    std::uint16_t flags;
  };

  void add_point(const Coordinates& place, std::uint32_t line, std::uint16_t flags);
  void close_chunk();
  void add_reach(const Box& machine, const Box& work);
  std::uint16_t tool_flags(double zero_z, bool feeds);

  std::vector<Chunk> chunks_;
  std::vector<UsedTool> tools_;
  std::int32_t tool_ = 0;     // number of the tool in the spindle; 0: unknown
  std::vector<Fresh> fresh_;  // points of the incomplete chunk
  std::size_t points_ = 0;
  Range all_;
  Range cuts_;
  Range work_;
  std::optional<Reach> reach_;
  Speeds speeds_;
  bool complete_ = false;
  bool cut_off_ = false;
};

}  // namespace passo
