// passo cam relief --two-sided: the programs for both sides of a model, the dowel holes about which the stock is
// flipped, pictures, and a page with step-by-step instructions.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>

#include "background_process.hpp"
#include "cam_board_page.hpp"
#include "cam_job.hpp"
#include "cam_program.hpp"
#include "cam_relief_job.hpp"
#include "cam_tools.hpp"
#include "progress_display.hpp"
#include "unfinished_job.hpp"
#include <nlohmann/json.hpp>

#include "passo/base/counted.hpp"
#include "passo/carve/two_sided_relief.hpp"
#include "passo/diagnostics/file_bytes.hpp"
#include "passo/report/flip_picture.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;

// Options that have no meaning, or a different one, for a part with two sides.
std::string refused_for_sides(const CamReliefArguments& arguments) {
  const std::pair<bool, const char*> options[] = {{!arguments.within.empty(), "--within"},
                                                  {arguments.invert, "--invert"},
                                                  {arguments.mirror, "--mirror"},
                                                  {arguments.gamma != 1, "--gamma"},
                                                  {!arguments.lowest_z.empty(), "--lowest-z"},
                                                  {!arguments.overrun.empty(), "--overrun"},
                                                  {arguments.margin != CamReliefArguments().margin, "--margin"},
                                                  {!arguments.picture.empty(), "--picture"}};
  for (const auto& [is_given, name] : options) {
    if (is_given) return fmt::format("--two-sided: cannot be combined with {}", name);
  }
  if (arguments.output.empty() || arguments.output == "-" || fs::is_regular_file(arguments.output)) {
    return fmt::format("--two-sided: expected --output FOLDER, found '{}'", arguments.output);
  }
  return {};
}

// The largest cutter must find room between the part and the frame.
Mm trench_of(const ReliefProgramOptions& program) {
  Mm radius = program.finish.cutter.radius;
  Mm stock{0};
  if (program.roughing) {
    radius = std::max(radius, program.roughing->tool.cutter.radius);
    stock = program.roughing->stock;
  }
  return radius * 2.2 + stock * 2 + Mm(1);
}

// The part as a region of rectangles, for the picture of the flip. Coarse, because it is only a picture.
Region region_of(const SplitRelief& split, Mm x0, Mm y0) {
  constexpr std::size_t most = 160;
  const HeightGrid& grid = split.top;
  const std::size_t step = std::max(grid.columns, grid.rows) / most + 1;
  const auto at = [&](std::size_t column, std::size_t row) {
    return DrawnPoint{to_nanometres(x0 + grid.pitch_x * static_cast<double>(column)),
                      to_nanometres(y0 + grid.pitch_y * static_cast<double>(row))};
  };
  std::vector<Region> rectangles;
  for (std::size_t row = 0; row + step < grid.rows; row += step) {
    for (std::size_t column = 0; column < grid.columns;) {
      const auto is_part = [&](std::size_t i) { return i < grid.columns && split.part[row * grid.columns + i]; };
      if (!is_part(column)) {
        ++column;
        continue;
      }
      std::size_t end = column;
      while (is_part(end)) ++end;
      rectangles.push_back({.rings = {{at(column, row), at(end, row), at(end, row + step), at(column, row + step)}}});
      column = end;
    }
  }
  return rectangles.empty() ? Region{} : united(rectangles);
}

Region rectangle(double x0, double y0, double x1, double y1) {
  const auto at = [](double x, double y) { return DrawnPoint{to_nanometres(Mm(x)), to_nanometres(Mm(y))}; };
  return {.rings = {{at(x0, y0), at(x1, y0), at(x1, y1), at(x0, y1)}}};
}

class SidesMaker {
 public:
  SidesMaker(const CamReliefArguments& arguments, ReliefJob job, const SplitOptions& options)
      : arguments_(arguments),
        job_(std::move(job)),
        options_(options),
        is_x_(options.flip == StockFlip::left_to_right),
        unfinished_(arguments.output) {}

  int make(ReliefReading& reading, const WorkProgress& progress);

 private:
  std::optional<SplitRelief> read(ReliefReading& reading, Diagnostics& findings);
  int write_all(const WorkProgress& progress);
  void put_stock(const std::string& name);
  void note_edge() const;
  nlohmann::ordered_json as_json() const;
  int drill(const WorkProgress& progress);
  int carve(const HeightGrid& grid, const char* name, BoardStep step, const WorkProgress& progress);
  int flip();
  void tell(const BoardStep& step) const;
  std::string path(const std::string& name) const { return (unfinished_.made() / name).string(); }
  double middle_x() const { return x0_.value() + width_.value() / 2; }
  double middle_y() const { return y0_.value() + length_.value() / 2; }
  double across() const { return is_x_ ? width_.value() : length_.value(); }

  const CamReliefArguments& arguments_;
  ReliefJob job_;
  SplitOptions options_;
  bool is_x_;
  UnfinishedJob unfinished_;
  Mm pins_{};  // distance of the holes from the frame's inner edge; 0: no holes
  Mm drill_{};
  SplitRelief split_;
  BoardPage page_;
  nlohmann::ordered_json json_ = nlohmann::ordered_json::array();  // the programs of both sides
  std::string words_;
  Mm x0_{};  // of the part's lower left corner
  Mm y0_{};
  Mm width_{};  // of the part
  Mm length_{};
  double high_ = 0;
  std::array<std::pair<double, double>, 2> holes_ = {};
  int programs_ = 0;
};

std::optional<SplitRelief> SidesMaker::read(ReliefReading& reading, Diagnostics& findings) {
  const auto top = read_relief(arguments_, job_, ModelSide::as_told, findings);
  if (!top) return std::nullopt;
  const auto refuse = [&](const std::string& message, const char* expected) {
    findings.add(of_file("relief.bad-body", arguments_.file, message, expected));
    return std::nullopt;
  };
  if (!top->is_body) return refuse("a picture or a height map has no other side", "an STL or 3MF model");
  const auto bottom =
      read_relief(arguments_, job_, is_x_ ? ModelSide::left_to_right : ModelSide::front_to_back, findings);
  if (!bottom) return std::nullopt;
  words_ = top->words;
  width_ = top->grid.width();
  length_ = top->grid.length();
  high_ = top->high.value();
  if (high_ <= options_.tab_height.value() * 1.5) {
    return refuse(fmt::format("the model is only {:.4g} mm high", high_), "a lower --tab-height");
  }
  place_relief(arguments_, top->grid, reading, job_.program);
  x0_ = job_.program.x0;
  y0_ = job_.program.y0;
  SplitRelief split = split_relief(top->grid, bottom->grid, top->high, options_);
  if (split.tabs < 2 && options_.tab_width.value() > 0) {
    return refuse(fmt::format("{} would hold the part: on the other sides, its edge is nowhere {:.4g} mm thick along "
                              "{:.4g} mm, at Z{:.4g}",
                              split.tabs == 0 ? "no tab" : "only one tab", options_.tab_height.value(),
                              options_.tab_width.value(), -split.parting.value()),
                  "a lower --tab-height or --tab-width, or another --parting; --tab-width 0 leaves the web around the "
                  "part");
  }
  return split;
}

// Where the holes are, and how large the stock must be.
void SidesMaker::put_stock(const std::string& name) {
  const double beside = (is_x_ ? split_.beside_x : split_.beside_y).value();
  const double off = across() / 2 + beside + pins_.value();
  const double x = middle_x();
  const double y = middle_y();
  holes_ = {is_x_ ? std::pair(x - off, y) : std::pair(x, y - off),
            is_x_ ? std::pair(x + off, y) : std::pair(x, y + off)};
  constexpr double rim = 10;
  const double along = 2 * (pins_.value() > 0 ? off + drill_.value() / 2 + rim : across() / 2 + beside + rim);
  const double other = (is_x_ ? length_ + split_.beside_y * 2 : width_ + split_.beside_x * 2).value() + 2 * rim;
  page_.name = name;
  page_.command = "relief";
  page_.manual = "relief";
  page_.lead = "The times assume the programmed feed rates, without rapids and acceleration.";
  page_.files = {{.name = name, .short_name = name, .layer = words_, .told_by = "content", .is_drill_file = false}};
  page_.steps.push_back(
      {.kind = "blank",
       .title = "Fix the stock",
       .words = {
           fmt::format("The stock must be {:.4g} mm thick, as high as the model, with two parallel faces.", high_),
           fmt::format("It must be at least {:.4g} x {:.4g} mm in X and Y.", is_x_ ? along : other,
                       is_x_ ? other : along),
           fmt::format("The part extends from X{:.6g} to X{:.6g} and from Y{:.6g} to Y{:.6g} mm.", x0_.value(),
                       (x0_ + width_).value(), y0_.value(), (y0_ + length_).value()),
           "Z0 is the upper face of the stock."}});
}

// The edge of the part is not everywhere as the web and the tabs need it.
void SidesMaker::note_edge() const {
  constexpr double much = 0.02;
  if (options_.tab_width.value() <= 0) {
    if (split_.hidden > much) {
      note(
          fmt::format("the web, {:.4g} mm below the top, does not meet {:.0f} % of the part's edge; there the cutters "
                      "may not reach all of the part",
                      split_.parting.value(), split_.hidden * 100));
    }
    return;
  }
  if (!split_.has_web) {
    note("a web would hide some of the part's edge: the top, too, is cut through around the part, except at the tabs");
  }
  if (split_.on_part > Mm(0)) {
    note(fmt::format("the part's edge is thinner than the tabs, which reach up to {:.2g} mm onto the part",
                     split_.on_part.value()));
  }
}

void SidesMaker::tell(const BoardStep& step) const {
  ProgressDisplay::clear_shown();
  if (arguments_.json) return;
  say(fmt::format("{}: {}\n{}", step.program, step.title, step.figures));
}

int SidesMaker::drill(const WorkProgress& progress) {
  if (pins_.value() <= 0) return exit_done;
  constexpr double into_table = 5;
  CamDrillArguments drill;
  const auto mm = [](double value) { return fmt::format("{:.4f}mm", value); };
  drill.align =
      fmt::format("{},{},{},{}", mm(holes_[0].first), mm(holes_[0].second), mm(holes_[1].first), mm(holes_[1].second));
  drill.align_drill = mm(drill_.value());
  drill.depth = mm(-high_ - into_table);
  drill.peck = mm(drill_.value());
  drill.clearance = arguments_.clearance;
  drill.spindle = arguments_.spindle;
  drill.units = arguments_.units;
  drill.park = arguments_.park;
  static_cast<CamProgramArguments&>(drill) = arguments_;
  drill.output = path(fmt::format("{}-dowels.ngc", ++programs_));
  CamSources sources;
  CamMade made;
  if (const int code = cam_drill(drill, progress, &sources, &made); code != exit_done) return code;
  BoardStep step{
      .kind = "drill",
      .title = "Drill the dowel holes",
      .program = fs::path(drill.output).filename().string(),
      .tools = made.tools,
      .words = {fmt::format("Run the program. It drills two holes, {:.4g} mm through the stock and {:.4g} mm "
                            "into the table below.",
                            high_, into_table),
                "Do not move the stock between this step and the flip."}};
  tell(step);
  page_.steps.push_back(std::move(step));
  return exit_done;
}

int SidesMaker::carve(const HeightGrid& grid, const char* name, BoardStep step, const WorkProgress& progress) {
  step.program = fmt::format("{}-{}.ngc", ++programs_, name);
  ReliefProgramOptions program = job_.program;
  program.name = step.program;
  program.x0 = x0_ - split_.beside_x;
  program.y0 = y0_ - split_.beside_y;
  program.words = {fmt::format("the {} of {}: {}", name, page_.name, words_), grid_words(grid)};
  for (const std::string& remark : arguments_.tool_remarks) program.words.push_back(remark);
  Result<OutputFile, OutputError> file = OutputFile::open(path(step.program));
  if (!file) return fail(exit_failed, file.error().message);
  std::optional<std::string> refused;
  const ReliefReport report = write_relief_in_words(arguments_, program, *file, refused, [&](const ReliefSink& sink) {
    return write_relief(grid, program, sink, progress, true);
  });
  if (refused) return fail(exit_bad_program, fmt::format("--for {}: {}", arguments_.controller, *refused));
  if (const Status<OutputError> written = file->commit(); !written) return fail(exit_failed, written.error().message);
  for (const ReliefPart& part : report.parts) {
    if (part.step.value() > 0) step.tools.push_back(part.tool);
  }
  step.figures = summary_of(report);
  json_.push_back({{"program", step.program}, {"passes", json_of(report)}});
  step.photo = draw_carved(report.carved, grid.pitch_x, grid.pitch_y);
  const std::string picture = fs::path(step.program).replace_extension(".png").string();
  if (const int code = write_text(path(picture), step.photo); code != exit_done) return code;
  tell(step);
  page_.steps.push_back(std::move(step));
  return exit_done;
}

int SidesMaker::flip() {
  const std::string over = is_x_ ? "from left to right" : "from front to back";
  const std::string axis = fmt::format("{}{:.6g}", is_x_ ? "X" : "Y", is_x_ ? middle_x() : middle_y());
  BoardStep step{.kind = "turn",
                 .title = "Flip the stock",
                 .words = {fmt::format("Flip it {}, about the line {}.", over, axis),
                           "X0 Y0 stays where it is; set Z0 on the upper face again."}};
  const double x = split_.beside_x.value();
  const double y = split_.beside_y.value();
  const Region face =
      rectangle(x0_.value() - x, y0_.value() - y, (x0_ + width_).value() + x, (y0_ + length_).value() + y);
  const Region part = region_of(split_, x0_ - split_.beside_x, y0_ - split_.beside_y);
  if (pins_.value() > 0) {
    step.words[0] += " Press dowels into the holes in the table, and place the stock on them.";
    step.words.push_back(
        fmt::format("Hole 1 is at X{:.6g} Y{:.6g}, hole 2 at X{:.6g} Y{:.6g} mm; after the flip, each "
                    "is where the other was.",
                    holes_[0].first, holes_[0].second, holes_[1].first, holes_[1].second));
    const auto hole = [](const std::pair<double, double>& at) {
      return DrawnPoint{to_nanometres(Mm(at.first)), to_nanometres(Mm(at.second))};
    };
    const FlipScene scene{
        .face = face,
        .front = part,
        .back = part,
        .holes = {hole(holes_[0]), hole(holes_[1])},
        .diameter = to_nanometres(drill_),
        .mirror = {is_x_ ? Mirror::Turned::x : Mirror::Turned::y, to_nanometres(Mm(is_x_ ? middle_x() : middle_y()))}};
    const std::string file = path(fmt::format("{}-flip.svg", programs_ + 1));
    const int code = write_picture(file, "Flip the stock", [&](const PictureOptions& options, OutputFile& picture) {
      return draw_flip(scene, options, picture);
    });
    if (code != exit_done) return code;
    step.picture = content_of(file);
  } else {
    step.words.push_back("Without dowels, align the stock against a stop, so that its centre line stays on that line.");
  }
  page_.steps.push_back(std::move(step));
  return exit_done;
}

int SidesMaker::write_all(const WorkProgress& progress) {
  if (const int code = drill(progress.part(0, 0.05)); code != exit_done) return code;
  const std::string web =
      fmt::format("{} of {:.4g} mm {} around the part, {:.4g} mm below the upper face.",
                  split_.has_web ? "A web" : counted(split_.tabs, "tab"), options_.tab_height.value(),
                  split_.has_web ? "remains" : "remain", split_.parting.value() - options_.tab_height.value() / 2);
  int code = carve(
      split_.top, "top",
      {.kind = "front", .title = "Carve the top", .words = {"Insert the cutter, set Z0, and run the program.", web}},
      progress.part(0.05, 0.5));
  if (code == exit_done) code = flip();
  std::vector<std::string> words = {"Insert the cutter, set Z0 on the upper face, and run the program."};
  words.push_back(split_.tabs > 0 ? fmt::format("The {} is cut through except at {} tabs, which hold the part.",
                                                split_.has_web ? "web" : "trench", split_.tabs)
                                  : std::string("The web around the part remains."));
  words.emplace_back(split_.tabs > 0 ? "Saw off the tabs, and sand the stubs." : "Saw the part out of the web.");
  if (code == exit_done) {
    code = carve(split_.bottom, "bottom", {.kind = "back", .title = "Carve the bottom", .words = std::move(words)},
                 progress.part(0.5, 1));
  }
  return code == exit_done ? write_text(path("relief.html"), to_html(page_)) : code;
}

nlohmann::ordered_json SidesMaker::as_json() const {
  return {{"input", words_},
          {"width_mm", width_.value()},
          {"length_mm", length_.value()},
          {"height_mm", high_},
          {"parting_mm", -split_.parting.value()},
          {"has_web", split_.has_web},
          {"tabs", split_.tabs},
          {"tabs_on_part_mm", split_.on_part.value()},
          {"sides", json_}};
}

int SidesMaker::make(ReliefReading& reading, const WorkProgress& progress) {
  pins_ = reading.length("--pins", arguments_.pins, Mm(0), Mm(1000));
  drill_ = reading.length("--align-drill", arguments_.align_drill, Mm(0.3), Mm(50));
  if (!reading.message().empty()) return fail(exit_bad_program, reading.message());
  // The cutters stay within the frame.
  job_.program.overrun = Mm(0);
  job_.program.beside = BesideGrid::nothing;
  Diagnostics findings;
  std::optional<SplitRelief> split = read(reading, findings);
  const bool fits = split && fits_memory(job_.program, split->top, arguments_.file, findings);
  show(findings);
  if (!fits) return exit_bad_program;
  if (!reading.message().empty()) return fail(exit_bad_program, reading.message());
  split_ = std::move(*split);
  put_stock(fs::path(arguments_.file).filename().string());
  if (!arguments_.json) say(fmt::format("{}: {}\n{}\n", arguments_.file, words_, grid_words(split_.top)));
  note_edge();
  int code = unfinished_.begin();
  if (code == exit_done) code = write_all(progress);
  if (code == exit_done) code = unfinished_.finish();
  if (code == exit_done) progress.update(1);
  if (code == exit_done && arguments_.json) say_summary(as_json(), arguments_);
  return code;
}

}  // namespace

int cam_relief_sides(const CamReliefArguments& arguments, const WorkProgress& progress) {
  if (const std::string why = refused_for_sides(arguments); !why.empty()) return fail(exit_bad_program, why);
  if (!program_words_are_good(arguments, arguments.units)) return exit_bad_program;
  ReliefReading reading(*mm_of_unit(arguments.units));
  ReliefJob job = relief_job_of(arguments, reading);
  SplitOptions options{.flip = arguments.two_sided == "x" ? StockFlip::left_to_right : StockFlip::front_to_back,
                       .tab_height = reading.length("--tab-height", arguments.tab_height, Mm(0.1), Mm(50)),
                       .tab_width = reading.length("--tab-width", arguments.tab_width, Mm(0), Mm(200)),
                       .parting = reading.depth("--parting", arguments.parting)};
  if (!reading.message().empty()) return fail(exit_bad_program, reading.message());
  options.trench = trench_of(job.program);
  return SidesMaker(arguments, std::move(job), options).make(reading, progress);
}

}  // namespace passo
