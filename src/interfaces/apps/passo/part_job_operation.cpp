#include "part_job_operation.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "cam_job.hpp"
#include "chamfer_cut.hpp"
#include "idle_options.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "passo/cam/drawing_file.hpp"
#include "passo/diagnostics/file_bytes.hpp"
#include "passo/post_processor/controller_words.hpp"

namespace passo {
namespace {

// What a drawing is read with. Reliefs have no drawing.
DrawingFileOptions reading_of(const PartOperation& operation, bool all_layers) {
  DrawingFileOptions reading;
  std::visit(
      [&](const auto& arguments) {
        if constexpr (requires { arguments.layers; }) {
          LengthArguments lengths(*mm_of_unit(arguments.units));
          reading.dxf = dxf_options_of(arguments, *mm_of_unit(arguments.units), lengths);
          reading.svg.scale = reading.hpgl.scale = arguments.scale.value_or(1);
          if (!all_layers) {
            reading.svg.colors = arguments.colors;
            reading.svg.names = arguments.names;
          }
        }
      },
      operation.arguments);
  if (all_layers) {
    reading.dxf.layers.clear();
  } else {
    reading.dxf.layers = reading.svg.layers = reading.hpgl.layers = operation.layers;
  }
  return reading;
}

void extend_box(std::optional<DrawnBox>& box, DrawnPoint least, DrawnPoint most) {
  if (!box) box = DrawnBox{least, most};
  box->least = {std::min(box->least.x, least.x), std::min(box->least.y, least.y)};
  box->most = {std::max(box->most.x, most.x), std::max(box->most.y, most.y)};
}

DrawnBox box_of_path(const DrawnPath& path) {
  std::optional<DrawnBox> box;
  for (const DrawnPoint& point : chords_of_path(path.points, path.is_closed, {10'000})) extend_box(box, point, point);
  return box.value_or(DrawnBox{});
}

DrawnBox box_of_hole(const DrawnHole& hole) {
  const Nanometres radius{hole.diameter.count / 2};
  return {{hole.at.x - radius, hole.at.y - radius}, {hole.at.x + radius, hole.at.y + radius}};
}

std::string contour_words(const DrawnBox& box, DrawnPoint zero) {
  const auto mm = [](Nanometres length) { return std::round(to_mm(length).value() * 100) / 100 + 0.0; };
  return fmt::format("{:g} x {:g} mm at X{:g} Y{:g}", mm(box.most.x - box.least.x), mm(box.most.y - box.least.y),
                     mm(box.least.x - zero.x), mm(box.least.y - zero.y));
}

SourceLocation place_of_key(const PartOperation& operation, std::string_view key) {
  const auto found = std::ranges::find(operation.keys, key, &PartKey::name);
  return found == operation.keys.end() ? operation.place : found->place;
}

void check_layers(const PartJob& job, const PartOperation& operation, const std::vector<std::string>& known,
                  Diagnostics& findings) {
  const std::vector<std::string_view> names(known.begin(), known.end());
  for (const std::string& layer : operation.layers) {
    if (std::ranges::find(known, layer) != known.end()) continue;
    const std::string_view near = suggestion(layer, names);
    std::vector<std::string_view> named;
    for (const std::string_view name : names) {
      if (!name.empty()) named.push_back(name);
    }
    findings.add(job.finding("job.no-such-layer", place_of_key(operation, "layer"),
                             layer.empty()
                                 ? fmt::format("{} has nothing outside of its layers", fmt::join(operation.files, ", "))
                                 : fmt::format("{} has no layer '{}'", fmt::join(operation.files, ", "), layer),
                             named.empty()  ? "no layer: this drawing has none"
                             : near.empty() ? fmt::format("{}", fmt::join(named, ", "))
                                            : fmt::format("perhaps {}", near)));
  }
}

// The stock's top, and half a millimetre around it, so that the cutter passes over the edges.
std::string face_drawing(const PartStock& stock, double radius) {
  constexpr double over = 0.5;
  const double by = radius + over;
  const double width = stock.width + 2 * by;
  const double length = stock.length + 2 * by;
  return fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}mm" height="{1}mm" viewBox="0 0 {0} {1}"><rect x="0" y="0" width="{0}" height="{1}"/></svg>)",
      width, length);
}

class OperationRun {
 public:
  OperationRun(const PartJob& job, const PartOperation& operation, const PartJobZero& zero, const std::string& folder)
      : job_(job), operation_(operation), folder_(folder), arguments_(operation.arguments) {
    fill(zero);
  }

  int run(const WorkProgress& progress);
  std::string program_file() const { return folder_ + "/operation.ngc"; }

 private:
  void fill(const PartJobZero& zero);
  void fill_face(CamPocketArguments& arguments);
  std::string refuse_chamfer(const CamProfileArguments& arguments) const;

  const PartJob& job_;
  const PartOperation& operation_;
  const std::string& folder_;
  PartArguments arguments_;
};

void OperationRun::fill(const PartJobZero& zero) {
  std::visit(
      [&](auto& arguments) {
        arguments.output = program_file();
        if constexpr (requires { arguments.file; }) {
          if (!operation_.files.empty()) arguments.file = operation_.files.front();
        } else {
          arguments.files = operation_.files;
          if (!operation_.files.empty()) arguments.zero = zero.words;
          if (operation_.at) arguments.zero = fmt::format("{}mm,{}mm", -operation_.at->front(), -operation_.at->back());
        }
        if constexpr (requires { arguments.json; }) arguments.json = true;
        if constexpr (requires { arguments.in_job; }) arguments.in_job = true;
        // Canned cycles of a program in the words of another controller cannot be written as moves afterwards.
        if constexpr (requires { arguments.plain; }) {
          const ControllerWords* const words = find_controller(job_.program.controller);
          arguments.plain = arguments.plain || (words != nullptr && !(words->knows_g("81") && words->knows_g("83")));
        }
      },
      arguments_);
  if (operation_.kind == PartKind::face) fill_face(std::get<CamPocketArguments>(arguments_));
}

void OperationRun::fill_face(CamPocketArguments& arguments) {
  const double radius = job_.tools.at(operation_.tool).shape.cutter.radius.value();
  const std::string file = folder_ + "/stock.svg";
  static_cast<void>(write_text(file, face_drawing(*job_.stock, radius)));
  arguments.files = {file};
  constexpr double over = 0.5;
  arguments.zero = fmt::format("{}mm,{}mm", -(job_.stock->x - radius - over), -(job_.stock->y - radius - over));
}

// The flank of the tool must be as wide as the chamfer.
std::string OperationRun::refuse_chamfer(const CamProfileArguments& arguments) const {
  const Cutter& cutter = job_.tools.at(operation_.tool).shape.cutter;
  const double most = most_chamfer_mm(2 * cutter.radius.value(), 2 * cutter.flat.value());
  const Result<Mm, std::string> width = parse_length("--chamfer", arguments.chamfer, *mm_of_unit(arguments.units));
  if (!width || width->value() <= most) return "";
  return fmt::format("--chamfer: expected at most {:.3g} mm with this tool", std::max(0.0, most));
}

int OperationRun::run(const WorkProgress& progress) {
  if (operation_.kind == PartKind::chamfer) {
    const auto* const profile = std::get_if<CamProfileArguments>(&arguments_);
    if (const std::string why = profile == nullptr ? "" : refuse_chamfer(*profile); !why.empty()) {
      return fail(exit_bad_program, why);
    }
  }
  if (const auto* profile = std::get_if<CamProfileArguments>(&arguments_)) return cam_profile(*profile, progress);
  if (const auto* pocket = std::get_if<CamPocketArguments>(&arguments_)) return cam_pocket(*pocket, progress);
  if (const auto* drill = std::get_if<CamDrillArguments>(&arguments_)) return cam_drill(*drill, progress);
  if (const auto* engrave = std::get_if<CamEngraveArguments>(&arguments_)) return cam_engrave(*engrave, progress);
  if (const auto* thread = std::get_if<CamThreadArguments>(&arguments_)) return cam_thread(*thread, progress);
  return cam_relief(std::get<CamReliefArguments>(arguments_), progress);
}

// "--depth: expected ..." is about a key of the operation.
Diagnostic finding_of(const PartJob& job, const PartOperation& operation, const std::string& failure) {
  if (failure.starts_with("--")) {
    const std::size_t end = std::min(failure.find_first_of(": "), failure.size());
    const std::string key = failure.substr(2, end - 2);
    const std::size_t at = failure.find_first_not_of(": ", end);
    if (operation.has(key) && at != std::string::npos) {
      std::string words = failure.substr(at);
      if (constexpr std::string_view label = "expected "; words.starts_with(label)) words.erase(0, label.size());
      return job.finding("job.bad-value", place_of_key(operation, key),
                         fmt::format("'{}' cannot have this {}", operation.title, key), words);
    }
  }
  return job.finding("job.operation", operation.place, fmt::format("'{}': {}", operation.title, failure), "");
}

std::vector<IdleOption> idle_keys_of(const PartOperation& operation) {
  const IsGiven is_given = [&](const char* option) { return operation.has(option + 2); };
  return std::visit([&](const auto& arguments) { return idle_options_of(arguments, is_given); }, operation.arguments);
}

void warn_of_idle_key(const PartJob& job, const SourceLocation& place, std::string message, Diagnostics& findings) {
  Diagnostic finding = job.finding("job.no-effect", place, std::move(message), "");
  finding.severity = Severity::warning;
  findings.add(std::move(finding));
}

// Keys of the operation itself; for those of [job], see warn_of_idle_defaults().
void warn_of_idle_keys(const PartJob& job, const PartOperation& operation, Diagnostics& findings) {
  for (const IdleOption& option : idle_keys_of(operation)) {
    const auto key = std::ranges::find(operation.keys, option.name, &PartKey::name);
    if (key == operation.keys.end() || key->is_of_job) continue;
    warn_of_idle_key(job, key->place,
                     fmt::format("'{}': {} has no effect: {}", operation.title, option.name, option.why), findings);
  }
}

// A job selects layers and states which circles are bores, so notes about board drawings do not apply. It checks the
// room around bosses itself.
bool is_news(const std::string& note) {
  return note.find("on other layers") == std::string::npos && note.find("the scale may be off") == std::string::npos &&
         note.find("must be cleared to this radius") == std::string::npos;
}

// Without a width, the tip of a chamfer's tool follows the edge, also at a depth that nobody has given.
void note_usual_depth(const PartOperation& operation, std::vector<std::string>& notes) {
  const bool is_along_edge =
      operation.kind == PartKind::chamfer && std::holds_alternative<CamEngraveArguments>(operation.arguments);
  if (!is_along_edge || operation.has("depth")) return;
  notes.emplace_back("neither chamfer nor depth is given: the tip of the tool follows the edges at a depth of 0.3 mm");
}

}  // namespace

std::optional<PartJobZero> find_zero(const PartJob& job, Diagnostics& findings) {
  std::optional<DrawnBox> box;
  std::map<std::string, std::vector<std::string>> layers;
  Diagnostics found;
  for (const PartOperation& operation : job.operations) {
    if (operation.kind == PartKind::relief) continue;
    std::vector<std::string> known;
    const auto* engrave = std::get_if<CamEngraveArguments>(&operation.arguments);
    if (engrave != nullptr && engrave->trace) continue;
    for (const std::string& file : operation.files) {
      if (!layers.contains(file)) {
        const Drawing drawing = read_drawing(file, reading_of(operation, true), found);
        for (const DrawnPath& path : drawing.paths) {
          const DrawnBox of_path = box_of_path(path);
          extend_box(box, of_path.least, of_path.most);
        }
        for (const DrawnHole& hole : drawing.holes) {
          const DrawnBox of_hole = box_of_hole(hole);
          extend_box(box, of_hole.least, of_hole.most);
        }
        layers[file] = drawing.layers;
      }
      known.insert(known.end(), layers[file].begin(), layers[file].end());
    }
    if (!found.any_error()) check_layers(job, operation, known, findings);
  }
  for (const Diagnostic& finding : found.all()) findings.add(finding);
  if (findings.any_error()) return std::nullopt;
  PartJobZero zero{job.zero};
  if (job.zero == "lower-left") {
    const DrawnPoint corner = box.value_or(DrawnBox{}).least;
    zero.words = fmt::format("{}mm,{}mm", to_mm(corner.x).value(), to_mm(corner.y).value());
  }
  return zero;
}

Region outline_of_part(const PartJob& job, const PartJobZero& zero) {
  LengthArguments lengths(1);
  const DrawnPoint at = zero.words == "file" ? DrawnPoint{} : lengths.place("zero", zero.words);
  constexpr Nanometres join{100'000};
  constexpr Nanometres chords{10'000};
  std::vector<DrawnRing> rings;
  Diagnostics ignored;
  for (const PartOperation& operation : job.operations) {
    const auto* engrave = std::get_if<CamEngraveArguments>(&operation.arguments);
    const bool has_drawing = operation.kind != PartKind::relief && operation.kind != PartKind::face &&
                             !(engrave != nullptr && engrave->trace);
    if (!has_drawing) continue;
    for (const std::string& file : operation.files) {
      Drawing drawing = read_drawing(file, reading_of(operation, false), ignored);
      move_zero_to(at, drawing);
      for (const auto& loop : edge_loops(drawing, join, ignored, OpenRows::kept).loops) {
        rings.push_back(chords_of_path(loop, true, chords));
      }
      for (const DrawnHole& hole : drawing.holes) {
        if (hole.diameter.count <= 0) continue;
        for (DrawnRing& ring : swept({{hole.at}}, {hole.diameter.count / 2}, chords).rings) rings.push_back(ring);
      }
    }
  }
  const Region all = filled(std::move(rings));
  Region outside;
  for (const Region& part : parts_of(all)) outside.rings.push_back(part.rings.front());
  return filled(std::move(outside.rings));
}

void warn_of_idle_defaults(const PartJob& job, Diagnostics& findings) {
  for (const PartKey& given : job.defaults) {
    std::string why = "no operation has this option and leaves it to the job";
    const bool works = std::ranges::any_of(job.operations, [&](const PartOperation& operation) {
      const auto key = std::ranges::find(operation.keys, given.name, &PartKey::name);
      if (key == operation.keys.end() || !key->is_of_job) return false;
      const std::vector<IdleOption> idle = idle_keys_of(operation);
      const auto found = std::ranges::find(idle, given.name, &IdleOption::name);
      if (found == idle.end()) return true;
      why = found->why;
      return false;
    });
    if (!works) {
      warn_of_idle_key(job, given.place, fmt::format("job.{} has no effect: {}", given.name, why), findings);
    }
  }
}

std::optional<MadeOperation> make_operation(const PartJob& job, const PartOperation& operation, const PartJobZero& zero,
                                            const std::string& folder, Diagnostics& findings,
                                            const WorkProgress& progress) {
  MadeOperation made;
  warn_of_idle_keys(job, operation, findings);
  note_usual_depth(operation, made.notes);
  OperationRun run(job, operation, zero, folder);
  KeptMessages messages;
  const int code = run.run(progress);
  for (const Diagnostic& finding : messages.findings) {
    if (finding.severity == Severity::warning) {
      made.notes.push_back(fmt::format("warning: {} [{}]", std::string(finding.message), finding.code));
    } else {
      findings.add(finding);
    }
  }
  for (const std::string& failure : messages.failures) findings.add(finding_of(job, operation, failure));
  std::ranges::copy_if(messages.notes, std::back_inserter(made.notes), is_news);
  if (code != exit_done) {
    if (messages.failures.empty()) {
      findings.add(
          job.finding("job.operation", operation.place, fmt::format("'{}' cannot be generated", operation.title), ""));
    }
    return std::nullopt;
  }
  Diagnostics of_file;
  const auto program = read_bytes(run.program_file(), {.area = "job", .expected = "a program"}, of_file);
  if (!program) return std::nullopt;
  made.program = *program;
  if (messages.said.starts_with("{")) made.figures = nlohmann::ordered_json::parse(messages.said, nullptr, false);
  if (made.figures.is_discarded()) made.figures = {};
  const auto* engrave = std::get_if<CamEngraveArguments>(&operation.arguments);
  if (operation.kind == PartKind::relief || (engrave != nullptr && engrave->trace)) return made;
  LengthArguments lengths(1);
  const DrawnPoint at = zero.words == "file" ? DrawnPoint{} : lengths.place("zero", zero.words);
  constexpr std::size_t most_contours = 2000;
  for (const std::string& file : operation.files) {
    const Drawing drawing = read_drawing(file, reading_of(operation, false), of_file);
    for (const DrawnPath& path : drawing.paths) made.contours.push_back(contour_words(box_of_path(path), at));
    for (const DrawnHole& hole : drawing.holes) made.contours.push_back(contour_words(box_of_hole(hole), at));
  }
  if (made.contours.size() > most_contours) made.contours.resize(most_contours);
  return made;
}

}  // namespace passo
