#include "passo/report/board_picture.hpp"

#include <algorithm>

#include "plan_view.hpp"
#include "sheet.hpp"
#include <fmt/format.h>

#include "passo/base/counted.hpp"
#include "passo/cam/edge_loops.hpp"

namespace passo {
namespace {

constexpr Colour masked_board{0.09, 0.33, 0.21};
constexpr Colour masked_copper{0.14, 0.47, 0.29};
constexpr Colour bare_board{0.89, 0.83, 0.66};
constexpr Colour bare_copper{0.85, 0.60, 0.25};
constexpr Colour printed{0.96, 0.96, 0.93};
constexpr Colour unprinted{0.30, 0.30, 0.34};  // print on a bare board
constexpr Colour outlined{0.20, 0.22, 0.25};

struct Side {
  const char* name = "";
  BoardSide side = BoardSide::both;
  bool is_turned = false;
  Region copper = {};
  Region mask = {};  // where the mask is open
  Region print = {};
  bool has_mask = false;
};

// A negative layer draws what the board has not.
Region copper_of(const GerberLayer& layer, const Region& board) {
  return layer.is_negative && !board.empty() ? subtracted(board, layer.dark) : layer.dark;
}

Side side_of(const BoardJob& job, const Region& board, const char* name, BoardSide which) {
  Side side{.name = name, .side = which, .is_turned = which == BoardSide::bottom};
  for (const BoardFile& file : job.files) {
    if (file.kind.side != which || !file.layer) continue;
    const Region& dark = file.layer->dark;
    if (file.kind.role == BoardRole::copper) side.copper = united(side.copper, copper_of(*file.layer, board));
    if (file.kind.role == BoardRole::print) side.print = united(side.print, dark);
    if (file.kind.role == BoardRole::mask) side.mask = united(side.mask, dark);
    if (file.kind.role == BoardRole::mask) side.has_mask = true;
  }
  return side;
}

// Top and bottom, if there is something on them; else all layers as one.
std::vector<Side> sides_of(const BoardJob& job, const Region& board) {
  std::vector<Side> sides;
  for (Side& side : std::vector<Side>{side_of(job, board, "Top", BoardSide::top),
                                      side_of(job, board, "Bottom", BoardSide::bottom)}) {
    if (!side.copper.empty() || !side.print.empty() || !side.mask.empty()) sides.push_back(std::move(side));
  }
  if (!sides.empty()) return sides;
  Side all{.name = "All layers"};
  for (const BoardFile& file : job.files) {
    if (file.layer && file.kind.role != BoardRole::outline) all.copper = united(all.copper, file.layer->dark);
  }
  return {all};
}

std::optional<DrawnBox> box_of(const BoardJob& job, const Region& face, const std::vector<Side>& sides) {
  if (const std::optional<DrawnBox> box = bounds(face)) return box;
  std::optional<DrawnBox> all;
  const auto take = [&](DrawnPoint point) {
    if (!all) all = DrawnBox{point, point};
    extend(*all, point);
  };
  for (const Side& side : sides) {
    for (const Region* const region : {&side.copper, &side.mask, &side.print}) {
      const std::optional<DrawnBox> box = bounds(*region);
      if (!box) continue;
      take(box->least);
      take(box->most);
    }
  }
  for (const BoardFile& file : job.files) {
    if (!file.drills) continue;
    for (const DrawnHole& hole : file.drills->holes) take(hole.at);
  }
  return all;
}

// One side in its area of the paper.
class SideDrawing {
 public:
  SideDrawing(Canvas& canvas, const DrawnBox& box, const Area& area, bool is_turned)
      : canvas_(canvas), view_(box, area), turn_{box.least.x + box.most.x}, is_turned_(is_turned) {}

  // A box, and a little around it, for lines along its edge.
  Area place_of(const DrawnBox& box) const {
    constexpr double around = 4;
    const Spot low = view_.spot(box.least);
    const Spot high = view_.spot(box.most);
    return {low.x - around, high.y - around, high.x - low.x + 2 * around, low.y - high.y + 2 * around};
  }
  void fill(const Region& region, const Colour& colour) {
    for (const DrawnRing& ring : region.rings) {
      canvas_.move_to(spot(ring.front()));
      for (std::size_t i = 1; i < ring.size(); ++i) canvas_.line_to(spot(ring[i]));
      canvas_.line_to(spot(ring.front()));
    }
    canvas_.fill_path(colour);
  }
  void draw_holes(const Drawing& drills) {
    constexpr double least = 0.8;  // a smaller dot cannot be seen
    for (const DrawnHole& hole : drills.holes) {
      canvas_.disc(spot(hole.at), std::max(least, view_.pixels(hole.diameter) / 2), sheet::paper);
    }
    for (const DrawnPath& path : drills.paths) {
      canvas_.move_to(spot(path.points.front().at));
      for (std::size_t i = 1; i < path.points.size(); ++i) canvas_.line_to(spot(path.points[i].at));
      canvas_.stroke({.colour = sheet::paper, .width = std::max(least, view_.pixels(path.width))});
    }
  }
  void draw_lines(const Drawing& lines) {
    for (const DrawnPath& path : lines.paths) {
      const DrawnRing points = chords_of_path(path.points, path.is_closed, Nanometres{20'000});
      canvas_.move_to(spot(points.front()));
      for (std::size_t i = 1; i < points.size(); ++i) canvas_.line_to(spot(points[i]));
      if (path.is_closed) canvas_.line_to(spot(points.front()));
      canvas_.stroke({.colour = outlined, .width = 1.2});
    }
  }

 private:
  Spot spot(DrawnPoint at) const {
    if (is_turned_) at.x = turn_ - at.x;
    return view_.spot(at);
  }

  Canvas& canvas_;
  PlanView view_;
  Nanometres turn_;
  bool is_turned_;
};

void draw_side(Canvas& canvas, const BoardJob& job, const Side& side, const Region& face, const DrawnBox& box,
               const Area& area) {
  SideDrawing drawing(canvas, box, area, side.is_turned);
  // Files of layout programs have titles and remarks beside the board.
  canvas.clip(drawing.place_of(box));
  drawing.fill(face, side.has_mask ? masked_board : bare_board);
  drawing.fill(side.copper, side.has_mask ? masked_copper : bare_copper);
  if (side.has_mask) drawing.fill(common(side.copper, side.mask), bare_copper);
  drawing.fill(side.print, side.has_mask && !face.empty() ? printed : unprinted);
  for (const BoardFile& file : job.files) {
    if (file.kind.role == BoardRole::outline && file.layer) drawing.draw_lines(file.layer->strokes);
  }
  for (const BoardFile& file : job.files) {
    if (file.drills) drawing.draw_holes(*file.drills);
  }
  canvas.end_clip();
}

}  // namespace

Status<OutputError> draw_board(const BoardJob& job, const PictureOptions& options, OutputFile& file) {
  Canvas canvas(options, file);
  const Region face = board_face(job);
  const std::vector<Side> sides = sides_of(job, face);
  const std::optional<DrawnBox> box = box_of(job, face, sides);
  std::string words = counted(job.files.size(), "file");
  if (box) {
    words += fmt::format("   \u00B7   {:.2f} x {:.2f} mm", to_mm(box->most.x - box->least.x).value(),
                         to_mm(box->most.y - box->least.y).value());
  }
  begin_sheet(canvas, options, words);
  constexpr double gap = 24;
  const double width = (options.width - 2 * sheet::margin - gap * static_cast<double>(sides.size() - 1)) /
                       static_cast<double>(sides.size());
  for (std::size_t i = 0; box && i < sides.size(); ++i) {
    const Area area{sheet::margin + static_cast<double>(i) * (width + gap), 130, width, options.height - 180.0};
    canvas.text({area.x + width / 2, 112}, sides[i].is_turned ? "Bottom, turned over" : sides[i].name, sheet::caption,
                Align::centre);
    draw_side(canvas, job, sides[i], face, *box, area);
  }
  return canvas.finish();
}

}  // namespace passo
