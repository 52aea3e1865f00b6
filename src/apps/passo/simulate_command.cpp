// passo simulate: cuts a piece of stock by a program, and says what would go wrong and how it would look.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <map>
#include <thread>

#include "named_files.hpp"
#include "program_input.hpp"
#include "progress_display.hpp"
#include "simulate_options.hpp"
#include "simulate_report.hpp"
#include "simulated_path.hpp"
#include "stock_arguments.hpp"
#include <fmt/format.h>

#include "passo/report/output_file.hpp"
#include "passo/report/stock_body.hpp"
#include "passo/report/stock_picture.hpp"
#include "passo/surface_file/surface_file.hpp"

namespace passo {
namespace {

// Where the tool stands before the first move, above the stock.
constexpr double start_height = 50;  // mm
// How much thicker the stock is than the deepest feed, where nobody says.
constexpr double usual_rest = 2;  // mm

struct Wishes {
  WishedBlock block;
  ToolShapes shapes;
  std::optional<ToolShape> any_tool;
  std::vector<StockBlock> clamps;
  std::optional<MachineDescription> machine;
};

// A program that is cut, with what it was read with.
struct Job {
  ProgramReader program;
  InterpreterOptions options;
};

struct Reach {
  Vector3 low{1e9, 1e9, 1e9};
  Vector3 high{-1e9, -1e9, -1e9};
  bool any() const { return low.x <= high.x; }
};

// What the first look at a program finds.
struct FirstPass {
  Reach feeds;                                  // of the tools' edges in X and Y, of the tip in Z
  std::map<std::int32_t, std::uint32_t> tools;  // that feed, with the line of their first feed
  double zero = 0;                              // Z of the work's zero, machine coordinates
  std::uint64_t moves = 0;
};

// The end of a file's name in lower case: ".stl".
std::string end_of_name(const std::string& path) {
  std::string end = std::filesystem::path(path).extension().string();
  std::ranges::transform(end, end.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return end;
}

bool is_surface(const std::string& path) {
  const std::string end = end_of_name(path);
  return end == ".stl" || end == ".csv" || end == ".xyz";
}

bool is_image(const std::string& path) {
  const std::string end = end_of_name(path);
  return end == ".png" || end == ".jpg" || end == ".jpeg" || end == ".tif" || end == ".tiff";
}

// The refusals of the command line come as messages.
Result<Wishes, std::string> wishes_of(const SimulateArguments& arguments) {
  Wishes wishes;
  if (!arguments.stock.empty()) {
    Result<WishedBlock, std::string> block = parse_block("--stock", arguments.stock);
    if (!block) return Failure{block.error()};
    wishes.block = *block;
  }
  for (const std::string& text : arguments.clamps) {
    Result<StockBlock, std::string> clamp = parse_clamp(text);
    if (!clamp) return Failure{clamp.error()};
    wishes.clamps.push_back(*clamp);
  }
  for (const std::string& text : arguments.tools) {
    Result<WishedTool, std::string> tool = parse_tool(text);
    if (!tool) return Failure{tool.error()};
    if (tool->number) {
      wishes.shapes[*tool->number] = tool->shape;
    } else {
      wishes.any_tool = tool->shape;
    }
  }
  if (is_image(arguments.compare)) {
    return Failure{"--compare: " + arguments.compare +
                   " is an image; expected a body (.stl), a height map (.csv) or a program"};
  }
  for (const std::string& picture : arguments.pictures) {
    if (!picture_format_of(picture)) return Failure{picture + ": a picture's name ends in .svg or .png"};
  }
  return wishes;
}

// An option goes before the file of tools, and the file before the tool table of the machine.
std::optional<ToolShape> shape_of(const Wishes& wishes, const InterpreterOptions& options, std::int32_t number) {
  if (const auto found = wishes.shapes.find(number); found != wishes.shapes.end()) return found->second;
  if (wishes.any_tool) return wishes.any_tool;
  const Tool* const tool = options.tools.find(number);
  if (tool == nullptr || tool->diameter == Mm(0)) return std::nullopt;
  return ToolShape{.kind = ToolShape::Kind::flat, .radius = Mm(std::abs(tool->diameter.value()) / 2)};
}

FirstPass look(const Job& job, const Wishes& wishes, Diagnostics& findings) {
  FirstPass pass;
  SimulatedPath path(job.program.again(), job.options, wishes.machine ? &*wishes.machine : nullptr, findings);
  TipMove move;
  FindingsDisplay display(findings);
  while (path.next(move)) {
    if (pass.moves++ == 0) pass.zero = move.zero.z;
    display.update();
    if (move.segment->rapid) continue;
    pass.tools.try_emplace(move.tool, move.segment->source.line);
    const Box box = move.segment->curve.extents();
    const auto shape = shape_of(wishes, job.options, move.tool);
    const double radius = shape ? shape->radius.value() : 0;
    const Vector3 low = Vector3::of(box.low) - move.zero - Vector3{radius, radius, 0};
    const Vector3 high = Vector3::of(box.high) - move.zero + Vector3{radius, radius, 0};
    Reach& feeds = pass.feeds;
    feeds.low = {std::min(feeds.low.x, low.x), std::min(feeds.low.y, low.y), std::min(feeds.low.z, low.z)};
    feeds.high = {std::max(feeds.high.x, high.x), std::max(feeds.high.y, high.y), std::max(feeds.high.z, high.z)};
  }
  display.finish();
  return pass;
}

// The block that is wished for, and otherwise what the feeds need: the top at 0 where they go below.
Result<StockBlock, std::string> block_of(const WishedBlock& wished, const Reach& feeds) {
  const auto all = {wished.x.low, wished.x.high, wished.y.low, wished.y.high, wished.z.low, wished.z.high};
  const bool is_whole = std::ranges::all_of(all, [](const auto& end) { return end.has_value(); });
  if (!is_whole && !feeds.any())
    return Failure{std::string("the program has no feed: say with --stock how large the stock is")};
  const double top = feeds.low.z < 0 ? 0 : feeds.high.z;
  StockBlock block;
  block.low = {wished.x.low.value_or(feeds.low.x), wished.y.low.value_or(feeds.low.y),
               wished.z.low.value_or(feeds.low.z - usual_rest)};
  block.high = {wished.x.high.value_or(feeds.high.x), wished.y.high.value_or(feeds.high.y),
                wished.z.high.value_or(top)};
  return block;
}

// Cuts the field. `pass` is of the same program.
CutSummary cut(const Job& job, const Wishes& wishes, const FirstPass& pass, const std::vector<ToolShape>& tools,
               unsigned threads, HeightField& field) {
  std::map<std::int32_t, std::size_t> places;
  for (const auto& [number, line] : pass.tools) places.emplace(number, places.size());
  CutSummary summary(tools);
  StockCutter cutter(field, {.tools = tools, .clamps = wishes.clamps, .threads = threads},
                     [&](const MoveCut& done) { summary.add(done); });
  Diagnostics findings;  // the first look has shown them
  InterpreterOptions options = job.options;
  options.start[Axis::z] += pass.zero + field.top() + start_height;
  SimulatedPath path(job.program.again(), options, wishes.machine ? &*wishes.machine : nullptr, findings);
  ProgressDisplay progress(job.program.name());
  TipMove move;
  for (std::uint64_t moves = 0; path.next(move); ++moves) {
    constexpr std::uint64_t moves_between_looks = 8192;
    if (moves % moves_between_looks == 0) progress.update(static_cast<double>(moves) / static_cast<double>(pass.moves));
    // A tool that only goes to where another one is taken up need not have a shape.
    const auto place = places.find(move.tool);
    if (place == places.end() || move.segment->takes_up_backlash) continue;
    cutter.cut(move.segment->curve, move.zero,
               {.line = move.segment->source.line,
                .tool = place->second,
                .rapid = move.segment->rapid,
                .time = move.time,
                .rounding = wishes.machine ? move.segment->tolerance : Mm(0)});
  }
  cutter.finish();
  return summary;
}

// Nothing, with a message: a tool has no shape.
std::optional<std::vector<ToolShape>> tools_of(const Job& job, const Wishes& wishes, const FirstPass& pass) {
  std::vector<ToolShape> tools;
  Diagnostics findings;
  for (const auto& [number, line] : pass.tools) {
    const auto shape = shape_of(wishes, job.options, number);
    tools.push_back(shape.value_or(ToolShape{}));
    if (shape) continue;
    findings.add({.severity = Severity::error,
                  .code = "simulate.no-tool",
                  .file = job.program.name(),
                  .place = {.line = line, .column = 0, .length = 1},
                  .message = fmt::format("nobody says what shape T{} has", number),
                  .expected = fmt::format("--tool {}=flat:6, or a --tool-table", number),
                  .text = {}});
  }
  show(findings);
  if (findings.any_error()) return std::nullopt;
  return tools;
}

std::vector<std::int32_t> numbers_of(const FirstPass& pass) {
  std::vector<std::int32_t> numbers;
  for (const auto& [number, line] : pass.tools) numbers.push_back(number);
  return numbers;
}

// The field as the target has it: the face of a body, or what another program leaves. Nothing, with a message.
std::optional<HeightField> target_of(const SimulateArguments& arguments, const Wishes& wishes, const HeightField& field,
                                     unsigned threads) {
  HeightField target = *HeightField::create(field.block(), Mm(field.cell()));
  Diagnostics findings;
  if (is_surface(arguments.compare)) {
    const Surface surface = read_surface(arguments.compare, findings);
    show(findings);
    if (findings.any_error()) return std::nullopt;
    for (std::size_t row = 0; row < target.rows(); ++row) {
      for (std::size_t column = 0; column < target.columns(); ++column) {
        const double top = surface.top(target.x_of(column), target.y_of(row));
        target.set_height(column, row, top);
      }
    }
    return target;
  }
  ProgramArguments program = arguments.program;
  program.program = arguments.compare;
  std::optional<ProgramReader> reader = open_program(program);
  const std::optional<InterpreterOptions> options = interpreter_options(program);
  if (!reader || !options) return std::nullopt;
  const Job job{std::move(*reader), *options};
  const FirstPass pass = look(job, wishes, findings);
  if (findings.any_error()) return std::nullopt;
  const auto tools = tools_of(job, wishes, pass);
  if (!tools) return std::nullopt;
  cut(job, wishes, pass, *tools, threads, target);
  return target;
}

int write_picture(const std::string& path, const SimulateArguments& arguments, const Simulation& simulation,
                  const HeightField* target) {
  Result<OutputFile, OutputError> file = OutputFile::open(path);
  if (!file) return fail(exit_failed, file.error().message);
  const PictureOptions options{.format = *picture_format_of(path),
                               .program = std::filesystem::path(arguments.program.program).filename().string(),
                               .machine = in_short(simulation)};
  Status<OutputError> done = draw_stock({simulation.field, target, Mm(arguments.tolerance)}, options, *file);
  if (done) done = file->commit();
  return done ? exit_done : fail(exit_failed, done.error().message);
}

int write_files(const SimulateArguments& arguments, const Simulation& simulation, const HeightField* target) {
  for (const std::string& picture : arguments.pictures) {
    if (const int code = write_picture(picture, arguments, simulation, target); code != exit_done) return code;
  }
  if (arguments.stl.empty()) return exit_done;
  Result<OutputFile, OutputError> file = OutputFile::open(arguments.stl);
  if (!file) return fail(exit_failed, file.error().message);
  write_stock_body(simulation.field, arguments.stl_step.value_or(usual_body_step(simulation.field)), *file);
  const Status<OutputError> done = file->commit();
  return done ? exit_done : fail(exit_failed, done.error().message);
}

// Reads the files of tools and machine into the wishes. Returns an exit code.
int read_files(const SimulateArguments& arguments, Wishes& wishes) {
  Diagnostics findings;
  if (!arguments.tool_table.empty()) {
    const auto shapes = read_tool_shapes(arguments.tool_table, findings);
    show(findings);
    if (!shapes) return exit_bad_program;
    // A tool of an option keeps its shape.
    wishes.shapes.insert(shapes->begin(), shapes->end());
  }
  if (arguments.machine.empty()) return exit_done;
  Diagnostics of_machine;
  wishes.machine = load_machine_file(arguments.machine, of_machine);
  show(of_machine);
  return wishes.machine ? exit_done : exit_bad_machine;
}

int simulate_job(const SimulateArguments& arguments, const Wishes& wishes, const Job& job) {
  Diagnostics errors;
  const FirstPass pass = look(job, wishes, errors);
  if (errors.any_error()) return exit_bad_program;
  if (pass.moves == 0) return fail(exit_bad_program, "the program has no move [simulate.no-move]");
  const auto tools = tools_of(job, wishes, pass);
  if (!tools) return exit_bad_program;
  const Result<StockBlock, std::string> block = block_of(wishes.block, pass.feeds);
  if (!block) return fail(exit_bad_program, block.error() + " [simulate.stock]");
  const Mm cell = arguments.cell ? Mm(*arguments.cell) : HeightField::usual_cell(*block);
  Result<HeightField, FieldRefusal> field = HeightField::create(*block, cell);
  if (!field) return fail(exit_bad_program, field.error().message + " [simulate.stock]");
  const unsigned threads = arguments.threads > 0 ? arguments.threads : std::thread::hardware_concurrency();

  const double volume_before = field->volume();
  CutSummary summary = cut(job, wishes, pass, *tools, threads, *field);
  Simulation simulation{.program = arguments.program.program,
                        .target = arguments.compare,
                        .field = std::move(*field),
                        .volume_before = volume_before,
                        .numbers = numbers_of(pass),
                        .tools = *tools,
                        .summary = std::move(summary)};
  std::optional<HeightField> target;
  if (!arguments.compare.empty()) {
    target = target_of(arguments, wishes, simulation.field, threads);
    if (!target) return exit_bad_program;
    simulation.difference = compare_fields(simulation.field, *target, Mm(arguments.tolerance));
  }
  if (const int code = write_files(arguments, simulation, target ? &*target : nullptr); code != exit_done) return code;
  Diagnostics findings(std::numeric_limits<std::size_t>::max());
  add_findings(simulation, findings);
  if (!arguments.json) show(findings);
  std::fputs((arguments.json ? to_json(simulation, findings) : to_text(simulation)).c_str(), stdout);
  return findings.any_error() ? exit_failed : exit_done;
}

}  // namespace

int simulate(const SimulateArguments& arguments) {
  Result<Wishes, std::string> wishes = wishes_of(arguments);
  if (!wishes) return fail(exit_bad_program, wishes.error());
  if (const int code = read_files(arguments, *wishes); code != exit_done) return code;
  std::optional<ProgramReader> program = open_program(arguments.program);
  const std::optional<InterpreterOptions> options = interpreter_options(arguments.program);
  if (!program || !options) return exit_bad_program;
  NamedFiles files = files_of(arguments.program, *options);
  files.reads("--tool-table", arguments.tool_table);
  files.reads("--machine", arguments.machine);
  files.reads("--compare", arguments.compare);
  for (const std::string& picture : arguments.pictures) files.writes("--picture", picture);
  files.writes("--stl", arguments.stl);
  if (!files.are_apart()) return exit_bad_program;
  return simulate_job(arguments, *wishes, {std::move(*program), *options});
}

}  // namespace passo
