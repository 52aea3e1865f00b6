#include "cam_relief_job.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <thread>

#include "cam_program.hpp"
#include "program_input.hpp"
#include <nlohmann/json.hpp>

#include "passo/base/counted.hpp"
#include "passo/cam/drawing_file.hpp"
#include "passo/cam/edge_loops.hpp"
#include "passo/diagnostics/file_bytes.hpp"
#include "passo/gcode/foreign_file.hpp"
#include "passo/surface_file/surface_file.hpp"

namespace passo {
namespace {

constexpr Mm least_length{0.001};
constexpr Mm most_length{10'000};

ReliefShape shape_of(const CamReliefArguments& arguments, ReliefReading& read) {
  ReliefShape shape;
  shape.width = read.perhaps("--width", arguments.width, Mm(0.1), most_length);
  shape.length = read.perhaps("--length", arguments.length, Mm(0.1), most_length);
  shape.depth = read.depth("--depth", arguments.depth);
  shape.lowest = read.depth("--lowest-z", arguments.lowest_z);
  shape.smooth = read.length("--smooth", arguments.smooth, Mm(0), Mm(100));
  shape.background = arguments.background / 100;
  shape.gamma = arguments.gamma;
  shape.invert = arguments.invert;
  shape.mirror = arguments.mirror;
  shape.margin = read.length("--margin", arguments.margin, Mm(0), Mm(1000));
  shape.margin_at_top = arguments.margin_level == "top";
  shape.pitch = read.perhaps("--pitch", arguments.pitch, least_length, most_length);
  return shape;
}

ReliefTool tool_of(ReliefReading& read, const char* option, const std::string& cutter, const std::string& step,
                   const std::string& feed, std::optional<double> removal, const CamReliefArguments& arguments) {
  constexpr Mm fastest{100'000};
  ReliefTool tool;
  tool.cutter = read.cutter(option, cutter);
  if (!step.empty()) tool.step_over = read.length(fmt::format("{}-step", option).c_str(), step, least_length, Mm(100));
  tool.feed = read.length("--feed", feed.empty() ? arguments.feed : feed, Mm(1), fastest);
  tool.plunge = read.length("--plunge", arguments.plunge, Mm(1), fastest);
  tool.removal = removal.value_or(0);
  if (!arguments.feed_most.empty()) tool.fastest = read.length("--feed-most", arguments.feed_most, Mm(1), fastest);
  return tool;
}

// The options of rows, and their conflicts with other options.
void read_rows(const CamReliefArguments& arguments, ReliefProgramOptions& program, ReliefReading& read) {
  const std::string& way = arguments.way;
  const bool has_rows = way == "rows" || way == "columns" || way == "both";
  program.rows.direction = arguments.one_way == "climb"          ? RowDirection::climb
                           : arguments.one_way == "conventional" ? RowDirection::conventional
                                                                 : RowDirection::there_and_back;
  if (program.rows.direction != RowDirection::there_and_back && !has_rows) {
    read.refuse(fmt::format("--one-way: expected --way rows, columns or both, found {}", way));
  }
  program.rows.angle = {arguments.angle * std::numbers::pi / 180};
  if (arguments.angle != 0 && way != "rows") read.refuse(fmt::format("--angle: expected --way rows, found {}", way));
  program.rows.has_even_scallops = arguments.spacing == "slope";
  if (!program.rows.has_even_scallops) return;
  if (!has_rows || arguments.angle != 0) {
    read.refuse("--spacing slope: expected --way rows, columns or both, and no --angle");
  }
  const bool is_round = program.finish.cutter.corner.value() > 0;
  if (!is_round) read.refuse("--spacing slope: expected a cutter with a round tip or corner: ball, bull or taper");
}

ReliefProgramOptions program_of(const CamReliefArguments& arguments, ReliefReading& read) {
  ReliefProgramOptions program;
  program.name = arguments.output.empty() ? "relief" : std::filesystem::path(arguments.output).filename().string();
  program.finish =
      tool_of(read, "--cutter", arguments.cutter, arguments.step, arguments.feed, arguments.removal, arguments);
  program.way = arguments.way == "columns"    ? FinishStrategy::columns
                : arguments.way == "both"     ? FinishStrategy::both
                : arguments.way == "spiral"   ? FinishStrategy::spiral
                : arguments.way == "contours" ? FinishStrategy::contours
                                              : FinishStrategy::rows;
  program.rows.steep = {arguments.steep * std::numbers::pi / 180};
  program.arcs = arguments.moves == "arcs";
  if (!arguments.rough.empty()) {
    program.roughing =
        ReliefRoughing{.tool = tool_of(read, "--rough", arguments.rough, arguments.rough_step, arguments.rough_feed,
                                       arguments.rough_removal, arguments),
                       .way = arguments.rough_strategy == "offsets" ? RoughStrategy::offsets : RoughStrategy::rows,
                       .step_down = read.length("--rough-down", arguments.rough_down, Mm(0.01), deepest_relief),
                       .stock = read.length("--rough-stock", arguments.rough_stock, Mm(0), Mm(50))};
  }
  if (!arguments.rest.empty()) {
    program.rest = ReliefRest{.tool = tool_of(read, "--rest", arguments.rest, arguments.rest_step, arguments.rest_feed,
                                              arguments.rest_removal, arguments),
                              .least = read.length("--rest-least", arguments.rest_least, least_length, Mm(10))};
  }
  program.rows.has_pencil = arguments.pencil;
  program.scallop = read.length("--scallop", arguments.scallop, Mm(0.0001), Mm(10));
  program.tolerance = read.length("--tolerance", arguments.tolerance, Mm(0), Mm(1));
  program.clearance = read.length("--clearance", arguments.clearance, Mm(0.1), Mm(1000));
  program.overrun = read.perhaps("--overrun", arguments.overrun, Mm(0), Mm(200));
  program.area.only_on_model = arguments.area == "model";
  const bool is_part = program.area.only_on_model || !arguments.within.empty();
  if (is_part && program.way == FinishStrategy::spiral) {
    read.refuse(fmt::format("{}: expected --way rows, columns, both or contours, found spiral",
                            program.area.only_on_model ? "--area model" : "--within"));
  }
  read_rows(arguments, program, read);
  program.ramps = arguments.entry == "ramp";
  program.ramp = {arguments.ramp_angle * std::numbers::pi / 180};
  program.change = {.height = read.length("--change-height", arguments.change_height, least_length, Mm(1000)),
                    .park = read.place("--park", arguments.park),
                    .spindle_seconds = arguments.spindle_delay,
                    .coolant = coolant_word(arguments)};
  if (arguments.spindle > 0) program.change.spindle = arguments.spindle;
  program.threads = std::clamp(std::thread::hardware_concurrency(), 1U, 64U);
  return program;
}

}  // namespace

ReliefJob relief_job_of(const CamReliefArguments& arguments, ReliefReading& reading) {
  return {.shape = shape_of(arguments, reading), .program = program_of(arguments, reading)};
}

bool read_curves(const std::string& path, std::vector<std::vector<ReliefPoint>>& curves) {
  if (path.empty()) return true;
  Diagnostics findings;
  const Drawing drawing = read_drawing(path, {}, findings);
  constexpr Nanometres join{100'000};
  const EdgeLoops loops = findings.any_error() ? EdgeLoops() : edge_loops(drawing, join, findings);
  if (!findings.any_error() && loops.loops.empty()) {
    findings.add(of_file("relief.no-curve", path, "there is no closed curve", "a drawing with closed curves"));
  }
  show(findings);
  constexpr Nanometres tolerance{5'000};
  for (const std::vector<PathPoint>& loop : loops.loops) {
    std::vector<ReliefPoint>& curve = curves.emplace_back();
    for (const DrawnPoint& point : chords_of_path(loop, true, tolerance)) {
      curve.push_back({to_mm(point.x), to_mm(point.y)});
    }
  }
  return !findings.any_error();
}

namespace {

// The grid spacing must be fine enough for the smallest cutter.
Mm pitch_for(const ReliefProgramOptions& program) {
  const auto of_tool = [&program](const ReliefTool& tool) {
    const Cutter& cutter = tool.cutter;
    const Mm fine =
        (cutter.corner.value() > 0 ? cutter.corner / 8 : cutter.radius / 16) / (program.rows.has_pencil ? 2 : 1);
    return tool.step_over.value() > 0 ? std::min(fine, tool.step_over) : fine;
  };
  Mm pitch = of_tool(program.finish);
  if (program.rows.has_even_scallops) {
    // Rows are added midway between rows, three times at most.
    const Cutter& cutter = program.finish.cutter;
    const Mm step =
        program.finish.step_over.value() > 0 ? program.finish.step_over : cutter.step_for_scallop(program.scallop);
    pitch = std::min(pitch, (step.value() > 0 ? step : cutter.radius) / 8);
  }
  if (program.rest) pitch = std::min(pitch, of_tool(program.rest->tool));
  return std::max(pitch, Mm(0.01));
}

// Turns and scales the model. The other axes follow by a rotation, so a part never becomes its mirror image.
void turn(const CamReliefArguments& arguments, std::vector<SurfaceTriangle>& faces) {
  const double unit = arguments.input_units == "cm"     ? 10
                      : arguments.input_units == "m"    ? 1000
                      : arguments.input_units == "inch" ? 25.4
                                                        : 1;
  const std::string& up = arguments.up;
  if (up == "z" && unit == 1) return;
  for (SurfaceTriangle& face : faces) {
    for (SurfacePoint& p : face) {
      const auto [x, y, z] = p;
      if (up == "-z") p = {x, -y, -z};
      if (up == "y") p = {x, -z, y};
      if (up == "-y") p = {x, z, -y};
      if (up == "x") p = {-z, y, x};
      if (up == "-x") p = {z, y, -x};
      p = {p.x * unit, p.y * unit, p.z * unit};
    }
  }
}

// As the stock is flipped.
void flip(ModelSide side, std::vector<SurfaceTriangle>& faces) {
  if (side == ModelSide::as_told) return;
  for (SurfaceTriangle& face : faces) {
    for (SurfacePoint& p : face) {
      p = side == ModelSide::left_to_right ? SurfacePoint{-p.x, p.y, -p.z} : SurfacePoint{p.x, -p.y, -p.z};
    }
  }
}

double size_of(const std::vector<SurfaceTriangle>& faces, double SurfacePoint::*axis) {
  if (faces.empty()) return 0;
  double low = faces.front().front().*axis;
  double high = low;
  for (const SurfaceTriangle& face : faces) {
    for (const SurfacePoint& p : face) low = std::min(low, p.*axis), high = std::max(high, p.*axis);
  }
  return high - low;
}

// A model that is far too small was probably drawn in another unit.
bool is_plausible(const CamReliefArguments& arguments, const std::vector<SurfaceTriangle>& faces,
                  Diagnostics& findings) {
  if (!arguments.width.empty() || !arguments.length.empty()) return true;
  const double x = size_of(faces, &SurfacePoint::x);
  const double y = size_of(faces, &SurfacePoint::y);
  constexpr double least = 1;  // mm
  if (std::max(x, y) >= least) return true;
  findings.add(of_file("relief.bad-body", arguments.file,
                       fmt::format("the model is {:.4g} by {:.4g} mm: is it in metres or inches?", x, y),
                       "at least 1 mm; --input-units m, inch or cm, or --width"));
  return false;
}

}  // namespace

// The nodes that the cutters' centres reach; each has a height in memory. Refuses too many.
bool fits_memory(const ReliefProgramOptions& program, const HeightGrid& grid, const std::string& name,
                 Diagnostics& findings) {
  Mm beyond = program.overrun.value_or(program.finish.cutter.radius);
  if (program.roughing && !program.overrun) {
    const Mm radius = program.roughing->tool.cutter.radius;
    beyond = std::max({beyond, radius * 1.1 + program.roughing->stock, program.finish.cutter.radius * 2 - radius});
  }
  const double columns = static_cast<double>(grid.columns) + 2 * (beyond / grid.pitch_x + 2);
  const double rows = static_cast<double>(grid.rows) + 2 * (beyond / grid.pitch_y + 2);
  if (columns * rows <= static_cast<double>(most_nodes)) return true;
  findings.add(
      of_file("relief.too-many-nodes", name,
              fmt::format("{:.0f} million grid points are too many, {:.3g} mm apart and with the {:.4g} mm that "
                          "the cutters go beyond the edges",
                          columns * rows / 1e6, grid.pitch_x.value(), beyond.value()),
              "at most 67 million; a greater --pitch, or a smaller cutter or --overrun"));
  return false;
}

// Curves beside the relief were probably drawn in other coordinates.
bool meet(const std::vector<std::vector<ReliefPoint>>& curves, const HeightGrid& grid,
          const ReliefProgramOptions& program, const std::string& name, Diagnostics& findings) {
  if (curves.empty()) return true;
  ReliefPoint low = curves.front().front();
  ReliefPoint high = low;
  for (const std::vector<ReliefPoint>& curve : curves) {
    for (const ReliefPoint& point : curve) {
      low = {std::min(low.x, point.x), std::min(low.y, point.y)};
      high = {std::max(high.x, point.x), std::max(high.y, point.y)};
    }
  }
  const Mm right = program.x0 + grid.width();
  const Mm top = program.y0 + grid.length();
  if (high.x > program.x0 && low.x < right && high.y > program.y0 && low.y < top) return true;
  findings.add(of_file(
      "relief.no-curve", name,
      fmt::format("the curves, X {:.4g} to {:.4g}, Y {:.4g} to {:.4g}, lie beside the relief", low.x.value(),
                  high.x.value(), low.y.value(), high.y.value()),
      fmt::format("curves in program coordinates; the relief reaches from X {:.4g} to {:.4g}, Y {:.4g} to {:.4g}",
                  program.x0.value(), right.value(), program.y0.value(), top.value())));
  return false;
}

std::optional<ReliefGrid> read_relief(const CamReliefArguments& arguments, const ReliefJob& job, ModelSide side,
                                      Diagnostics& findings) {
  const auto bytes = read_bytes(
      arguments.file, {.area = "picture", .expected = "a PNG, JPEG or TIFF picture, or an STL or 3MF file"}, findings);
  if (!bytes) return std::nullopt;
  ReliefShape shape = job.shape;
  shape.wished_pitch = pitch_for(job.program);
  // The time for a node grows with the square of the cutter's radius in nodes.
  shape.finest_pitch = std::max(Mm(0.01), job.program.finish.cutter.radius / 80);
  ReliefGrid read;
  if (is_level_picture(*bytes)) {
    const PixelLevel level = arguments.channel == "alpha" ? PixelLevel::alpha : PixelLevel::luminance;
    const LevelPicture picture = read_level_picture(arguments.file, *bytes, level, findings);
    if (picture.columns == 0) return std::nullopt;
    read.grid = relief_of(picture, shape, arguments.file, findings);
    read.words = fmt::format("{} x {} pixels, {}, {}", picture.columns, picture.rows, picture.kind, arguments.channel);
  } else {
    read.is_body = looks_like_body(*bytes);
    const ForeignFile foreign = foreign_file(arguments.file, std::string_view(*bytes).substr(0, 1024));
    if (!read.is_body && foreign.kind == "an STL model") {
      findings.add(of_file("surface.stl", arguments.file, "this STL model is damaged",
                           "facets as text, or as many triangles as the header gives"));
      return std::nullopt;
    }
    const bool is_read = read.is_body || foreign.kind.empty() || foreign.kind == "a height map";
    if (!is_read) {
      findings.add(of_file("picture.unknown-kind", arguments.file, fmt::format("this is {}", foreign.kind),
                           "a PNG, JPEG or TIFF picture, an STL or 3MF file or a height map x,y,z"));
      return std::nullopt;
    }
    SurfaceFaces faces = read_faces(arguments.file, *bytes, findings);
    if (findings.any_error()) return std::nullopt;
    if (!read.is_body && (arguments.up != "z" || arguments.input_units != "mm")) {
      findings.add(of_file("relief.bad-body", arguments.file, "a height map cannot be turned or scaled",
                           "--up and --input-units for a model only"));
      return std::nullopt;
    }
    if (states_its_unit(*bytes) && arguments.input_units != "mm") {
      findings.add(of_file("relief.bad-body", arguments.file, "a 3MF file states its unit",
                           "no --input-units; --width scales the model"));
      return std::nullopt;
    }
    turn(arguments, faces.triangles);
    flip(side, faces.triangles);
    if (read.is_body && !is_plausible(arguments, faces.triangles, findings)) return std::nullopt;
    read.words = counted(faces.triangles.size(), "triangle") + ", seen from above";
    const std::size_t open = read.is_body ? open_edges(faces.triangles) : 0;
    if (open > 0) read.words += fmt::format("; open at {}", counted(open, "edge"));
    const double wide = size_of(faces.triangles, &SurfacePoint::x);
    const double high = size_of(faces.triangles, &SurfacePoint::z);
    shape.threads = job.program.threads;
    read.grid = relief_of({.faces = std::move(faces.triangles), .height = std::move(faces.height)}, shape,
                          arguments.file, findings);
    if (read.grid.columns > 0 && wide > 0)
      read.high = shape.depth.value_or(Mm(high * read.grid.width().value() / wide));
  }
  if (read.grid.columns == 0) return std::nullopt;
  return read;
}

// Where node (0, 0) is.
void place_relief(const CamReliefArguments& arguments, const HeightGrid& grid, ReliefReading& read,
                  ReliefProgramOptions& program) {
  const std::string& origin = arguments.origin;
  const double width = grid.width().value();
  const double length = grid.length().value();
  if (origin == "center" || origin == "centre") {
    program.x0 = Mm(-width / 2);
    program.y0 = Mm(-length / 2);
    return;
  }
  for (const bool is_right : {false, true}) {
    for (const bool is_upper : {false, true}) {
      if (origin != fmt::format("{}-{}", is_upper ? "upper" : "lower", is_right ? "right" : "left")) continue;
      program.x0 = Mm(is_right ? -width : 0);
      program.y0 = Mm(is_upper ? -length : 0);
      return;
    }
  }
  const Result<std::vector<Mm>, std::string> lengths = parse_lengths("--origin", origin, read.unit_mm());
  if (!lengths || lengths->size() != 2) {
    read.refuse(fmt::format(
        "--origin: expected lower-left, lower-right, upper-left, upper-right, center or X,Y, found '{}'", origin));
    return;
  }
  program.x0 = (*lengths)[0];
  program.y0 = (*lengths)[1];
}

std::string grid_words(const HeightGrid& grid) {
  const std::string pitch = std::abs(grid.pitch_x / grid.pitch_y - 1) < 1e-6
                                ? fmt::format("{:.4g}", grid.pitch_x.value())
                                : fmt::format("{:.4g} x {:.4g}", grid.pitch_x.value(), grid.pitch_y.value());
  return fmt::format("{:.6g} x {:.6g} mm, {:.5g} mm deep; {} x {} grid points, {} mm apart", grid.width().value(),
                     grid.length().value(), 0.0 - static_cast<double>(floor_of(grid)), grid.columns, grid.rows, pitch);
}

namespace {

std::string minutes_words(double minutes) {
  if (minutes < 1.5) return fmt::format("{:.0f} s", minutes * 60);
  if (minutes < 90) return fmt::format("{:.0f} min", minutes);
  return fmt::format("{:.0f} h {:02.0f} min", std::floor(minutes / 60), std::floor(std::fmod(minutes, 60)));
}

}  // namespace

std::string summary_of(const ReliefReport& report) {
  std::string text;
  for (const ReliefPart& part : report.parts) {
    std::string more =
        part.arcs > 0 ? fmt::format(", {} of them {}", part.arcs, part.arcs == 1 ? "an arc" : "arcs") : "";
    text += fmt::format(
        "{}: {}; {}{}{}, {:.2f} m of feeds, {:.2f} m of rapids, {} at the programmed feeds{}\n", part.what, part.tool,
        part.step.value() > 0 ? fmt::format("stepover {:.4g} mm, ", part.step.value()) : "",
        counted(part.moves, "move"), more, part.cut.value() / 1000, part.rapid.value() / 1000,
        minutes_words(part.minutes), part.removal > 0 ? fmt::format(", at most {:.0f} mm3/min", part.removal) : "");
  }
  return text;
}

nlohmann::ordered_json json_of(const ReliefReport& report) {
  nlohmann::ordered_json passes = nlohmann::ordered_json::array();
  for (const ReliefPart& part : report.parts) {
    passes.push_back({{"what", part.what},
                      {"tool", part.tool},
                      {"step_mm", part.step.value()},
                      {"moves", part.moves},
                      {"arcs", part.arcs},
                      {"feeds_mm", part.cut.value()},
                      {"rapids_mm", part.rapid.value()},
                      {"time_s", part.minutes * 60}});
    if (part.removal > 0) passes.back()["removal_mm3_min"] = part.removal;
  }
  return passes;
}

}  // namespace passo
