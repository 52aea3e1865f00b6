// passo cam laser: programs that cut and score drawings, or engrave pictures, with a laser.
#include <algorithm>
#include <cmath>
#include <compare>
#include <iterator>
#include <map>

#include "cam_laser_job.hpp"
#include "cam_part.hpp"
#include "cam_program.hpp"
#include "cam_tools.hpp"
#include <nlohmann/json.hpp>

#include "passo/base/counted.hpp"
#include "passo/diagnostics/file_bytes.hpp"
#include "passo/laser/burned_picture.hpp"

namespace passo {
namespace {

// What was planned, for the summary.
struct LaserWork {
  std::string words = {};
  nlohmann::ordered_json json = {};
  Mm spot{0.2};  // width of a line in the picture
};

// The bytes of a picture; empty if the file is none.
std::optional<std::string> picture_in(const std::string& file) {
  Diagnostics findings;  // the reader of drawings shows those of other files
  auto bytes = read_bytes(file, {.area = "picture", .expected = "a drawing or a picture"}, findings);
  if (!bytes || !is_level_picture(*bytes)) return std::nullopt;
  return bytes;
}

// The paths of `all` without those that `some` contains, too.
void remove_paths(Drawing& all, const Drawing& some) {
  const auto key_of = [](const DrawnPath& path) {
    std::vector<std::pair<DrawnPoint, double>> key;
    for (const PathPoint& point : path.points) key.emplace_back(point.at, point.bulge);
    return key;
  };
  std::map<std::vector<std::pair<DrawnPoint, double>>, std::size_t> counts;
  for (const DrawnPath& path : some.paths) ++counts[key_of(path)];
  std::erase_if(all.paths, [&](const DrawnPath& path) {
    const auto found = counts.find(key_of(path));
    if (found == counts.end() || found->second == 0) return false;
    --found->second;
    return true;
  });
  std::erase_if(all.holes, [&](const DrawnHole& hole) {
    return std::ranges::any_of(
        some.holes, [&](const DrawnHole& other) { return other.at == hole.at && other.diameter == hole.diameter; });
  });
}

// What is scored, by --score-color and --score-layer.
std::optional<Drawing> scored_of(const CamLaserArguments& arguments, const LaserJob& job) {
  MillJob reading = job.drawing;
  reading.reading.dxf.layers = arguments.score_layers;
  reading.reading.svg.layers = arguments.score_layers;
  reading.reading.hpgl.layers = arguments.score_layers;
  reading.reading.svg.colors = arguments.score_colors;
  reading.reading.svg.names = {};
  return read_drawings(arguments, reading);
}

// The lines of the drawings, in program coordinates.
struct LaserDrawing {
  PartDrawing cut;
  std::optional<PartDrawing> scored;
};

// Scored and cut lines are placed by the lower left corner of both.
std::optional<LaserDrawing> read_lines(const CamLaserArguments& arguments, const LaserJob& job) {
  std::optional<Drawing> all = read_drawings(arguments, job.drawing);
  if (!all) return std::nullopt;
  const auto part = [&](Drawing drawing, const MillJob& placed) {
    return part_of(std::move(drawing), placed, job.join, OpenRows::kept);
  };
  if (arguments.score_layers.empty() && arguments.score_colors.empty()) {
    std::optional<PartDrawing> cut = part(std::move(*all), job.drawing);
    return cut ? std::optional(LaserDrawing{std::move(*cut), {}}) : std::nullopt;
  }
  MillJob placed = job.drawing;
  if (placed.zero.is_lower_left) {
    placed.zero = {};
    placed.sheet = {};
    const std::optional<PartDrawing> drawn = part(*all, placed);
    if (!drawn) return std::nullopt;
    placed.zero.at = drawn->least;
    placed.sheet = job.drawing.sheet;
  }
  std::optional<Drawing> score = scored_of(arguments, job);
  if (!score) return std::nullopt;
  remove_paths(*all, *score);
  std::optional<PartDrawing> scored = part(std::move(*score), placed);
  std::optional<PartDrawing> cut = scored && all->paths.empty() && all->holes.empty() ? PartDrawing{}
                                   : scored                                           ? part(std::move(*all), placed)
                                                                                      : std::nullopt;
  if (!scored || !cut) return std::nullopt;
  return LaserDrawing{std::move(*cut), std::move(scored)};
}

LaserLines burn_part(LaserProgram& program, const PartDrawing& part, LaserLinesOptions options,
                     const LaserPasses& passes, Diagnostics& findings) {
  options.start = program.at();
  LaserLines lines = plan_laser_lines(part.loops, options, findings);
  burn_lines(program, lines, passes);
  return lines;
}

// Scored lines come first, while nothing has come loose.
std::optional<LaserWork> burn_drawings(const CamLaserArguments& arguments, const LaserJob& job, LaserProgram& program) {
  const std::optional<LaserDrawing> drawing = read_lines(arguments, job);
  if (!drawing) return std::nullopt;
  LaserWork work;
  Diagnostics findings;
  std::size_t dots = 0;
  if (drawing->scored) {
    const LaserLines scored =
        burn_part(program, *drawing->scored, {.side = ProfileSide::on}, {.beam = job.score}, findings);
    dots += scored.dots;
    work.words =
        fmt::format("scored: {}, {}\n", counted(scored.closed, "closed line"), counted(scored.open, "open line"));
    work.json["scored"] = {{"closed", scored.closed}, {"open", scored.open}};
  }
  const LaserLines lines = burn_part(program, drawing->cut, job.lines, job.cut, findings);
  show(findings, listed(arguments.files));
  if (findings.any_error()) return std::nullopt;
  dots += lines.dots;
  if (dots > 0) {
    note(fmt::format("{} {} left out: the beam is off at rest", counted(dots, "dot"), dots == 1 ? "is" : "are"));
  }
  work.words += fmt::format("cut: {}, {}, {}\n", counted(lines.closed, "closed line"), counted(lines.open, "open line"),
                            counted(job.cut.passes, "pass", "passes"));
  work.json["closed"] = lines.closed;
  work.json["open"] = lines.open;
  if (job.lines.kerf.count > 0) work.spot = to_mm(job.lines.kerf);
  return work;
}

std::optional<LaserWork> burn_picture(const CamLaserArguments& arguments, const LaserJob& job, const std::string& bytes,
                                      LaserProgram& program) {
  Diagnostics findings;
  const std::string& file = arguments.files.front();
  const LevelPicture picture = read_picture_on_white(file, bytes, findings);
  CellCount count;
  const double line = to_mm(job.raster.line).value();
  if (!findings.any_error()) {
    count = count_cells(picture, job.width, Mm(line));
    if (count.columns * count.rows > static_cast<double>(most_beam_cells)) {
      findings.add(
          of_file("laser.too-fine", file,
                  fmt::format("the picture has {:.0f} x {:.0f} cells of {:g} mm", count.columns, count.rows, line),
                  fmt::format("at most {} million cells: a larger --line-distance, or a smaller --width",
                              most_beam_cells / 1'000'000)));
    }
  }
  RasterMoves moves = job.raster;
  if (job.drawing.zero.at) moves.origin = {{-job.drawing.zero.at->x.count}, {-job.drawing.zero.at->y.count}};
  const Nanometres wide{std::llround(count.columns) * moves.line.count};
  const Nanometres tall{std::llround(count.rows) * moves.line.count};
  if (job.drawing.sheet && !findings.any_error()) {
    check_sheet(*job.drawing.sheet, {moves.origin, {moves.origin.x + wide, moves.origin.y + tall}}, file, findings);
  }
  show(findings);
  if (findings.any_error()) return std::nullopt;
  const BeamCells cells =
      cells_of(picture, static_cast<std::size_t>(count.columns), static_cast<std::size_t>(count.rows), job.tones);
  burn_raster(program, cells, moves);
  LaserWork work;
  work.spot = Mm(line);
  work.words = fmt::format("{}: {} x {} pixels, {}\n{} x {} cells of {:g} mm: {:.6g} x {:.6g} mm; overscan {:.4g} mm\n",
                           file, picture.columns, picture.rows, picture.kind, cells.columns, cells.rows, line,
                           to_mm(wide).value(), to_mm(tall).value(), to_mm(moves.overscan).value());
  work.json = {{"columns", cells.columns},
               {"rows", cells.rows},
               {"width_mm", to_mm(wide).value()},
               {"length_mm", to_mm(tall).value()},
               {"overscan_mm", to_mm(moves.overscan).value()}};
  return work;
}

std::optional<LaserWork> burn_test_grid(const LaserGrid& grid, LaserProgram& program) {
  Diagnostics findings;
  burn_grid(program, grid, findings);
  show(findings);
  if (findings.any_error()) return std::nullopt;
  LaserWork work;
  if (grid.is_filled) work.spot = to_mm(grid.line);
  work.words = fmt::format(
      "test grid: {} x {} cells; from left to right {:g} to {:g} %, from top to bottom {:g} to {:g} mm/min\n",
      grid.columns, grid.rows, grid.least_percent, grid.most_percent, to_mm(grid.least_feed).value(),
      to_mm(grid.most_feed).value());
  work.json = {{"columns", grid.columns}, {"rows", grid.rows}};
  return work;
}

bool inputs_are_good(const CamLaserArguments& arguments) {
  if (!outputs_are_good(arguments, "")) return false;
  if (arguments.grid.empty() == arguments.files.empty()) {
    fail(exit_bad_program, "expected either a drawing or picture (FILE), or --grid");
    return false;
  }
  if (!arguments.picture.empty() && !arguments.picture.ends_with(".png")) {
    fail(exit_bad_program,
         fmt::format("--picture: expected a name that ends with .png, found '{}'", arguments.picture));
    return false;
  }
  return true;
}

// The moves of what the arguments name.
std::optional<LaserWork> burn(const CamLaserArguments& arguments, const LaserJob& job, LaserProgram& program) {
  if (job.grid) return burn_test_grid(*job.grid, program);
  for (const std::string& file : arguments.files) {
    const std::optional<std::string> picture = picture_in(file);
    if (!picture) continue;
    if (arguments.files.size() == 1) return burn_picture(arguments, job, *picture, program);
    fail(exit_bad_program, fmt::format("{}: expected drawings, or a single picture", file));
    return std::nullopt;
  }
  return burn_drawings(arguments, job, program);
}

nlohmann::ordered_json json_of(const DrawnBox& box) {
  return {to_mm(box.least.x).value(), to_mm(box.least.y).value(), to_mm(box.most.x).value(), to_mm(box.most.y).value()};
}

std::string totals_words(const LaserTotals& totals) {
  const DrawnBox& moved = *totals.moved;
  const DrawnBox& burned = *totals.burned;
  const auto words = [](const DrawnBox& box) {
    return fmt::format("X {:.6g} to {:.6g}, Y {:.6g} to {:.6g} mm", to_mm(box.least.x).value(),
                       to_mm(box.most.x).value(), to_mm(box.least.y).value(), to_mm(box.most.y).value());
  };
  return fmt::format("burned: {:.1f} mm, {}, S{} to S{}\nthe head moves within {}\n{}, about {:.0f} s\n",
                     totals.burned_nm / nanometres_per_mm, words(burned), totals.least_s, totals.most_s, words(moved),
                     counted(totals.lines, "line"), std::ceil(totals.seconds));
}

}  // namespace

int cam_laser(const CamLaserArguments& arguments, const WorkProgress& progress) {
  if (!inputs_are_good(arguments)) return exit_bad_program;
  LengthArguments lengths(*mm_of_unit(arguments.units));
  const LaserJob job = laser_job_of(arguments, lengths);
  if (!lengths.message().empty()) return fail(exit_bad_program, lengths.message());
  LaserProgram program(job.program);
  std::optional<LaserWork> work = burn(arguments, job, program);
  if (!work) return exit_bad_program;
  progress.update(0.6);
  if (program.totals().burned_nm <= 0) {
    const std::string what = arguments.files.empty() ? "--grid" : listed(arguments.files);
    return fail(exit_bad_program, what + ": there is nothing to burn; expected lines, or a picture with dark areas");
  }
  const std::string text = program.finish();
  if (const int code = write_program(arguments, text, job.program.name, job.program.park); code != exit_done)
    return code;
  progress.update(0.8);
  if (!arguments.picture.empty()) {
    const std::string picture = draw_burned(text, {.units = job.program.units, .spot = work->spot});
    if (picture.empty()) return fail(exit_failed, "the picture cannot be drawn: out of memory");
    if (const int code = write_text(arguments.picture, picture); code != exit_done) return code;
  }
  progress.update(1);
  const LaserTotals& totals = program.totals();
  if (arguments.json) {
    work->json["burned_mm"] = totals.burned_nm / nanometres_per_mm;
    work->json["least_s"] = totals.least_s;
    work->json["most_s"] = totals.most_s;
    work->json["burned_box_mm"] = json_of(*totals.burned);
    work->json["moved_box_mm"] = json_of(*totals.moved);
    work->json["seconds"] = totals.seconds;
    say_summary(work->json, arguments);
  } else if (!arguments.output.empty() && arguments.output != "-") {
    say(work->words + totals_words(totals));
  }
  return exit_done;
}

}  // namespace passo
