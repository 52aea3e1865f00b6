#include "cam_board_plan.hpp"

#include <algorithm>
#include <cstdio>
#include <iterator>

#include "cam_job.hpp"

#include "passo/cam/gerber.hpp"
#include "passo/diagnostics/file_bytes.hpp"

namespace passo {
namespace {

// Several files may belong to one side; a note reports this.
void add_copper(const BoardFile& file, std::optional<BoardLayer>& side, bool is_told) {
  const GerberLayer& layer = *file.layer;
  if (side && is_told) {
    note(fmt::format("'{}' and '{}' are both {}, so they are milled as one; --as FILE=nothing ignores a file",
                     side->lines.file, file.name, words_for(file.kind)));
  }
  for (const std::string& words : layer.strokes.notes) {
    if (is_told) note(file.name + ": " + words);
  }
  if (!side) side = BoardLayer{};
  side->lines.file = file.name;
  std::ranges::move(net_places_of(layer), std::back_inserter(side->nets));
  if (layer.is_negative) {
    side->bare = united(side->bare.value_or(Region{}), layer.dark);
  } else {
    side->face = united(side->face, layer.dark);
  }
}

BoardPlan one_board_of(const BoardJob& job, Nanometres join, Diagnostics& findings) {
  refuse_two_boards(job, findings);
  BoardPlan plan;
  std::string edge_name;
  for (const BoardFile& file : job.files) {
    if (file.drills && file.kind.role == BoardRole::drill) plan.drills.push_back(*file.drills);
    if (!file.layer) continue;
    if (file.kind.role == BoardRole::outline) {
      plan.edge = BoardLayer{file.layer->dark, file.layer->strokes};
      edge_name = file.name;
    }
    for (const bool is_back : {false, true}) {
      if (file.kind.side != (is_back ? BoardSide::bottom : BoardSide::top)) continue;
      if (file.kind.role == BoardRole::mask) plan.mask[is_back] = united(plan.mask[is_back], file.layer->dark);
      if (file.kind.role == BoardRole::paste) plan.paste[is_back] = united(plan.paste[is_back], file.layer->dark);
    }
    if (file.kind.role != BoardRole::copper) continue;
    const bool is_told = !findings.any_error();
    if (file.kind.side == BoardSide::top) add_copper(file, plan.front, is_told);
    if (file.kind.side == BoardSide::bottom) add_copper(file, plan.back, is_told);
  }
  if (plan.edge) {
    plan.edge->lines.file = edge_name;
    plan.face = board_edge(*plan.edge, join, findings).board;
    if (plan.face.empty() && !findings.any_error()) {
      note(edge_name + ": it has no closed outline, so no board is cut out");
      plan.edge.reset();
    }
  }
  std::vector<Region> all = {plan.face};
  for (std::optional<BoardLayer>* const side : {&plan.front, &plan.back}) {
    if (!*side) continue;
    (*side)->face = covered_by(**side, plan.face, findings);
    (*side)->bare.reset();
    if (plan.face.empty()) all.push_back((*side)->face);
  }
  plan.box = bounds(united(all)).value_or(DrawnBox{});
  plan.one = plan.box;
  return plan;
}

std::size_t points_of(const Region& region) {
  std::size_t points = 0;
  for (const DrawnRing& ring : region.rings) points += ring.size();
  return points;
}

std::size_t points_of(const BoardPlan& plan) {
  std::size_t points = points_of(plan.face);
  for (const std::optional<BoardLayer>* const layer : {&plan.front, &plan.back, &plan.edge}) {
    if (*layer) points += points_of((*layer)->face) + (*layer)->lines.paths.size() + (*layer)->nets.size();
  }
  for (const Drawing& drills : plan.drills) points += drills.holes.size() + drills.paths.size();
  for (const bool is_back : {false, true}) points += points_of(plan.mask[is_back]) + points_of(plan.paste[is_back]);
  return points;
}

// Copies can lie side by side only without the objects beside the board.
void trim(BoardPlan& plan) {
  const Nanometres half{plan.grid.gap.count / 2};
  const DrawnBox cell{{plan.one.least.x - half, plan.one.least.y - half},
                      {plan.one.most.x + half, plan.one.most.y + half}};
  for (std::optional<BoardLayer>* const layer : {&plan.front, &plan.back, &plan.edge}) {
    if (*layer) trim_to(cell, **layer);
  }
  std::size_t dropped = 0;
  for (Drawing& drills : plan.drills) dropped += trim_to(cell, drills);
  if (dropped > 0) note(counted(dropped, "hole or slot", "holes or slots") + " outside the board are left out");
  for (std::array<Region, 2>* const openings : {&plan.mask, &plan.paste}) {
    for (Region& one : *openings) one = common(one, Region{{rectangle(cell)}});
  }
}

void repeat(BoardPlan& plan, Diagnostics& findings) {
  if (points_of(plan) > most_gerber_points / plan.grid.copies()) {
    findings.add(of_file("board.too-large", "--copies", "the copies have over 16 million points", "fewer copies"));
    return;
  }
  trim(plan);
  const std::vector<DrawnPoint> offsets = offsets_of(plan.grid, plan.one);
  for (std::optional<BoardLayer>* const layer : {&plan.front, &plan.back, &plan.edge}) {
    if (*layer) *layer = repeated(**layer, offsets);
  }
  for (Drawing& drills : plan.drills) drills = repeated(drills, offsets);
  for (std::array<Region, 2>* const openings : {&plan.mask, &plan.paste}) {
    for (Region& one : *openings) one = repeated(one, offsets);
  }
  plan.face = repeated(plan.face, offsets);
  plan.box.most = {plan.one.most.x + offsets.back().x, plan.one.most.y + offsets.back().y};
}

}  // namespace

Result<PanelGrid, std::string> panel_of(const CamBoardArguments& arguments, const CamOutlineArguments& outline) {
  PanelGrid grid;
  char beyond = 0;
  const bool is_given = !arguments.copies.empty();
  const bool is_read = std::sscanf(arguments.copies.c_str(), "%4ux%4u%c", &grid.columns, &grid.rows, &beyond) == 2;
  const auto is_count = [](std::uint32_t count) { return count >= 1 && count <= most_panel_columns; };
  if (is_given && !(is_read && is_count(grid.columns) && is_count(grid.rows))) {
    return Failure{fmt::format("--copies: expected COLUMNSxROWS, at most {0}x{0}, e.g. 3x4, not '{1}'",
                               most_panel_columns, arguments.copies)};
  }
  LengthArguments lengths(1);
  grid.gap = lengths.any("--gap", arguments.gap);
  if (grid.gap.count < 0) lengths.refuse("--gap: expected a length of 0 or more");
  LengthArguments of_outline(*mm_of_unit(outline.units));
  const Nanometres cutter = of_outline.any("--tool", outline.tool);
  for (const LengthArguments* const all : {&lengths, &of_outline}) {
    if (!all->message().empty()) return Failure{all->message()};
  }
  constexpr Nanometres least_web{1'000'000};
  const bool has_tabs = !outline.no_tabs && (outline.tabs > 0 || !outline.tab_places.empty());
  const Nanometres least = has_tabs ? cutter + cutter + least_web : cutter;
  if (grid.copies() > 1 && grid.gap < least) {
    return Failure{fmt::format("--gap: expected at least {:.4g} mm: {}", to_mm(least).value(),
                               has_tabs
                                   ? "the outline's cutter on both sides, and 1 mm between that the tabs hold on to"
                                   : "the width of the outline's cutter")};
  }
  return grid;
}

BoardPlan board_plan_of(const BoardJob& job, Nanometres join, const PanelGrid& grid, Diagnostics& findings) {
  BoardPlan plan = one_board_of(job, join, findings);
  plan.grid = grid;
  if (grid.copies() > 1 && !findings.any_error()) repeat(plan, findings);
  return plan;
}

}  // namespace passo
