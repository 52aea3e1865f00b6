// passo simulate: cuts a piece of stock by a program, and says what would go wrong and how it would look.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <thread>

#include "named_files.hpp"
#include "picture_names.hpp"
#include "program_input.hpp"
#include "progress_display.hpp"
#include "simulate_options.hpp"
#include "simulate_report.hpp"
#include "stock_setup.hpp"
#include <fmt/format.h>

#include "passo/diagnostics/file_bytes.hpp"
#include "passo/report/output_file.hpp"
#include "passo/report/stock_body.hpp"
#include "passo/report/stock_picture.hpp"
#include "passo/surface_file/surface_file.hpp"

namespace passo {
namespace {

struct Wishes {
  StockWishes stock;
  std::optional<MachineDescription> machine;
};

// The end of a file's name in lower case: ".stl".
std::string end_of_name(const std::string& path) {
  std::string end = std::filesystem::path(path).extension().string();
  std::ranges::transform(end, end.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return end;
}

bool is_surface(const std::string& path) {
  const std::string end = end_of_name(path);
  return end == ".stl" || end == ".3mf" || end == ".csv" || end == ".xyz";
}

bool is_image(const std::string& path) {
  const std::string end = end_of_name(path);
  return end == ".png" || end == ".jpg" || end == ".jpeg" || end == ".tif" || end == ".tiff";
}

// What is wrong with the other arguments. Empty: nothing.
std::string refusal_of(const SimulateArguments& arguments) {
  if (is_image(arguments.compare)) {
    return "--compare: " + arguments.compare +
           " is an image; expected a model (.stl, .3mf), a height map (.csv) or a program";
  }
  for (const std::string& picture : arguments.pictures) {
    if (std::string why = refuse_picture(picture); !why.empty()) return why;
  }
  return "";
}

// Cuts the field. `look` is of the same program.
CutSummary cut(const StockJob& job, const Wishes& wishes, const FeedLook& look, const std::vector<ToolShape>& tools,
               unsigned threads, HeightField& field) {
  CutSummary summary(tools);
  ProgressDisplay progress(job.program.name());
  CutHooks hooks;
  hooks.cut = [&](const MoveCut& done) { summary.add(done); };
  hooks.progress = [&](double share) { progress.update(share); };
  cut_stock(job, wishes.stock, look, tools, threads, field, hooks);
  return summary;
}

// The highest that the stock may be in each cell: cut by tools that are thinner, and then raised by what their tips are
// too high.
HeightField at_most(const StockJob& job, const Wishes& wishes, const FeedLook& look,
                    const std::vector<ToolShape>& tools, unsigned threads, const HeightField& field) {
  HeightField highest = *HeightField::create(field.block(), Mm(field.cell()));
  const Mm thinner = thinner_for(Mm(field.cell()));
  std::vector<ToolShape> thin = tools;
  Mm tip{0};
  for (ToolShape& tool : thin) {
    tip = std::max(tip, thinned_tip(tool.cutter, thinner));
    const bool has_neck = tool.neck_radius > Mm(0);
    const Mm neck = has_neck ? std::max(tool.neck_radius - thinner, Mm(1e-3)) : Mm(0);
    tool = ToolShape{.cutter = thinned(tool.cutter, thinner), .neck_radius = neck};
  }
  cut_stock(job, wishes.stock, look, thin, threads, highest, {});
  for (std::size_t row = 0; row < highest.rows(); ++row) {
    float* const heights = highest.below_top(row);
    for (std::size_t i = 0; i < highest.columns(); ++i) {
      heights[i] = std::min(0.0F, heights[i] + static_cast<float>(tip.value()));
    }
  }
  return highest;
}

// The target at the cells of the field: the face of a body, or what another program leaves. Nothing, with a message.
std::optional<CutTarget> read_target(const SimulateArguments& arguments, const Wishes& wishes, const HeightField& field,
                                     unsigned threads) {
  Diagnostics findings;
  if (is_surface(arguments.compare)) {
    const auto bytes =
        read_bytes(arguments.compare, {.area = "surface", .expected = "an STL or 3MF file or a height map"}, findings);
    SurfaceFaces faces = bytes ? read_faces(arguments.compare, *bytes, findings) : SurfaceFaces();
    show(findings);
    if (findings.any_error()) return std::nullopt;
    // Between the points of a height map, its triangles are not the surface.
    const std::vector<SurfaceTriangle> flat = faces.height ? std::vector<SurfaceTriangle>() : faces.triangles;
    CutTarget target = target_of(flat, Surface(std::move(faces.triangles), std::move(faces.height)), field);
    // The rim that the program's own stock has is no part of the model.
    if (!arguments.stock.block.empty()) target.is_beside.clear();
    return target;
  }
  HeightField target = *HeightField::create(field.block(), Mm(field.cell()));
  ProgramArguments program = arguments.program;
  program.program = arguments.compare;
  std::optional<ProgramReader> reader = streamed_program(program);
  const std::optional<InterpreterOptions> options = interpreter_options(program);
  if (!reader || !options) return std::nullopt;
  const StockJob job{std::move(*reader), *options, wishes.machine ? &*wishes.machine : nullptr};
  const FeedLook look = shown_feeds(job, wishes.stock, findings);
  if (findings.any_error()) return std::nullopt;
  const auto tools = shapes_or_message(job, wishes.stock, look);
  if (!tools) return std::nullopt;
  cut(job, wishes, look, *tools, threads, target);
  return target_of(target);
}

int write_picture(const std::string& path, const SimulateArguments& arguments, const Simulation& simulation,
                  const CutTarget* target) {
  Result<OutputFile, OutputError> file = OutputFile::open(path);
  if (!file) return fail(exit_failed, file.error().message);
  const PictureOptions options{.format = *picture_format_of(path),
                               .program = std::filesystem::path(arguments.program.program).filename().string(),
                               .machine = in_short(simulation)};
  Status<OutputError> done = draw_stock({simulation.field, target, Mm(arguments.tolerance)}, options, *file);
  if (done) done = file->commit();
  return done ? exit_done : fail(exit_failed, done.error().message);
}

// The stock as a body: between the cells, its walls are cut a second time.
int write_stl(const SimulateArguments& arguments, const StockJob& job, const FeedLook& look, unsigned threads,
              const Simulation& simulation) {
  const std::size_t step = arguments.stl_step.value_or(usual_body_step(simulation.field));
  WallHeights walls = WallHeights::at_walls_of(simulation.field, step);
  cut_walls(job, look, simulation.tools, threads, simulation.field, walls);
  Result<OutputFile, OutputError> file = OutputFile::open(arguments.stl);
  if (!file) return fail(exit_failed, file.error().message);
  write_stock_body(simulation.field, step, walls, *file);
  const Status<OutputError> done = file->commit();
  return done ? exit_done : fail(exit_failed, done.error().message);
}

int write_pictures(const SimulateArguments& arguments, const Simulation& simulation, const CutTarget* target) {
  for (const std::string& picture : arguments.pictures) {
    if (const int code = write_picture(picture, arguments, simulation, target); code != exit_done) return code;
  }
  return exit_done;
}

// Reads the files of tools and machine into the wishes. Returns an exit code.
int read_files(const SimulateArguments& arguments, Wishes& wishes) {
  if (!add_tool_shapes(arguments.stock.tool_table, wishes.stock)) return exit_bad_program;
  if (arguments.machine.empty()) return exit_done;
  Diagnostics of_machine;
  wishes.machine = load_machine_file(arguments.machine, of_machine);
  show(of_machine);
  return wishes.machine ? exit_done : exit_bad_machine;
}

int simulate_job(const SimulateArguments& arguments, const Wishes& wishes, const StockJob& job) {
  Diagnostics errors;
  const FeedLook look = shown_feeds(job, wishes.stock, errors);
  if (errors.any_error()) return exit_bad_program;
  if (look.moves == 0) return fail(exit_bad_program, "the program has no moves [simulate.no-move]");
  const auto tools = shapes_or_message(job, wishes.stock, look);
  if (!tools) return exit_bad_program;
  std::optional<HeightField> field = field_or_message(wishes.stock, look);
  if (!field) return exit_bad_program;
  const unsigned threads = arguments.threads > 0 ? arguments.threads : std::thread::hardware_concurrency();

  const double volume_before = field->volume();
  CutSummary summary = cut(job, wishes, look, *tools, threads, *field);
  Simulation simulation{.program = arguments.program.program,
                        .target = arguments.compare,
                        .field = std::move(*field),
                        .volume_before = volume_before,
                        .numbers = look.numbers(),
                        .tools = *tools,
                        .summary = std::move(summary)};
  std::optional<CutTarget> target;
  if (!arguments.compare.empty()) {
    target = read_target(arguments, wishes, simulation.field, threads);
    if (!target) return exit_bad_program;
    const Mm cell(simulation.field.cell());
    const bool is_body = is_surface(arguments.compare);
    if (is_body) target->at_most = at_most(job, wishes, look, *tools, threads, simulation.field);
    simulation.difference = compare_fields(simulation.field, *target, Mm(arguments.tolerance));
    Mm tip{0};
    for (const ToolShape& tool : *tools) tip = std::max(tip, thinned_tip(tool.cutter, thinner_for(cell)));
    simulation.difference->unseen_depth = arguments.tolerance + (is_body ? tip.value() : 0);
    // A whole cell must be cut before it counts, the thinner tool must reach its middle, and a wall may be a cell off.
    const double sideways = is_body ? std::sqrt(2) + 1 + thinner_for(cell) / cell : 2;
    simulation.difference->unseen_sideways = sideways * cell.value();
  }
  int code = write_pictures(arguments, simulation, target ? &*target : nullptr);
  if (code == exit_done && !arguments.stl.empty()) code = write_stl(arguments, job, look, threads, simulation);
  if (code != exit_done) return code;
  Diagnostics findings(std::numeric_limits<std::size_t>::max());
  add_findings(simulation, findings);
  if (!arguments.json) show(findings);
  std::fputs((arguments.json ? to_json(simulation, findings) : to_text(simulation)).c_str(), stdout);
  return findings.any_error() ? exit_failed : exit_done;
}

}  // namespace

int simulate(const SimulateArguments& arguments) {
  if (!arguments.wire.empty()) return simulate_wire(arguments);
  Result<StockWishes, std::string> stock = stock_wishes(arguments.stock);
  if (!stock) return fail(exit_bad_program, stock.error());
  if (const std::string refusal = refusal_of(arguments); !refusal.empty()) return fail(exit_bad_program, refusal);
  Wishes wishes{.stock = std::move(*stock), .machine = {}};
  if (const int code = read_files(arguments, wishes); code != exit_done) return code;
  std::optional<ProgramReader> program = streamed_program(arguments.program);
  const std::optional<InterpreterOptions> options = interpreter_options(arguments.program);
  if (!program || !options) return exit_bad_program;
  NamedFiles files = files_of(arguments.program, *options);
  files.reads("--tool-table", arguments.stock.tool_table);
  files.reads("--machine", arguments.machine);
  files.reads("--compare", arguments.compare);
  for (const std::string& picture : arguments.pictures) files.writes("--picture", picture);
  files.writes("--stl", arguments.stl);
  if (!files.are_apart()) return exit_bad_program;
  return simulate_job(arguments, wishes, {std::move(*program), *options, wishes.machine ? &*wishes.machine : nullptr});
}

}  // namespace passo
