#include "passo/api/program_path.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "passo/geometry/vector3.hpp"
#include "passo/interpreter/used_tools.hpp"
#include "passo/path/hand_tool_change.hpp"

namespace passo {
namespace {

constexpr double most_places = 65'535;
constexpr int most_chords = 720;  // of one arc
constexpr int spline_chords = 24;
// Of the diagonal of the program's box: how far a level may be from the path.
constexpr std::array<double, ProgramPath::levels> far_off = {0, 1.0 / 4000, 1.0 / 800};
// A change of the programmed speed that a level keeps: half an octave.
constexpr int notable_speed = 8;
constexpr std::uint32_t magic = 0x50534150;  // "PASP"

static_assert(std::endian::native == std::endian::little, "chunks are written as they lie in memory");

ProgramPath::Coordinates place_of(const Point& point) {
  return {point[Axis::x], point[Axis::y], point[Axis::z]};
}

// Into how many chords a curve is divided.
int chords_of(const Curve& curve, double chord_error) {
  if (curve.shape() == Curve::Shape::line) return 1;
  if (curve.shape() == Curve::Shape::cubic) return spline_chords;
  const Curve::ArcData& arc = curve.arc_data();
  const double radius = std::max({arc.start_radius, arc.end_radius, chord_error});
  const double turn = 2 * std::acos(1 - chord_error / radius);
  return std::clamp(static_cast<int>(std::ceil(std::abs(arc.sweep) / turn)), 1, most_chords);
}

template <class Value>
void append(std::string& bytes, const Value& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class Value>
void append_all(std::string& bytes, const std::vector<Value>& values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value));
}

bool are_alike(std::uint16_t a, std::uint16_t b) {
  return (a & 0xffU) == (b & 0xffU) && std::abs(int(a >> 8U) - int(b >> 8U)) < notable_speed;
}

// The directions from a place in which a chord passes all points so far at no more than the tolerance: a cone. It is
// never too wide: of two cones that overlap it takes the widest cone that lies in both.
class ChordSleeve {
 public:
  ChordSleeve(const Vector3& from, double tolerance) : from_(from), tolerance_(tolerance) {}

  // False: the chord to this point leaves out too much. Then the sleeve is spent.
  bool takes(const Vector3& to) {
    const Vector3 way = to - from_;
    const double far = length(way);
    if (far < farthest_ - tolerance_) return false;  // it turns back
    farthest_ = std::max(farthest_, far);
    if (far <= tolerance_) return true;
    const Vector3 towards = way * (1 / far);
    const double own = std::asin(tolerance_ / far);
    if (half_ < 0) {
      axis_ = towards;
      half_ = own;
      return true;
    }
    const double apart = std::acos(std::clamp(dot(axis_, towards), -1.0, 1.0));
    if (apart > half_) return false;
    narrow(towards, own, apart);
    return true;
  }

 private:
  void narrow(const Vector3& towards, double own, double apart) {
    if (apart + half_ <= own) return;
    if (apart + own <= half_) {
      axis_ = towards;
      half_ = own;
      return;
    }
    const double half = (half_ + own - apart) / 2;
    const double turn = half_ - half;  // from the old axis towards the new one
    const double side = std::sin(apart);
    axis_ = axis_ * (std::sin(apart - turn) / side) + towards * (std::sin(turn) / side);
    half_ = half;
  }

  Vector3 from_;
  double tolerance_;
  double farthest_ = 0;
  Vector3 axis_{};
  double half_ = -1;  // of the cone's angle; below 0: each direction will do
};

}  // namespace

void ProgramPath::Range::add(const Coordinates& place) {
  for (std::size_t i = 0; i < place.size(); ++i) {
    low[i] = std::min(low[i], place[i]);
    high[i] = std::max(high[i], place[i]);
  }
}

double ProgramPath::Range::diagonal() const {
  return empty() ? 0 : std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
}

std::uint16_t ProgramPath::speed_flags(MmPerSecond speed) {
  if (!(speed.value() > 0) || !std::isfinite(speed.value())) return 0;
  const double code = std::clamp(std::round(16 * (std::log2(speed.value()) + 6)), 1.0, 255.0);
  return static_cast<std::uint16_t>(static_cast<unsigned>(code) << 8U);
}

void ProgramPath::add(const PathItem& item, const Frame& frame) {
  const auto* const action = std::get_if<Action>(&item);
  if (action != nullptr && changes_tool(*action)) tool_ = action->tool;
  const auto* const segment = std::get_if<Segment>(&item);
  if (segment == nullptr || segment->takes_up_backlash || !segment->curve.has_length()) return;
  const Box box = frame.work_extents(segment->curve);
  add_reach(segment->curve.extents(), box);
  const int chords = chords_of(segment->curve, chord_error);
  if (points_ + static_cast<std::size_t>(chords) > most_points) {
    cut_off_ = true;
    return;
  }
  const std::uint32_t line = segment->source.line;
  const std::uint16_t speed = segment->rapid ? flag_rapid : speed_flags(segment->speed);
  const auto flags = static_cast<std::uint16_t>(speed | tool_flags(segment->work_zero[Axis::z], !segment->rapid));
  if (speed > flag_rapid) {
    speeds_.low = std::min(speeds_.low, segment->speed);
    speeds_.high = std::max(speeds_.high, segment->speed);
  }
  const auto note = [&](const Coordinates& place) {
    all_.add(place);
    if (!segment->rapid) cuts_.add(place);
  };
  if (!segment->rapid) {
    work_.add(place_of(box.low));
    work_.add(place_of(box.high));
  }
  const Coordinates start = place_of(segment->curve.start());
  if (points_ == 0) add_point(start, line, flags);
  note(start);
  for (int i = 1; i <= chords; ++i) {
    const Mm way = segment->curve.length() * (double(i) / chords);
    const Coordinates place = place_of(i == chords ? segment->curve.end() : segment->curve.at(way));
    note(place);
    add_point(place, line, flags);
  }
}

void ProgramPath::add_reach(const Box& machine, const Box& work) {
  const auto widen = [](Box& box, const Box& by) {
    for (std::size_t i = 0; i < axis_count; ++i) {
      box.low.values[i] = std::min(box.low.values[i], by.low.values[i]);
      box.high.values[i] = std::max(box.high.values[i], by.high.values[i]);
    }
  };
  if (!reach_) reach_ = Reach{.machine = machine, .work = work};
  widen(reach_->machine, machine);
  widen(reach_->work, work);
}

std::uint16_t ProgramPath::tool_flags(double zero_z, bool feeds) {
  const auto fresh = [&] { return UsedTool{tool_, zero_z}; };
  const std::size_t index = index_of_tool(tools_, tool_, &UsedTool::number, most_tools, fresh);
  tools_[index].feeds |= feeds;
  return static_cast<std::uint16_t>(index << 1U);
}

void ProgramPath::finish() {
  if (fresh_.size() > 1) close_chunk();
  fresh_.clear();
  fresh_.shrink_to_fit();
  complete_ = true;
}

void ProgramPath::add_point(const Coordinates& place, std::uint32_t line, std::uint16_t flags) {
  fresh_.push_back({.place = place, .line = line, .flags = flags});
  ++points_;
  if (fresh_.size() < chunk_points) return;
  close_chunk();
  fresh_ = {Fresh{.place = place, .line = line, .flags = flags}};
}

void ProgramPath::close_chunk() {
  Range range;
  for (const Fresh& one : fresh_) range.add(one.place);
  Chunk chunk{};
  for (std::size_t i = 0; i < 3; ++i) {
    chunk.origin[i] = static_cast<float>(range.low[i]);
    chunk.step[i] = static_cast<float>((range.high[i] - range.low[i]) / most_places);
  }
  chunk.points.reserve(fresh_.size());
  chunk.lines.reserve(fresh_.size());
  for (const Fresh& one : fresh_) {
    Packed packed{.place = {}, .flags = one.flags};
    for (std::size_t i = 0; i < 3; ++i) {
      const double span = range.high[i] - range.low[i];
      const double share = span > 0 ? (one.place[i] - range.low[i]) / span : 0;
      packed.place[i] = static_cast<std::uint16_t>(std::lround(share * most_places));
    }
    chunk.points.push_back(packed);
    chunk.lines.push_back(one.line);
  }
  chunks_.push_back(std::move(chunk));
}

// A coarser level leaves out points from which the chord over them is nearer than the level may be off. It keeps each
// change between rapid and feed, and each notable change of speed.
std::string ProgramPath::chunk(std::size_t index, unsigned level) const {
  const Chunk& all = chunks_.at(index);
  const double tolerance = all_.diagonal() * far_off.at(level);
  std::vector<Packed> points;
  std::vector<std::uint32_t> lines;
  const auto keep = [&](std::size_t i) {
    points.push_back(all.points[i]);
    lines.push_back(all.lines[i]);
  };
  const auto place = [&](std::size_t i) {
    const auto along = [&](std::size_t k) { return double(all.points[i].place[k]) * double(all.step[k]); };
    return Vector3{along(0), along(1), along(2)};
  };
  keep(0);
  ChordSleeve sleeve(place(0), tolerance);
  std::uint16_t flags = all.points.size() > 1 ? all.points[1].flags : std::uint16_t{0};
  for (std::size_t i = 1; i < all.points.size(); ++i) {
    const bool goes_on = tolerance > 0 && are_alike(all.points[i].flags, flags) && sleeve.takes(place(i));
    if (goes_on) continue;
    if (i > 1) keep(i - 1);
    flags = all.points[i].flags;
    sleeve = ChordSleeve(place(i - 1), tolerance);
    static_cast<void>(sleeve.takes(place(i)));
  }
  if (all.points.size() > 1) keep(all.points.size() - 1);
  std::string bytes;
  bytes.reserve(40 + points.size() * (sizeof(Packed) + sizeof(std::uint32_t)));
  append(bytes, magic);
  append(bytes, static_cast<std::uint32_t>(points.size()));
  append(bytes, static_cast<std::uint32_t>(index));
  append(bytes, static_cast<std::uint32_t>(level));
  append(bytes, all.origin);
  append(bytes, all.step);
  append_all(bytes, points);
  append_all(bytes, lines);
  return bytes;
}

}  // namespace passo
