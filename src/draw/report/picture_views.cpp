#include "picture_views.hpp"

#include <cmath>

#include "axis_ticks.hpp"
#include "path_drawing.hpp"
#include "sheet.hpp"

namespace passo {
namespace {

using namespace sheet;
constexpr double axis_name_gap = 28;  // from the axis to its name, not counting the labels between them

// The axes have the same colours as in most drawing programs.
struct Arm {
  Axis axis;
  Colour colour;
};
const std::array<Arm, 3> arms = {
    {{Axis::x, {0.82, 0.22, 0.20}}, {Axis::y, {0.20, 0.58, 0.24}}, {Axis::z, {0.16, 0.38, 0.78}}}};

double span(const Box& box, Axis axis) {
  return box.high[axis] - box.low[axis];
}

void widen(Box& box, Axis axis, double least) {
  const double missing = least - span(box, axis);
  if (missing <= 0) return;
  box.low[axis] -= missing / 2;
  box.high[axis] += missing / 2;
}

bool inside(const Box& box, const Point& point, double margin) {
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
    if (point[axis] < box.low[axis] - margin || point[axis] > box.high[axis] + margin) return false;
  }
  return true;
}

std::vector<Tick> axis_ticks(const Scene& scene, const Box& box, Axis axis, double pixels,
                             const std::function<double(const std::string&)>& room) {
  return ticks(box.low[axis] - scene.zero[axis], box.high[axis] - scene.zero[axis], pixels, room);
}

Spot moved(Spot spot, double right, double down) {
  return {spot.x + right, spot.y + down};
}

// Draws the three axes at each work zero in the view. An axis that points at the eye is a ring.
void draw_zeros(Canvas& canvas, const Scene& scene, const Projection& projection, const Box& shown) {
  constexpr double length = 26;
  for (const Point& zero : scene.path.origins()) {
    if (!inside(shown, zero, 1e-9 * span(shown, Axis::x))) continue;
    const Spot centre = projection.spot(zero);
    for (const bool halo : {true, false}) {
      for (const Arm& arm : arms) {
        Point tip = zero;
        tip[arm.axis] += length / projection.scale();
        const Spot end = projection.spot(tip);
        if (std::hypot(end.x - centre.x, end.y - centre.y) < length / 2) continue;
        canvas.line(centre, end, {.colour = halo ? paper : arm.colour, .width = halo ? 4.0 : 2.0});
        if (halo) continue;
        const Spot letter{centre.x + (end.x - centre.x) * 1.34, centre.y + (end.y - centre.y) * 1.34};
        canvas.disc(letter, 6.5, paper);
        canvas.text(letter, {letter_of(arm.axis)}, {.size = 11, .colour = arm.colour, .bold = true}, Align::centre);
      }
    }
    canvas.disc(centre, 4, paper);
    canvas.disc(centre, 3, ink);
  }
}

// A scale bar ("20 mm"), about a fifth of the view.
void draw_scale_bar(Canvas& canvas, Spot right_end, double scale, double view_width) {
  const double length = round_step(0.11 * view_width / scale);
  const Spot left_end = moved(right_end, -length * scale, 0);
  const Area backing{left_end.x - 10, right_end.y - 24, length * scale + 20, 34};
  canvas.fill({{backing.x, backing.y},
               {backing.right(), backing.y},
               {backing.right(), backing.bottom()},
               {backing.x, backing.bottom()}},
              paper, 0.85);
  const Pen pen{.colour = ink, .width = 1.6};
  canvas.line(left_end, right_end, pen);
  canvas.line(moved(left_end, 0, -4), moved(left_end, 0, 4), pen);
  canvas.line(moved(right_end, 0, -4), moved(right_end, 0, 4), pen);
  canvas.text(moved(left_end, length * scale / 2, -13), tick_label(length, length) + " mm", label, Align::centre);
}

// How a flat view lies: the axis that points right, and the one that points up.
struct Flat {
  const char* title;
  Axis across;
  Axis up;
};

Flat flat_of(FlatView view) {
  switch (view) {
    case FlatView::front: return {"Front view", Axis::x, Axis::z};
    case FlatView::side: return {"Side view", Axis::y, Axis::z};
    case FlatView::lathe: return {"Lathe view", Axis::z, Axis::x};
    case FlatView::automatic:
    case FlatView::top: break;
  }
  return {"Top view", Axis::x, Axis::y};
}

// Widens the box so that it fills the frame of the flat view. So a wide or narrow view also shows what is beside the
// path.
Box filled_box(const Box& box, const Flat& flat, const Projection& projection, const Area& area) {
  Box filled = box;
  widen(filled, flat.across, area.width / projection.scale());
  widen(filled, flat.up, area.height / projection.scale());
  return filled;
}

void draw_flat_frame(Canvas& canvas, const Scene& scene, const Flat& flat, const Projection& projection,
                     const Area& area) {
  const Box shown = filled_box(scene.box, flat, projection, area);
  const double scale = projection.scale();
  // Labels need the same room on both axes, so that the grid is square.
  const auto room = [&](const std::string& text) { return canvas.text_width(text, label) + 22; };
  const auto spot = [&](Axis axis, double value) {
    Point place;
    place[axis] = scene.zero[axis] + value;
    return projection.spot(place);
  };
  for (const Tick& tick : axis_ticks(scene, shown, flat.across, scale, room)) {
    const double x = spot(flat.across, tick.value).x;
    canvas.line({x, area.y}, {x, area.bottom()}, grid);
    canvas.line({x, area.bottom()}, {x, area.bottom() + mark}, edge);
    canvas.text({x, area.bottom() + mark + 10}, tick.label, label, Align::centre);
  }
  for (const Tick& tick : axis_ticks(scene, shown, flat.up, scale, room)) {
    const double y = spot(flat.up, tick.value).y;
    canvas.line({area.x, y}, {area.right(), y}, grid);
    canvas.line({area.x - mark, y}, {area.x, y}, edge);
    canvas.text({area.x - mark - 4, y}, tick.label, label, Align::right);
  }
  canvas.frame(area, edge);
  canvas.text({area.x + area.width / 2, area.bottom() + 36}, std::string{letter_of(flat.across)} + ", mm", axis_title,
              Align::centre);
  canvas.text({area.x - mark - 4, area.y - 16}, std::string{letter_of(flat.up)} + ", mm", axis_title, Align::right);
}

// One edge of the isometric box with its ticks. The axis runs along the edge, and the labels stand outside of the box.
struct EdgeOfBox {
  Axis axis;
  Point begin;   // the end where the axis is lowest
  double out_x;  // the direction outwards, as a unit vector in the picture
  double out_y;
  Align align;
};

// The labels of a slanting edge stand below each other. Their vertical distance is half the distance of their ticks.
std::vector<Tick> edge_ticks(const Scene& scene, const Projection& projection, Axis axis) {
  const double height = axis == Axis::z ? 20 : 40;
  return axis_ticks(scene, scene.box, axis, projection.scale(), [height](const std::string&) { return height; });
}

double widest_label(Canvas& canvas, const std::vector<Tick>& all) {
  double widest = 0;
  for (const Tick& tick : all) widest = std::max(widest, canvas.text_width(tick.label, label));
  return widest;
}

void draw_edge(Canvas& canvas, const Scene& scene, const Projection& projection, const EdgeOfBox& side) {
  const std::vector<Tick> all = edge_ticks(scene, projection, side.axis);
  for (const Tick& tick : all) {
    Point place = side.begin;
    place[side.axis] = scene.zero[side.axis] + tick.value;
    const Spot spot = projection.spot(place);
    canvas.line(spot, moved(spot, mark * side.out_x, mark * side.out_y), edge);
    canvas.text(moved(spot, 11 * side.out_x, 17 * side.out_y), tick.label, label, side.align);
  }
  Point middle = side.begin;
  middle[side.axis] = (scene.box.low[side.axis] + scene.box.high[side.axis]) / 2;
  const double way = axis_name_gap + widest_label(canvas, all);
  canvas.text(moved(projection.spot(middle), way * side.out_x, way * side.out_y),
              std::string{letter_of(side.axis)} + ", mm", axis_title, side.align);
}

// The isometric view, as large as possible, with room for the labels on the left, on the right and below. The widths of
// the labels depend on the scale.
Projection fitted_isometric(Canvas& canvas, const Scene& scene, const Area& area) {
  Projection projection = Projection::isometric();
  projection.fit(scene.box, area);
  const double left = widest_label(canvas, edge_ticks(scene, projection, Axis::z)) + axis_name_gap +
                      canvas.text_width("Z, mm", axis_title);
  const double right = widest_label(canvas, edge_ticks(scene, projection, Axis::y)) + axis_name_gap;
  projection.fit(scene.box, {area.x + left, area.y + 20, area.width - left - right, area.height - 76});
  return projection;
}

// The text shown if nothing moved.
void draw_no_motion(Canvas& canvas, const Area& area) {
  const Spot middle{area.x + area.width / 2, area.y + area.height / 2};
  canvas.text(middle, "The program has no moves.", {.size = 18, .colour = quiet_ink}, Align::centre);
}

void draw_box(Canvas& canvas, const Scene& scene, const Projection& projection) {
  const Point& low = scene.box.low;
  const Point& high = scene.box.high;
  const auto at = [&](bool x, bool y, bool z) {
    return projection.spot((x ? high : low)[Axis::x], (y ? high : low)[Axis::y], (z ? high : low)[Axis::z]);
  };
  canvas.fill({at(false, false, false), at(true, false, false), at(true, true, false), at(false, true, false)},
              {0.965, 0.97, 0.975});
  const auto room = [](const std::string&) { return 40.0; };
  for (const Tick& tick : axis_ticks(scene, scene.box, Axis::x, projection.scale(), room)) {
    const double x = scene.zero[Axis::x] + tick.value;
    canvas.line(projection.spot(x, low[Axis::y], low[Axis::z]), projection.spot(x, high[Axis::y], low[Axis::z]), grid);
  }
  for (const Tick& tick : axis_ticks(scene, scene.box, Axis::y, projection.scale(), room)) {
    const double y = scene.zero[Axis::y] + tick.value;
    canvas.line(projection.spot(low[Axis::x], y, low[Axis::z]), projection.spot(high[Axis::x], y, low[Axis::z]), grid);
  }
  // The walls behind the path: left, back and right.
  for (const auto& [from, to] : {std::pair{at(false, true, false), at(false, true, true)},
                                 {at(true, true, false), at(true, true, true)},
                                 {at(false, false, true), at(false, true, true)},
                                 {at(false, true, true), at(true, true, true)},
                                 {at(false, true, false), at(true, true, false)},
                                 {at(false, false, false), at(false, true, false)}}) {
    canvas.line(from, to, grid);
  }
  canvas.line(at(false, false, false), at(true, false, false), edge);
  canvas.line(at(true, false, false), at(true, true, false), edge);
  canvas.line(at(false, false, false), at(false, false, true), edge);
}

}  // namespace

Scene::Scene(const PathRecorder& recorded, const PictureOptions& options)
    : path(recorded),
      colours(recorded, options.colour),
      rapids(options.rapids),
      box(options.rapids ? recorded.extents() : recorded.feed_extents()) {
  if (path.origins().size() == 1) {
    zero = path.origins().front();
    work_coordinates = true;
  }
  const auto largest_span = [this] { return std::max({span(box, Axis::x), span(box, Axis::y), span(box, Axis::z)}); };
  double largest = largest_span();
  // A work zero near the path is shown. A work zero that is far away is not shown, because the path would become small.
  for (const Point& origin : path.origins()) {
    if (!inside(box, origin, largest / 3)) continue;
    for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
      box.low[axis] = std::min(box.low[axis], origin[axis]);
      box.high[axis] = std::max(box.high[axis], origin[axis]);
    }
  }
  largest = largest_span();
  constexpr double some = 40;  // mm; the size of the box if nothing moves
  if (!(largest > 0)) largest = some;
  widen(box, Axis::x, largest / 4);
  widen(box, Axis::y, largest / 4);
  widen(box, Axis::z, largest / 20);
}

FlatView natural_view(const PathRecorder& path, bool is_lathe) {
  const Box& box = path.extents();
  const double some = 1e-6 * std::max({span(box, Axis::x), span(box, Axis::y), span(box, Axis::z)});
  const auto moves = [&](Axis axis) { return span(box, axis) > some; };
  if (path.empty() || !moves(Axis::z)) return FlatView::top;
  if (moves(Axis::x) && !moves(Axis::y)) return is_lathe ? FlatView::lathe : FlatView::front;
  if (moves(Axis::y) && !moves(Axis::x)) return FlatView::side;
  return FlatView::top;
}

void draw_flat_view(Canvas& canvas, const Scene& scene, FlatView view, const Area& area) {
  const Flat flat = flat_of(view);
  canvas.text({area.x + area.width / 2, area.y - 16}, flat.title, axis_title, Align::centre);
  Projection projection = Projection::flat(flat.across, flat.up);
  constexpr double margin = 0.06;
  projection.fit(scene.box, {area.x + margin * area.width, area.y + margin * area.height, area.width * (1 - 2 * margin),
                             area.height * (1 - 2 * margin)});
  draw_flat_frame(canvas, scene, flat, projection, area);
  draw_path(canvas, scene.path, projection, scene.colours, scene.rapids);
  Box shown = filled_box(scene.box, flat, projection, area);
  draw_zeros(canvas, scene, projection, shown);
  if (scene.path.empty()) draw_no_motion(canvas, area);
  draw_scale_bar(canvas, {area.right() - 18, area.bottom() - 18}, projection.scale(), area.width);
}

void draw_isometric_view(Canvas& canvas, const Scene& scene, const Area& area) {
  canvas.text({area.x + area.width / 2, area.y - 16}, "Isometric view", axis_title, Align::centre);
  const Projection projection = fitted_isometric(canvas, scene, area);
  draw_box(canvas, scene, projection);

  const Point& low = scene.box.low;
  Point right_corner = low;
  right_corner[Axis::x] = scene.box.high[Axis::x];
  constexpr double cosine = 0.8660254037844386;
  draw_edge(canvas, scene, projection, {Axis::x, low, -0.5, cosine, Align::right});
  draw_edge(canvas, scene, projection, {Axis::y, right_corner, 0.5, cosine, Align::left});
  draw_edge(canvas, scene, projection, {Axis::z, low, -1, 0, Align::right});
  draw_path(canvas, scene.path, projection, scene.colours, scene.rapids);
  draw_zeros(canvas, scene, projection, scene.box);
  if (scene.path.empty()) draw_no_motion(canvas, area);
}

}  // namespace passo
