#include "gerber_plotter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace passo {
namespace {

using std::numbers::pi;
constexpr std::size_t most_frames = 32;
constexpr std::size_t longest_swept = 64;  // points; a longer stroke is drawn in pieces

double sweep_between(double from, double to, bool counterclockwise) {
  double sweep = counterclockwise ? to - from : from - to;
  while (sweep < 0) sweep += 2 * pi;
  while (sweep > 2 * pi) sweep -= 2 * pi;
  return counterclockwise ? sweep : -sweep;
}

double angle_at(DrawnPoint point, Offset centre) {
  return std::atan2(static_cast<double>(point.y.count) - centre.y, static_cast<double>(point.x.count) - centre.x);
}

double radius_at(DrawnPoint point, Offset centre) {
  return std::hypot(static_cast<double>(point.x.count) - centre.x, static_cast<double>(point.y.count) - centre.y);
}

// Single quadrant mode: I and J have no signs. Of the centres that make the arc turn by a right angle at most, the one
// that is as far from both ends.
bool find_quarter(DrawnPoint from, DrawnPoint to, Offset ij, bool counterclockwise, GerberArc& arc) {
  double best = 1e300;
  for (const double across : {1.0, -1.0}) {
    for (const double up : {1.0, -1.0}) {
      const Offset start = offset_of(from);
      const Offset centre{start.x + across * std::abs(ij.x), start.y + up * std::abs(ij.y)};
      const double sweep = sweep_between(angle_at(from, centre), angle_at(to, centre), counterclockwise);
      const double off = std::abs(radius_at(from, centre) - radius_at(to, centre));
      if (std::abs(sweep) > pi / 2 * 1.01 || off >= best) continue;
      best = off;
      arc = {from, to, centre, sweep};
    }
  }
  return best < 1e300;
}

}  // namespace

void measure(const Region& shape, GerberAperture& aperture) {
  const std::optional<DrawnBox> box = bounds(shape);
  if (!box) return;
  aperture.across = box->most.x - box->least.x;
  aperture.up = box->most.y - box->least.y;
}

bool GerberPlotter::has_room_for(std::size_t points) {
  if (is_full_) return false;
  if (points <= most_points_ - points_) {
    points_ += points;
    return true;
  }
  is_full_ = true;
  return findings_.refuse(0, 0, "gerber.too-large", fmt::format("the image has more than {} points", most_points_),
                          "a smaller layer, or fewer repeats");
}

bool GerberPlotter::can_unite(const std::vector<DrawnRing>& rings) {
  if (is_full_) return false;
  if (budget_.affords(rings)) return true;
  is_full_ = true;
  return findings_.refuse(0, 0, "gerber.too-large", "the lines cross too often to be merged", "fewer lines");
}

void GerberPlotter::set_dark(bool is_dark) {
  if (is_dark != is_dark_) finish_stroke();
  is_dark_ = is_dark;
}

void GerberPlotter::set_modal(const GerberPlacement& modal) {
  finish_stroke();
  modal_ = modal;
  tool_is_new_ = true;
}

void GerberPlotter::define(std::uint32_t code, PlotterAperture aperture) {
  finish_stroke();
  if (apertures_.contains(code))
    findings_.note(fmt::format("aperture D{} is defined twice; the last definition is used", code));
  apertures_.insert_or_assign(code, std::move(aperture));
  tool_is_new_ = true;
}

void GerberPlotter::select(std::uint32_t code) {
  finish_stroke();
  code_ = code;
  tool_is_new_ = true;
}

const PlotterAperture* GerberPlotter::aperture() {
  const auto found = apertures_.find(code_);
  if (found != apertures_.end()) return &found->second;
  if (code_ == 0) {
    findings_.refuse_once("gerber.no-aperture", "this draws without a selected aperture",
                          "D10 or another aperture first");
  } else {
    findings_.refuse_once(
        "gerber.no-aperture", fmt::format("aperture D{} is not defined", code_),
        apertures_.empty()
            ? "a definition such as %ADD10C,0.5*%; RS-274-D, with apertures in a separate file, is not supported"
            : "an aperture defined before by %AD...");
  }
  return nullptr;
}

const GerberPlotter::Tool& GerberPlotter::tool() {
  const auto found = apertures_.find(code_);
  if (!tool_is_new_ || found == apertures_.end()) return tool_;
  tool_is_new_ = false;
  const PlotterAperture& source = found->second;
  tool_ = {.is_round = source.is_round,
           .diameter = source.diameter * modal_.scale,
           .shape = modal_.only_moves() ? source.shape : modal_.placed(source.shape),
           .hull = {}};
  tool_.hull = tool_.is_round ? disc_ring({}, tool_.diameter) : hull_of(tool_.shape.rings);
  return tool_;
}

void GerberPlotter::move_to(DrawnPoint place) {
  if (in_region_) {
    finish_contour();
  } else {
    finish_stroke();
  }
  at_ = place;
}

bool GerberPlotter::find_arc(DrawnPoint to, const ArcWords& words, GerberArc& arc) {
  if (interpolation == Interpolation::linear) return false;
  if (!words.has_any || (words.ij.x == 0 && words.ij.y == 0)) {
    if (at_ != to) findings_.note("an arc without a centre is drawn as a line");
    return false;
  }
  if (quadrants == Quadrants::unknown) {
    quadrants = words.ij.x < 0 || words.ij.y < 0 ? Quadrants::multi : Quadrants::single;
    findings_.note(fmt::format("the file has arcs, but neither G74 nor G75; {} is assumed",
                               quadrants == Quadrants::multi ? "G75, because I or J is negative" : "G74"));
  }
  const bool counterclockwise = interpolation == Interpolation::counterclockwise;
  if (quadrants == Quadrants::single) {
    if (find_quarter(at_, to, words.ij, counterclockwise, arc)) return arc.sweep != 0;
    return findings_.refuse(0, 0, "gerber.bad-arc", "no arc of up to 90 degrees joins these points",
                            "I and J of the arc's centre, or G75 first");
  }
  const Offset start = offset_of(at_);
  arc = {at_, to, {start.x + words.ij.x, start.y + words.ij.y}, 0};
  const double angle = angle_at(at_, arc.centre);
  arc.sweep = at_ == to ? (counterclockwise ? 2 * pi : -2 * pi)
                        : sweep_between(angle, angle_at(to, arc.centre), counterclockwise);
  const double off = std::abs(radius_at(at_, arc.centre) - radius_at(to, arc.centre));
  constexpr double noticed = 10'000;  // nm: more than coordinates are rounded
  if (off > noticed)
    findings_.note("the ends of an arc have different distances from its centre; the radius is interpolated");
  return true;
}

// Arcs of more than half a turn are two arcs: a bulge of a whole turn is infinite.
void GerberPlotter::add_to_path(const GerberArc* arc, DrawnPoint to) {
  if (arc != nullptr && std::abs(arc->sweep) > pi) {
    const Offset spoke = turned(
        Offset{static_cast<double>(at_.x.count) - arc->centre.x, static_cast<double>(at_.y.count) - arc->centre.y},
        arc->sweep / 2);
    path_.points.back().bulge = std::tan(arc->sweep / 8);
    path_.points.push_back({rounded({arc->centre.x + spoke.x, arc->centre.y + spoke.y}), std::tan(arc->sweep / 8)});
  } else if (arc != nullptr) {
    path_.points.back().bulge = std::tan(arc->sweep / 4);
  }
  path_.points.push_back({to});
}

void GerberPlotter::draw_to(DrawnPoint place, const ArcWords& words) {
  const PlotterAperture* const source = in_region_ ? nullptr : aperture();
  if (!in_region_ && source == nullptr) {
    at_ = place;
    return;
  }
  if (source != nullptr && source->block) {
    findings_.refuse(0, 0, "gerber.bad-stroke", "an aperture block cannot draw a line", "D03, a flash");
    return;
  }
  GerberArc arc;
  const bool is_arc = find_arc(place, words, arc);
  const std::size_t chords =
      is_arc ? chords_of_arc(std::max(radius_at(arc.from, arc.centre), radius_at(arc.to, arc.centre)), arc.sweep) : 1;
  const std::size_t points_of_end = in_region_ ? 1 : tool().hull.size() + 4;
  if (!has_room_for(chords * points_of_end + 4)) return;
  if (way_.empty()) {
    way_ = {at_};
    path_ = {.points = {{at_}}, .is_closed = false, .width = {}, .layer = 0, .line = findings_.command.line};
  }
  if (is_arc) {
    append_arc(arc, way_);
  } else {
    way_.push_back(place);
  }
  if (!in_region_) add_to_path(is_arc ? &arc : nullptr, place);
  at_ = place;
}

void GerberPlotter::draw_way(std::size_t first, std::size_t last) {
  const Tool& with = tool();
  if (with.is_round && last - first >= 2) {
    const std::vector<DrawnPoint> piece(way_.begin() + static_cast<std::ptrdiff_t>(first),
                                        way_.begin() + static_cast<std::ptrdiff_t>(last) + 1);
    image().add(swept({piece}, Nanometres{std::llround(with.diameter / 2)}, gerber_tolerance), is_dark_);
    return;
  }
  for (std::size_t i = first; i < last; ++i) image().add({{convex_swept(with.hull, way_[i], way_[i + 1])}}, is_dark_);
}

void GerberPlotter::keep_name(DrawnPoint place) {
  if (net != 0 && is_dark_) image().named.push_back({place, 0, net, findings_.command.line});
}

void GerberPlotter::finish_stroke() {
  if (in_region_ || way_.empty()) return;
  const bool is_drawn = !tool().is_round || tool().diameter >= 1;
  if (is_drawn) keep_name(way_.front());
  for (std::size_t first = 0; is_drawn && first + 1 < way_.size();) {
    const std::size_t last = std::min(first + longest_swept, way_.size() - 1);
    draw_way(first, last);
    first = last;
  }
  way_.clear();
  const auto found = apertures_.find(code_);
  if (is_dark_ && found != apertures_.end()) {
    path_.width = Nanometres{tool().is_round ? std::llround(tool().diameter) : 0};
    path_.layer = static_cast<std::uint32_t>(found->second.index);
    path_.is_closed = path_.points.size() > 2 && path_.points.front().at == path_.points.back().at;
    if (path_.is_closed) path_.points.pop_back();
    image().strokes.push_back(std::move(path_));
  }
  path_ = {};
}

void GerberPlotter::flash(DrawnPoint place, std::uint32_t of_net) {
  if (in_region_) {
    findings_.refuse(0, 0, "gerber.bad-region", "a flash between G36 and G37", "D01 and D02 only");
    return;
  }
  finish_stroke();
  at_ = place;
  const PlotterAperture* const source = aperture();
  if (source == nullptr) return;
  if (source->block) {
    if (!has_room_for(source->block->points_of_copy())) return;
    GerberPlacement placement = modal_;
    placement.at = place;
    image().add(*source->block, placement, is_dark_);
    return;
  }
  const Tool& with = tool();
  std::size_t points = 8;
  for (const DrawnRing& ring : with.shape.rings) points += ring.size();
  if (!has_room_for(points)) return;
  GerberPlacement placement;
  placement.at = place;
  image().add(placement.placed(with.shape), is_dark_);
  if (is_dark_) {
    image().pads.push_back({place, static_cast<std::uint32_t>(source->index), of_net, findings_.command.line});
  }
}

void GerberPlotter::begin_region() {
  finish_stroke();
  in_region_ = true;
}

void GerberPlotter::finish_contour() {
  if (way_.size() >= 3) {
    keep_name(way_.front());
    if (way_.front() != way_.back()) findings_.note("a contour of a region is open; it is closed with a line");
    if (can_unite({way_})) image().add(filled({std::move(way_)}), is_dark_);
  }
  way_.clear();
}

void GerberPlotter::end_region() {
  if (in_region_) finish_contour();
  in_region_ = false;
}

GerberPlotter::Frame* GerberPlotter::push_frame() {
  finish_stroke();
  if (frames_.size() < most_frames) return &frames_.emplace_back();
  findings_.refuse(0, 0, "gerber.nested-too-deep", "aperture blocks are nested too deeply",
                   fmt::format("at most {}", most_frames));
  return nullptr;
}

void GerberPlotter::begin_block(std::uint32_t code) {
  Frame* const frame = push_frame();
  if (frame == nullptr) return;
  frame->is_block = true;
  frame->code = code;
}

void GerberPlotter::begin_repeat(std::int64_t across, std::int64_t up, DrawnPoint step) {
  Frame* const frame = push_frame();
  if (frame == nullptr) return;
  frame->across = across;
  frame->up = up;
  frame->step = step;
}

void GerberPlotter::end_block() {
  finish_stroke();
  if (frames_.size() > 1 && !frames_.back().is_block) end_repeat();
  if (frames_.size() <= 1 || !frames_.back().is_block) {
    findings_.refuse(0, 0, "gerber.bad-block", "this ends a block that was not started", "%ABD12*% before");
    return;
  }
  pop_frame();
}

void GerberPlotter::end_repeat() {
  finish_stroke();
  if (frames_.size() > 1 && !frames_.back().is_block) pop_frame();
}

void GerberPlotter::pop_frame() {
  Frame frame = std::move(frames_.back());
  frames_.pop_back();
  if (frame.is_block) {
    PlotterAperture aperture;
    aperture.index = layer_.apertures.size();
    layer_.apertures.push_back({.code = frame.code});
    aperture.block = std::make_unique<GerberImage>(std::move(frame.image));
    define(frame.code, std::move(aperture));
    return;
  }
  const std::int64_t copies = frame.across * frame.up;
  const auto most_copies = static_cast<std::int64_t>(most_points_ / frame.image.points_of_copy()) + 1;
  if (!has_room_for(frame.image.points_of_copy() * static_cast<std::size_t>(std::min(copies, most_copies)))) return;
  for (std::int64_t i = 0; i < frame.across; ++i) {
    for (std::int64_t j = 0; j < frame.up; ++j) {
      GerberPlacement placement;
      placement.at = {{frame.step.x.count * i}, {frame.step.y.count * j}};
      image().add(frame.image, placement, true);
    }
  }
}

GerberImage GerberPlotter::finish() {
  if (in_region_) findings_.note("the last region has no G37");
  end_region();
  finish_stroke();
  while (frames_.size() > 1) {
    if (frames_.back().is_block) findings_.note(fmt::format("the block D{} is not closed", frames_.back().code));
    pop_frame();
  }
  return std::move(frames_.front().image);
}

}  // namespace passo
