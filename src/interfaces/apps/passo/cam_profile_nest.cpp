#include "cam_profile_nest.hpp"

#include <algorithm>
#include <filesystem>

#include "program_messages.hpp"

#include "passo/base/counted.hpp"
#include "passo/diagnostics/file_bytes.hpp"

namespace passo {
namespace {

using ClosedLoop = std::vector<PathPoint>;

ClosedLoop placed_loop(ClosedLoop loop, const NestPlacement& placement) {
  for (PathPoint& point : loop) point.at = placed(point.at, placement);
  return loop;
}

std::vector<std::vector<ClosedLoop>> loops_of_parts(const std::vector<ClosedLoop>& loops,
                                                    const std::vector<Region>& parts) {
  std::vector<Region> islands;
  for (const ClosedLoop& loop : loops) {
    islands.push_back(filled({chords_of_path(loop, true, usual_chord_tolerance)}));
  }
  std::vector<std::vector<ClosedLoop>> of_parts(parts.size());
  const std::vector<std::size_t> found = parts_with(islands, parts);
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (found[i] < parts.size()) of_parts[found[i]].push_back(loops[i]);
  }
  return of_parts;
}

DrawnBox box_of_loops(const std::vector<ClosedLoop>& loops) {
  Region all;
  for (const ClosedLoop& loop : loops) all.rings.push_back(chords_of_path(loop, true, usual_chord_tolerance));
  return bounds(all).value_or(DrawnBox{});
}

}  // namespace

Nanometres gap_with_tabs(Nanometres least) {
  return {2 * least.count};
}

bool has_neighbours(const Nest& nest) {
  return std::ranges::any_of(nest.sheets, [](const NestSheet& sheet) { return sheet.placements.size() > 1; });
}

Nanometres least_gap(const OutlineOptions& cut) {
  return cut.cutter + cut.lead + cut.allowance;
}

NestOptions nest_options_of(const CamProfileArguments& arguments, const OutlineOptions& cut, LengthArguments& lengths) {
  NestOptions options;
  if (arguments.side == "on" || arguments.side == "inside" || !arguments.chamfer.empty() || !cut.tab_places.empty() ||
      !arguments.sheet.empty()) {
    lengths.refuse("--nest cannot be combined with --side on, --side inside, --chamfer, --tab or --sheet");
  }
  options.sheet = lengths.place("--nest", arguments.nest);
  const bool is_sheet = options.sheet.x.count > 0 && options.sheet.y.count > 0 && options.sheet.x <= largest_sheet &&
                        options.sheet.y <= largest_sheet;
  if (!is_sheet) {
    lengths.refuse(fmt::format("--nest: expected W,H above 0 and at most {:g} mm, found '{}'",
                               to_mm(largest_sheet).value(), arguments.nest));
  }
  const Nanometres least = least_gap(cut);
  options.gap = (cut.tabs > 0 ? gap_with_tabs(least) : least) + usual_nest_room;
  if (!arguments.gap.empty()) options.gap = lengths.any("--gap", arguments.gap);
  if (options.gap < least || options.gap > largest_sheet) {
    lengths.refuse(fmt::format("--gap: expected at least {:g} mm, which the cutter and its lead-in need, found '{}'",
                               to_mm(least).value(), arguments.gap));
  }
  options.margin = arguments.gap.empty() ? least + usual_nest_room : options.gap;
  if (!arguments.nest_margin.empty()) options.margin = lengths.any("--nest-margin", arguments.nest_margin);
  if (options.margin.count < 0 || options.margin > largest_sheet) {
    lengths.refuse(fmt::format("--nest-margin: expected a length of 0 or more, found '{}'", arguments.nest_margin));
  }
  options.rotations = arguments.rotations;
  return options;
}

std::optional<NestedDrawing> nest_drawing(const PartDrawing& drawing, const std::string& file, std::uint32_t quantity,
                                          const NestOptions& options, const WorkProgress& progress) {
  std::vector<DrawnRing> rings;
  for (const ClosedLoop& loop : drawing.loops.loops) {
    rings.push_back(chords_of_path(loop, true, usual_chord_tolerance));
  }
  const std::vector<Region> parts = parts_of(filled(std::move(rings)));
  const auto loops = loops_of_parts(drawing.loops.loops, parts);
  std::vector<NestShape> shapes;
  for (const Region& part : parts) {
    const DrawnBox box = bounds(part).value_or(DrawnBox{});
    shapes.push_back(
        {.name = fmt::format("the part at X{:.6g} Y{:.6g}", to_mm(box.least.x).value(), to_mm(box.least.y).value()),
         .outlines = {part.rings.front()},
         .quantity = quantity});
  }
  Diagnostics findings;
  auto nest = nest_on_sheets(shapes, options, progress);
  if (!nest) {
    findings.add(of_file("nest.too-large", file, nest.error().message,
                         "a larger --nest, a smaller --nest-margin, or fewer copies"));
    show(findings);
    return std::nullopt;
  }
  NestedDrawing nested{.nest = std::move(*nest), .options = options, .parts = parts.size()};
  for (const NestSheet& sheet : nested.nest.sheets) {
    PartDrawing on_sheet;
    for (const NestPlacement& placement : sheet.placements) {
      for (const ClosedLoop& loop : loops[placement.shape]) {
        on_sheet.loops.loops.push_back(placed_loop(loop, placement));
      }
    }
    const DrawnBox box = box_of_loops(on_sheet.loops.loops);
    on_sheet.least = box.least;
    on_sheet.most = box.most;
    nested.sheets.push_back(std::move(on_sheet));
  }
  return nested;
}

void warn_of_cut_tabs(const Nest& nest, const NestOptions& options, const OutlineOptions& cut,
                      const std::string& file) {
  const Nanometres wide = gap_with_tabs(least_gap(cut));
  if (cut.tabs == 0 || options.gap > wide || !has_neighbours(nest)) return;
  Diagnostic finding = of_file(
      "nest.tabs", file,
      fmt::format("with a gap of {:.4g} mm, the cuts of neighbouring parts overlap and go through their tabs, so parts "
                  "may come loose",
                  to_mm(options.gap).value()),
      fmt::format("--gap above {:.4g} mm, or --no-tabs and another way to hold the parts", to_mm(wide).value()));
  finding.severity = Severity::warning;
  Diagnostics findings;
  findings.add(std::move(finding));
  show(findings);
}

std::string nest_words(const Nest& nest, const NestOptions& options, std::size_t parts) {
  std::size_t copies = 0;
  for (const NestSheet& sheet : nest.sheets) copies += sheet.placements.size();
  return fmt::format(
      "nested: {} of {} on {} of {:g} x {:g} mm, {:.4g} mm apart; {:.1f} % of the used area is parts; the last sheet "
      "is used up to X{:.6g} mm\n",
      counted(copies, "copy", "copies"), counted(parts, "part"), counted(nest.sheets.size(), "sheet"),
      to_mm(options.sheet.x).value(), to_mm(options.sheet.y).value(), to_mm(options.gap).value(), 100 * nest.density(),
      to_mm(nest.sheets.back().used).value());
}

nlohmann::ordered_json nest_json(const Nest& nest, const NestOptions& options, DrawnPoint corner) {
  nlohmann::ordered_json sheets = nlohmann::ordered_json::array();
  for (const NestSheet& sheet : nest.sheets) {
    nlohmann::ordered_json copies = nlohmann::ordered_json::array();
    for (const NestPlacement& placement : sheet.placements) {
      copies.push_back({{"part", placement.shape + 1},
                        {"degrees", placement.degrees},
                        {"x_mm", to_mm(placement.offset.x + corner.x).value()},
                        {"y_mm", to_mm(placement.offset.y + corner.y).value()}});
    }
    sheets.push_back({{"used_mm", to_mm(sheet.used).value()}, {"copies", copies}});
  }
  return {{"sheet_mm", {to_mm(options.sheet.x).value(), to_mm(options.sheet.y).value()}},
          {"gap_mm", to_mm(options.gap).value()},
          {"margin_mm", to_mm(options.margin).value()},
          {"density", nest.density()},
          {"layouts", nest.layouts},
          {"sheets", sheets}};
}

std::string sheet_file(const std::string& file, std::size_t sheet, std::size_t sheets) {
  if (sheets < 2 || file.empty()) return file;
  const std::filesystem::path path(file);
  const std::string name = fmt::format("{}-{}{}", path.stem().string(), sheet + 1, path.extension().string());
  return (path.parent_path() / name).string();
}

}  // namespace passo
