// passo cam thread: a program that mills threads at the circles of a drawing.
#include <algorithm>
#include <cmath>
#include <limits>

#include "cam_job.hpp"
#include "cam_part.hpp"
#include <nlohmann/json.hpp>

#include "passo/base/counted.hpp"
#include "passo/cam/thread_plan.hpp"
#include "passo/diagnostics/file_bytes.hpp"

namespace passo {
namespace {

constexpr double least_room_nm = 20'000;  // between the neck and the wall, and around a cutter that goes down

struct ThreadJob {
  ThreadOptions plan;
  Nanometres hole;  // of the bore or the boss
};

std::string thread_mm(Nanometres length) {
  return fmt::format("{:.6g} mm", to_mm(length).value());
}

std::optional<ThreadSize> size_of(const CamThreadArguments& arguments, LengthArguments& lengths) {
  if (!arguments.thread.empty()) {
    if (!arguments.diameter.empty() || !arguments.pitch.empty()) {
      lengths.refuse("--thread cannot be combined with --diameter or --pitch");
    }
    std::optional<ThreadSize> size = thread_size_of(arguments.thread);
    if (!size) {
      lengths.refuse(fmt::format("--thread: expected a name like M6, M8x1, 1/4-20, #8-32 or 1/4 UNC, found '{}'",
                                 arguments.thread));
    }
    return size;
  }
  if (arguments.diameter.empty() || arguments.pitch.empty()) {
    lengths.refuse("--thread: expected the name of a thread, e.g. M6, or --diameter with --pitch");
    return std::nullopt;
  }
  const Nanometres major = lengths.above_0("--diameter", arguments.diameter);
  const Nanometres pitch = lengths.above_0("--pitch", arguments.pitch);
  std::optional<ThreadSize> size = thread_size_of(major, pitch);
  if (!size) lengths.refuse("--pitch: expected 0.05 mm to half of --diameter, which is at most 1000 mm");
  return size;
}

// The teeth must fit the thread.
void check_teeth(const CamThreadArguments& arguments, const ThreadJob& job, LengthArguments& lengths) {
  const double pitch = job.plan.size.pitch_nm;
  if (!arguments.tooth_tip.empty()) {
    const Nanometres tip = lengths.any("--tooth-tip", arguments.tooth_tip);
    if (tip.count < 0 || static_cast<double>(tip.count) > pitch / 8 + 500) {
      lengths.refuse(fmt::format("--tooth-tip: expected at most an eighth of the pitch, {:.4g} mm, found '{}'",
                                 pitch / 8 / nanometres_per_mm, arguments.tooth_tip));
    }
  }
  if (job.plan.teeth < 2 || arguments.tooth_pitch.empty()) return;
  const Nanometres between = lengths.any("--teeth", arguments.tooth_pitch);
  constexpr double same = 1e-3;
  if (std::abs(static_cast<double>(between.count) - pitch) > same * pitch) {
    lengths.refuse(fmt::format("--thread: expected a pitch of {}, the distance of the mill's teeth, found {:.4g} mm",
                               thread_mm(between), pitch / nanometres_per_mm));
  }
}

// The tool must go down beside the wall, and its neck must not touch the wall while the teeth are in it.
void check_room(const CamThreadArguments& arguments, const ThreadJob& job, LengthArguments& lengths) {
  const ThreadOptions& plan = job.plan;
  const Nanometres neck = lengths.above_0("--neck", arguments.neck);
  const auto cutter = static_cast<double>(plan.cutter.count);
  const auto hole = static_cast<double>(job.hole.count);
  const auto major = static_cast<double>((plan.size.major + plan.oversize).count);
  const auto root = static_cast<double>((plan.size.root() - plan.oversize).count);
  if (!plan.is_external && job.hole >= plan.size.major) {
    lengths.refuse(fmt::format("--hole: expected less than the major diameter, {}, found '{}'",
                               thread_mm(plan.size.major), arguments.hole));
  }
  if (plan.is_external && job.hole <= plan.size.root()) {
    lengths.refuse(fmt::format("--hole: expected more than the root of the thread, {}, found '{}'",
                               thread_mm(plan.size.root()), arguments.hole));
  }
  if (neck >= plan.cutter) lengths.refuse("--neck: expected less than the diameter of --tool");
  if (!plan.is_external && cutter + 2 * least_room_nm > std::min(hole, static_cast<double>(plan.size.minor().count))) {
    lengths.refuse(fmt::format("--tool: expected a diameter below that of the bore, {}, found '{}'",
                               thread_mm(std::min(job.hole, plan.size.minor())), arguments.tool));
  }
  // On both sides: the height of the teeth must be more than the depth of the thread.
  const double most_neck = plan.is_external ? cutter + root - hole : hole - major + cutter;
  if (const double hundredths = std::floor((most_neck - 2 * least_room_nm) / 10'000); hundredths < 1) {
    const double least_cutter = std::ceil((cutter - most_neck + 2 * least_room_nm) / 10'000) / 100 + 0.01;
    lengths.refuse(
        fmt::format("--tool: expected at least {:.4g} mm, so that a neck does not touch the {} of {}, found "
                    "'{}'",
                    least_cutter, plan.is_external ? "boss" : "bore", thread_mm(job.hole), arguments.tool));
  } else if (static_cast<double>(neck.count) + 2 * least_room_nm > most_neck) {
    lengths.refuse(
        fmt::format("--neck: expected at most {:.4g} mm, so that the neck does not touch the {} of {}, found "
                    "'{}'",
                    hundredths / 100, plan.is_external ? "boss" : "bore", thread_mm(job.hole), arguments.neck));
  }
  const std::optional<Nanometres> reach = lengths.perhaps("--reach", arguments.reach);
  if (reach && reach->count < -plan.depth.count) {
    lengths.refuse(fmt::format("--depth: expected at most the reach of the thread mill, {}, found '{}'",
                               thread_mm(*reach), arguments.depth));
  }
}

ThreadJob thread_job_of(const CamThreadArguments& arguments, const MillJob& mill, LengthArguments& lengths) {
  ThreadJob job;
  const std::optional<ThreadSize> size = size_of(arguments, lengths);
  if (!size) return job;
  ThreadOptions& plan = job.plan;
  plan.size = *size;
  plan.cutter = lengths.above_0("--tool", arguments.tool);
  plan.depth = lengths.below_0("--depth", arguments.depth, "-8");
  plan.oversize = lengths.any("--oversize", arguments.oversize);
  plan.teeth = arguments.teeth;
  plan.passes = arguments.passes;
  plan.is_external = arguments.external;
  plan.is_left_hand = arguments.left_hand;
  plan.climb = !arguments.conventional;
  plan.park = mill.program.park;
  job.hole = arguments.external ? size->major : size->minor();
  if (const auto hole = lengths.perhaps("--hole", arguments.hole)) job.hole = *hole;
  if (arguments.neck.empty()) lengths.refuse("--neck: expected the diameter of the thread mill's neck");
  if (static_cast<double>(std::abs(plan.oversize.count)) > size->pitch_nm / 4) {
    lengths.refuse("--oversize: expected at most a quarter of the pitch");
  }
  constexpr double most_turns = 1000;
  if (static_cast<double>(-plan.depth.count) > most_turns * size->pitch_nm) {
    lengths.refuse("--depth: expected at most 1000 turns of the thread");
  }
  if (!lengths.message().empty()) return job;
  check_teeth(arguments, job, lengths);
  check_room(arguments, job, lengths);
  return job;
}

// The axes of the threads. Circles that cannot be the bore or the boss are warned about.
std::vector<DrawnPoint> places_of(const Drawing& drawing, const ThreadJob& job, Diagnostics& findings) {
  constexpr std::int64_t tolerance = 50'000;
  const Nanometres least = job.plan.is_external ? job.plan.size.root() : std::min(job.hole, job.plan.size.minor());
  std::vector<DrawnPoint> places;
  std::string others;
  std::size_t count = 0;
  for (const DrawnHole& hole : drawing.holes) {
    if (std::ranges::find(places, hole.at) != places.end()) continue;
    places.push_back(hole.at);
    const bool may_be = hole.diameter.count == 0 || (hole.diameter.count >= least.count - tolerance &&
                                                     hole.diameter.count <= job.plan.size.major.count + tolerance);
    if (may_be) continue;
    ++count;
    if (count <= 3) others += (others.empty() ? "" : ", ") + thread_mm(hole.diameter);
  }
  if (count > 0) {
    findings.add(
        {.severity = Severity::warning,
         .code = "thread.other-diameter",
         .file = drawing.file,
         .place = {},
         .message = fmt::format("{} of {} cannot be for {}", counted(count, "circle"), others, job.plan.size.name),
         .expected = fmt::format("circles of {} to {}", thread_mm(least), thread_mm(job.plan.size.major)),
         .text = {}});
  }
  if (places.empty()) {
    findings.add(of_file("thread.no-circle", drawing.file, "there is no circle to thread",
                         "circles on the selected layers of the drawing"));
  }
  return places;
}

Region discs_at(const std::vector<DrawnPoint>& places, Nanometres diameter) {
  std::vector<DrawnRing> rings;
  const Nanometres radius{diameter.count / 2};
  for (const DrawnPoint at : places) {
    const std::vector<PathPoint> circle = {{{at.x + radius, at.y}, 1}, {{at.x - radius, at.y}, 1}};
    rings.push_back(chords_of_path(circle, true, {10'000}));
  }
  return filled(rings);
}

// How far the teeth reach from the axis of the next boss, including the lead-in.
Mm reach_of_teeth(const MillPlan& plan, const std::vector<DrawnPoint>& places, Nanometres cutter) {
  double farthest = 0;
  for (const MillRun& run : plan.tools.front().runs) {
    for (const MillPoint& point : run) {
      double nearest = std::numeric_limits<double>::max();
      for (const DrawnPoint& place : places) {
        nearest = std::min(nearest, std::hypot(static_cast<double>((point.at.x - place.x).count),
                                               static_cast<double>((point.at.y - place.y).count)));
      }
      farthest = std::max(farthest, nearest);
    }
  }
  return Mm(farthest / nanometres_per_mm + to_mm(cutter).value() / 2);
}

}  // namespace

int cam_thread(const CamThreadArguments& arguments, const WorkProgress& progress) {
  if (!outputs_are_good(arguments, "")) return exit_bad_program;
  LengthArguments lengths(*mm_of_unit(arguments.units));
  MillJob mill = mill_job_of(arguments, "passo cam thread", lengths, "stock");
  const ThreadJob job = thread_job_of(arguments, mill, lengths);
  if (!lengths.message().empty()) return fail(exit_bad_program, lengths.message());
  mill.reading.dxf.is_for_drilling = true;
  std::optional<Drawing> drawing = read_drawings(arguments, mill);
  if (!drawing) return exit_bad_program;
  mirror_drawing(*drawing, mill.mirror);
  if (mill.zero.at || mill.zero.is_lower_left) {
    move_zero_to(mill.zero.is_lower_left ? lower_left_of({*drawing}) : *mill.zero.at, *drawing);
  }
  Diagnostics findings;
  const std::vector<DrawnPoint> places = places_of(*drawing, job, findings);
  show(findings, listed(arguments.files));
  if (findings.any_error()) return exit_bad_program;

  ThreadPlan plan = plan_threads(places, job.plan);
  const ThreadSize& size = job.plan.size;
  plan.mill.tools.front().words =
      fmt::format("thread mill {:.4g} mm for {}", to_mm(job.plan.cutter).value(), size.name);
  // The feed rate is that of the teeth at the wall; the centre runs on a smaller circle, or on a wider one.
  mill.program.feed = {std::llround(static_cast<double>(mill.program.feed.count) * plan.feed_factor)};
  mill.program.remarks.push_back(fmt::format("{}{}, {}, {} milling {}", size.name,
                                             job.plan.is_left_hand ? ", left-hand" : "",
                                             job.plan.is_external ? "on bosses" : "in bores",
                                             job.plan.climb ? "climb" : "conventional", plan.goes_up ? "up" : "down"));
  const double pitch_mm = size.pitch_nm / nanometres_per_mm;
  const Nanometres cut = job.plan.is_external ? size.root() - job.plan.oversize : size.major + job.plan.oversize;
  std::string words = fmt::format("{}: {}, pitch {:.6g} mm, {} to {}; {} in {} {}, {} milling\n", size.name,
                                  counted(places.size(), "thread"), pitch_mm, thread_mm(job.hole), thread_mm(cut),
                                  counted(plan.turns, "turn"), counted(job.plan.passes, "pass", "passes"),
                                  plan.goes_up ? "upwards" : "downwards", job.plan.climb ? "climb" : "conventional");
  nlohmann::ordered_json json = {{"thread", size.name},
                                 {"threads", places.size()},
                                 {"pitch_mm", pitch_mm},
                                 {"major_mm", to_mm(size.major).value()},
                                 {"hole_mm", to_mm(job.hole).value()},
                                 {"cut_mm", to_mm(cut).value()},
                                 {"turns", plan.turns},
                                 {"passes", job.plan.passes},
                                 {"upwards", plan.goes_up},
                                 {"left_hand", job.plan.is_left_hand},
                                 {"climb", job.plan.climb}};
  if (job.plan.is_external) {
    const Mm reach = reach_of_teeth(plan.mill, places, job.plan.cutter);
    json["clear_radius_mm"] = reach.value();
    note(fmt::format(
        "the teeth reach {:.4g} mm from the axis of each boss: the stock around the boss must be cleared to "
        "this radius, over the depth of the thread",
        reach.value()));
  }
  const Region face = discs_at(places, size.major);
  return deliver(arguments, mill, {plan.mill, face, {}, {}, words, json}, progress);
}

}  // namespace passo
