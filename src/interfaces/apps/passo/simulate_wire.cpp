// passo simulate --wire: melts a block of foam by a program, and says what is left.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <numbers>
#include <thread>

#include "named_files.hpp"
#include "picture_names.hpp"
#include "program_input.hpp"
#include "simulate_options.hpp"
#include "stock_arguments.hpp"
#include "wire_kerfs.hpp"
#include <fmt/format.h>

#include "passo/base/counted.hpp"
#include "passo/diagnostics/findings_json.hpp"
#include "passo/report/foam_body.hpp"
#include "passo/report/foam_picture.hpp"
#include "passo/stock/foam_comparison.hpp"
#include "passo/stock/wire_cutter.hpp"
#include "passo/surface_file/surface_file.hpp"

namespace passo {
namespace {

constexpr double mm3_a_cm3 = 1000;

struct WireJobOfProgram {
  ProgramReader program;
  InterpreterOptions options;
  std::optional<MachineDescription> machine = {};
  std::vector<WireKerf> kerfs = {};
  WishedBlock block = {};
  double span = 0;  // 0: not said
};

// What the first look at the program finds: the reach of the wire's ends, and whether U V move.
struct WireLook {
  Vector3 low{1e9, 1e9, 0};
  Vector3 high{-1e9, -1e9, 0};
  double lean = 0;  // the most that the wire's ends are apart in X Y, mm
  std::uint64_t moves = 0;
  bool has_four_axes = false;
};

struct WireMoves {
  double volume = 0;
  double least_kerf = std::numeric_limits<double>::infinity();
  double most_kerf = 0;
  std::uint32_t widest_line = 0;
  std::uint64_t cutting = 0;
  std::vector<WireCut> rapids = {};  // through foam, each stretch of them once
  std::uint64_t rapid_count = 0;
};

struct FoamSimulation {
  std::string program;
  std::string target;
  FoamBlock foam;
  double span = 0;
  WireLook look = {};
  WireMoves moves = {};
  double volume_before = 0;
  FoamPieces pieces = {};
  std::optional<FoamDifference> difference = {};
};

AxisSet right_end() {
  AxisSet axes;
  axes.add(Axis::u);
  axes.add(Axis::v);
  return axes;
}

// `use`: of each move of the wire. Before the first feed the wire is clear of the block: the first rapid is no move.
template <class Use>
void walk(const WireJobOfProgram& job, Diagnostics& findings, const Use& use) {
  SimulatedPath path(job.program.again(), job.options, job.machine ? &*job.machine : nullptr, findings, right_end());
  TipMove move;
  bool is_first = true;
  while (path.next(move)) {
    const bool is_way_to_start = is_first && move.segment->rapid;
    is_first = false;
    if (!is_way_to_start && !move.segment->takes_up_backlash) use(move);
  }
}

WireLook look_at(const WireJobOfProgram& job, Diagnostics& findings) {
  WireLook look;
  walk(job, findings, [&](const TipMove& move) {
    ++look.moves;
    const Box box = move.segment->curve.extents();
    const Point low = box.low - move.zero;
    const Point high = box.high - move.zero;
    look.has_four_axes = look.has_four_axes || low[Axis::u] != high[Axis::u] || low[Axis::v] != high[Axis::v];
    if (move.segment->rapid) return;
    const Point end = move.segment->curve.end() - move.zero;
    look.lean = std::max(look.lean, std::hypot(end[Axis::u] - end[Axis::x], end[Axis::v] - end[Axis::y]));
    look.low = {std::min(look.low.x, low[Axis::x]), std::min(look.low.y, low[Axis::y]), 0};
    look.high = {std::max(look.high.x, high[Axis::x]), std::max(look.high.y, high[Axis::y]), 0};
  });
  return look;
}

// The block that is wished for; else as far as the feeds of the left end reach, and from tower to tower.
StockBlock block_of(const WireJobOfProgram& job, const WireLook& look) {
  constexpr double usual_width = 100;  // mm
  const double width = job.span > 0 ? job.span : usual_width;
  const WishedBlock& wished = job.block;
  return {{wished.x.low.value_or(look.low.x), wished.y.low.value_or(look.low.y), wished.z.low.value_or(0)},
          {wished.x.high.value_or(look.high.x), wished.y.high.value_or(look.high.y), wished.z.high.value_or(width)}};
}

// At a speed that nobody knows the wire melts as little as was measured. Slower than the slowest measured speed it
// melts more, but no more than the heat of the move's time can: an area of width times speed a minute.
double kerf_of_move(const std::vector<WireKerf>& kerfs, double mm_per_second, double time) {
  if (std::isinf(mm_per_second)) return kerfs.back().width;
  const WireKerf& slowest = kerfs.front();
  const double speed = mm_per_second * seconds_per_minute;
  if (speed >= slowest.speed) return std::max(0.0, kerf_at(kerfs, speed));
  const double area = slowest.width * slowest.speed * time / seconds_per_minute;
  const double most = std::sqrt(slowest.width * slowest.width + 4 * area / std::numbers::pi);
  constexpr double least_speed = 1e-3;
  return std::min(most, kerf_at(kerfs, std::max(speed, least_speed)));
}

WireMoves melt(const WireJobOfProgram& job, const WireLook& look, unsigned threads, FoamBlock& foam) {
  constexpr std::size_t most_kept = 10;
  WireMoves moves;
  bool in_rapid = false;
  WireCutter cutter(foam,
                    {.has_four_axes = look.has_four_axes,
                     .span = job.span,
                     .kerf = [&](double speed, double time) { return kerf_of_move(job.kerfs, speed, time); },
                     .threads = threads},
                    [&](const WireCut& cut) {
                      const bool is_bad = cut.move.rapid && cut.volume > 0;
                      if (is_bad && !in_rapid && ++moves.rapid_count <= most_kept) moves.rapids.push_back(cut);
                      in_rapid = is_bad;
                      moves.volume += cut.volume;
                      if (!(cut.volume > 0) || cut.move.rapid) return;
                      ++moves.cutting;
                      moves.least_kerf = std::min(moves.least_kerf, cut.least_kerf);
                      if (cut.most_kerf > moves.most_kerf) moves.widest_line = cut.move.line;
                      moves.most_kerf = std::max(moves.most_kerf, cut.most_kerf);
                    });
  Diagnostics known;  // the first look has shown them
  walk(job, known, [&](const TipMove& move) {
    cutter.cut(move.segment->curve, move.zero,
               {.line = move.segment->source.line, .rapid = move.segment->rapid, .time = move.time});
  });
  cutter.finish();
  return moves;
}

void add_findings(const FoamSimulation& done, Diagnostics& findings) {
  const auto add = [&](const char* code, std::uint32_t line, std::string message, const char* expected) {
    findings.add({.severity = Severity::error,
                  .code = code,
                  .file = done.program,
                  .place = {.line = line, .column = 0, .length = 1},
                  .message = std::move(message),
                  .expected = expected,
                  .text = {}});
  };
  const auto at = [](const Vector3& place) {
    return fmt::format("X{:.2f} Y{:.2f} Z{:.2f}", place.x, place.y, place.z);
  };
  for (const WireCut& cut : done.moves.rapids) {
    add("simulate.rapid", cut.move.line, "the rapid pulls the wire through foam, at " + at(cut.place),
        "a path outside the block, or G1");
  }
  if (!done.difference || done.difference->sides.gouge.cells == 0) return;
  const FieldDifference::Side& gouge = done.difference->sides.gouge;
  add("simulate.gouge", 0,
      fmt::format("{:.3f} mm\u00B3 are melted out of {}, {:.3f} mm deep at {}", gouge.volume, done.target,
                  gouge.largest, at(gouge.place)),
      "");
}

std::string in_short(const FoamSimulation& done) {
  return fmt::format("kerf {:.2f} to {:.2f} mm   \u00B7   {:.1f} cm\u00B3 melted   \u00B7   {}, cells of {:g} mm",
                     done.moves.cutting > 0 ? done.moves.least_kerf : 0.0, done.moves.most_kerf,
                     (done.volume_before - done.foam.volume()) / mm3_a_cm3, counted(done.foam.slices(), "slice"),
                     done.foam.cell());
}

// A piece of less than a ten-thousandth of the largest is a crumb.
std::size_t pieces_that_count(const FoamPieces& pieces) {
  constexpr std::uint64_t share = 10'000;
  std::size_t count = 0;
  while (count < pieces.pieces.size() && pieces.pieces[count].cells * share >= pieces.pieces.front().cells) ++count;
  return count;
}

std::string to_text(const FoamSimulation& done) {
  const FoamBlock& foam = done.foam;
  const StockBlock& block = foam.block();
  std::string text =
      fmt::format("{}: {}, {} of them cut\n", done.program, counted(done.look.moves, "move"), done.moves.cutting);
  const auto add = [&](const char* name, const std::string& words) { text += fmt::format("{:<16}{}\n", name, words); };
  add("foam", fmt::format("X {:g} to {:g}, Y {:g} to {:g}, Z {:g} to {:g}; {} of {} x {} cells of {:g} mm", block.low.x,
                          block.high.x, block.low.y, block.high.y, block.low.z, block.high.z,
                          counted(foam.slices(), "slice"), foam.columns(), foam.rows(), foam.cell()));
  add("wire", done.look.has_four_axes ? fmt::format("X Y at Z 0, U V at Z {:g}", done.span) : "both ends by X Y");
  const double melted = done.volume_before - foam.volume();
  add("melted",
      fmt::format("{:.2f} cm\u00B3, {:.1f} % of the foam", melted / mm3_a_cm3, 100 * melted / done.volume_before));
  if (done.moves.cutting > 0)
    add("kerf", fmt::format("{:.3f} to {:.3f} mm, line {}", done.moves.least_kerf, done.moves.most_kerf,
                            done.moves.widest_line));
  const std::size_t count = pieces_that_count(done.pieces);
  std::string pieces = fmt::format("{}:", count);
  constexpr std::size_t most_named = 6;
  for (std::size_t i = 0; i < std::min(most_named, count); ++i) {
    pieces += fmt::format("{} {:.2f} cm\u00B3{}", i > 0 ? "," : "", done.pieces.volume(i, foam) / mm3_a_cm3,
                          done.pieces.pieces[i].at_side ? "" : " (cut free)");
  }
  if (count > most_named) pieces += ", \u2026";
  add("pieces", pieces);
  if (done.difference) {
    const auto side = [](const FieldDifference::Side& of) {
      return of.cells == 0 ? std::string("none")
                           : fmt::format("{:.3f} mm\u00B3, {:.3f} mm at most at X{:.2f} Y{:.2f} Z{:.2f}", of.volume,
                                         of.largest, of.place.x, of.place.y, of.place.z);
    };
    add("foam left", side(done.difference->sides.left));
    add("gouges", side(done.difference->sides.gouge));
  }
  return text;
}

nlohmann::ordered_json json_of(const Vector3& place) {
  return {{"x", place.x}, {"y", place.y}, {"z", place.z}};
}

std::string to_json(const FoamSimulation& done, const Diagnostics& findings) {
  const FoamBlock& foam = done.foam;
  nlohmann::ordered_json pieces = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < pieces_that_count(done.pieces); ++i) {
    pieces.push_back({{"mm3", done.pieces.volume(i, foam)}, {"cut_free", !done.pieces.pieces[i].at_side}});
  }
  nlohmann::ordered_json json = {{"good", !findings.any_error()},
                                 {"moves", done.look.moves},
                                 {"cutting_moves", done.moves.cutting},
                                 {"axes", done.look.has_four_axes ? "XYUV" : "XY"},
                                 {"foam",
                                  {{"low", json_of(foam.block().low)},
                                   {"high", json_of(foam.block().high)},
                                   {"cell_mm", foam.cell()},
                                   {"columns", foam.columns()},
                                   {"rows", foam.rows()},
                                   {"slices", foam.slices()}}},
                                 {"melted_mm3", done.volume_before - foam.volume()},
                                 {"left_mm3", foam.volume()},
                                 {"least_kerf_mm", done.moves.cutting > 0 ? done.moves.least_kerf : 0.0},
                                 {"most_kerf_mm", done.moves.most_kerf},
                                 {"most_kerf_line", done.moves.widest_line},
                                 {"pieces", std::move(pieces)},
                                 {"rapids_through_foam", done.moves.rapid_count}};
  if (done.difference) {
    const auto side = [](const FieldDifference::Side& of) {
      nlohmann::ordered_json one = {{"volume_mm3", of.volume}, {"largest_mm", of.largest}, {"cells", of.cells}};
      if (of.cells > 0) one["place"] = json_of(of.place);
      return one;
    };
    json["foam_left"] = side(done.difference->sides.left);
    json["gouges"] = side(done.difference->sides.gouge);
  }
  json["findings"] = passo::findings_json(findings.all());
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

// Writes a file whole or not at all.
template <class Write>
int write_file(const std::string& path, const Write& write) {
  Result<OutputFile, OutputError> file = OutputFile::open(path);
  if (!file) return fail(exit_failed, file.error().message);
  Status<OutputError> done = write(*file);
  if (done) done = file->commit();
  return done ? exit_done : fail(exit_failed, done.error().message);
}

int write_files(const SimulateArguments& arguments, const FoamSimulation& done) {
  for (const std::string& path : arguments.pictures) {
    const PictureOptions options{.format = *picture_format_of(path),
                                 .program = std::filesystem::path(done.program).filename().string(),
                                 .machine = in_short(done)};
    const FoamDrawing drawing{done.foam, done.pieces, done.difference ? &*done.difference : nullptr,
                              done.look.has_four_axes};
    const int code = write_file(path, [&](OutputFile& file) { return draw_foam(drawing, options, file); });
    if (code != exit_done) return code;
  }
  if (arguments.stl.empty()) return exit_done;
  return write_file(arguments.stl, [&](OutputFile& file) {
    write_foam_body(done.foam, arguments.stl_step.value_or(usual_body_step(done.foam)), file);
    return Status<OutputError>(Unit{});
  });
}

// The difference from the target. Nothing, with a message: the file is wrong.
std::optional<FoamDifference> difference_from(const SimulateArguments& arguments, const FoamSimulation& done) {
  Diagnostics findings;
  const std::vector<SurfaceTriangle> triangles = read_triangles(arguments.compare, findings);
  show(findings);
  if (findings.any_error()) return std::nullopt;
  std::vector<BodyTriangle> body;
  body.reserve(triangles.size());
  const auto corner = [](const SurfacePoint& point) { return Vector3{point.x, point.y, point.z}; };
  for (const SurfaceTriangle& triangle : triangles) {
    body.push_back({corner(triangle[0]), corner(triangle[1]), corner(triangle[2])});
  }
  return compare_foam(done.foam, done.pieces, body, Mm(arguments.tolerance));
}

int simulate_foam(const SimulateArguments& arguments, const WireJobOfProgram& job) {
  Diagnostics errors;
  const WireLook look = look_at(job, errors);
  show(errors);
  if (errors.any_error()) return exit_bad_program;
  if (look.moves == 0 || look.low.x > look.high.x) {
    return fail(exit_bad_program, "the program has no feed moves [simulate.no-move]");
  }
  if (look.has_four_axes && !(job.span > 0)) {
    return fail(exit_bad_program, "the program moves U and V, so it needs --span (between the towers)");
  }
  const StockBlock block = block_of(job, look);
  if (look.has_four_axes && (block.low.z < 0 || block.high.z > job.span)) {
    return fail(exit_bad_program,
                fmt::format("--stock: expected foam between the towers, Z 0 to {:g} [simulate.stock]", job.span));
  }
  const double shift = look.has_four_axes ? look.lean / job.span * (block.high.z - block.low.z) : 0;
  const double kerf = job.kerfs.back().width;
  const Mm cell = arguments.stock.cell ? Mm(*arguments.stock.cell) : FoamBlock::usual_cell(block, shift, kerf);
  const std::size_t slices = arguments.slices.value_or(FoamBlock::needed_slices(shift, cell, kerf));
  Result<FoamBlock, FieldRefusal> foam = FoamBlock::create(block, cell, slices);
  if (!foam) return fail(exit_bad_program, foam.error().message + " [simulate.stock]");
  FoamSimulation done{.program = arguments.program.program,
                      .target = arguments.compare,
                      .foam = std::move(*foam),
                      .span = job.span,
                      .look = look};
  done.volume_before = done.foam.volume();
  const unsigned threads = arguments.threads > 0 ? arguments.threads : std::thread::hardware_concurrency();
  done.moves = melt(job, look, threads, done.foam);
  done.pieces = pieces_of(done.foam);
  if (!arguments.compare.empty()) {
    done.difference = difference_from(arguments, done);
    if (!done.difference) return exit_bad_program;
  }
  if (const int code = write_files(arguments, done); code != exit_done) return code;
  Diagnostics findings(std::numeric_limits<std::size_t>::max());
  add_findings(done, findings);
  if (!arguments.json) show(findings);
  std::fputs((arguments.json ? to_json(done, findings) : to_text(done)).c_str(), stdout);
  return findings.any_error() ? exit_failed : exit_done;
}

}  // namespace

int simulate_wire(const SimulateArguments& arguments) {
  for (const std::string& picture : arguments.pictures) {
    if (const std::string why = refuse_picture(picture); !why.empty()) return fail(exit_bad_program, why);
  }
  LengthArguments lengths(1);
  const std::vector<WireKerf> kerfs = kerfs_of("--wire", arguments.wire, std::nullopt, lengths);
  const double span = arguments.span.empty() ? 0 : to_mm(lengths.above_0("--span", arguments.span)).value();
  if (!lengths.message().empty()) return fail(exit_bad_program, lengths.message());
  WishedBlock block;
  if (!arguments.stock.block.empty()) {
    const Result<WishedBlock, std::string> wished = parse_block("--stock", arguments.stock.block);
    if (!wished) return fail(exit_bad_program, wished.error());
    block = *wished;
  }
  std::optional<MachineDescription> machine;
  if (!arguments.machine.empty()) {
    Diagnostics of_machine;
    machine = load_machine_file(arguments.machine, of_machine);
    show(of_machine);
    if (!machine) return exit_bad_machine;
  }
  std::optional<ProgramReader> program = streamed_program(arguments.program);
  const std::optional<InterpreterOptions> options = interpreter_options(arguments.program);
  if (!program || !options) return exit_bad_program;
  NamedFiles files = files_of(arguments.program, *options);
  files.reads("--machine", arguments.machine);
  files.reads("--compare", arguments.compare);
  for (const std::string& picture : arguments.pictures) files.writes("--picture", picture);
  files.writes("--stl", arguments.stl);
  if (!files.are_apart()) return exit_bad_program;
  return simulate_foam(arguments, {std::move(*program), *options, std::move(machine), kerfs, block, span});
}

}  // namespace passo
