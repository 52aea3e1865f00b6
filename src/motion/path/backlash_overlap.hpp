// BacklashOverlap: takes up backlash in motion instead of at a stop, where the path continues smoothly at the reversal.
//
// On a window of the path around the turning point, a BacklashRamp is added to the position of the motor: the window
// becomes cubics of s, which give the position of the motor for this axis. The planner keeps the motor within the
// limits of the axis, and a hold or an emergency brake stops on these cubics as on any other segment.
//
// The axis rises with the motor until the motor reverses, and stands still until the motor has passed the backlash and
// reaches the other flank of the screw. Then it falls with the motor. The window begins and ends where the path is a
// certain depth below the extreme value of the axis. If this depth is the permitted deviation e, the axis stays in this
// range, so it deviates from the path by less than e, however the motor moves. A ramp rises slowly at its ends, so a
// greater depth is possible. The best depth is the greatest one with which the axis, computed as above, stays within e,
// because a long window needs the least acceleration.
//
// Where there is no such window, because the path stops there, has no tolerance, or two axes reverse together, the
// segment that takes up the backlash at a stop remains. Private to path/.
#pragma once

#include <deque>
#include <vector>

#include "backlash_ramp.hpp"

#include "passo/path/backlash_compensator.hpp"

namespace passo {

class BacklashOverlap final : public Source<PathItem> {
 public:
  // `path`: as BacklashStops returns it.
  BacklashOverlap(Source<PathItem>& path, const BacklashOptions& options) : path_(path), options_(options) {}

  [[nodiscard]] bool next(PathItem& item) override;

 private:
  // A piece of the path around a reversal, from s = 0 on.
  struct Run {
    std::vector<Segment> segments;
    std::vector<double> starts;  // s of each segment, and the end
    double turn = 0;             // s of the reversal
    double last_end = 0;         // s where the window ends at the latest

    double length() const { return starts.back(); }
    double at(double s, Axis axis) const;
    std::size_t segment_at(double s) const;
  };
  struct Reversal {
    Axis axis = Axis::x;
    double lead = 0;  // of the motor at the start of the window
    double extreme = 0;
    double room = 0;  // the permitted deviation
    double reach = 0;
    bool on_arcs = false;
    AxisSet downs;
  };
  struct Window {
    double begin = 0;
    double end = 0;
    double turn = 0;  // s of the reversal

    // One of the positions from the beginning (number 0) to the end, half of them on each side of the reversal.
    double look(int number, int count) const;
  };

  bool read(PathItem& item);
  void keep(const Segment& segment);
  void release_all();
  void take_up(const Segment& at_stop);
  bool overlap(const Segment& at_stop);
  bool find_reversal(const Segment& at_stop, Reversal& reversal);
  void read_ahead(const Reversal& reversal);
  double room_on(const Segment& segment, Axis axis, bool on_arcs) const;
  bool is_usable(const Segment& segment, const Reversal& reversal) const;
  Run run_around(const Reversal& reversal) const;
  static Window window_of(const Run& run, const Reversal& reversal, double depth);
  // The deviation of the axis from the path: the greatest one, and the one at the end of the window.
  struct AxisWay {
    double deviation = 0;
    double at_end = 0;
  };
  static AxisWay way_on(const Run& run, const Window& window, const BacklashRamp& ramp, const Reversal& reversal);
  BacklashRamp best_ramp(const Run& run, const Window& window, const Reversal& reversal) const;
  void rewrite(Run& run, const Window& window, const BacklashRamp& ramp, const Reversal& reversal);
  void add_piece(const Segment& whole, double start, double from, double to, const BacklashRamp& ramp,
                 const Reversal& reversal);

  Source<PathItem>& path_;
  BacklashOptions options_;
  std::deque<Segment> behind_;  // the last segments of a smooth path: a window may begin on them
  std::deque<PathItem> ahead_;  // items that were read too early
  std::deque<PathItem> ready_;
};

}  // namespace passo
