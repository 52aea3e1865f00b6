#include "passo/cam/wire_program.hpp"

#include "arc_fit.hpp"
#include <fmt/format.h>

#include "passo/cam/bulge.hpp"
#include "passo/cam/program_text.hpp"

namespace passo {
namespace {

std::string place_of_ends(const ProgramText& text, const WirePlace& at) {
  return fmt::format("{} U{} V{}", text.place(at.left), text.number(at.right.x), text.number(at.right.y));
}

// Each move in its own time.
void write_ends(const WirePlan& plan, ProgramText& text) {
  text.line("G93");
  for (std::size_t i = 1; i < plan.towers.size(); ++i) {
    const std::string place = place_of_ends(text, plan.towers[i]);
    // Lengths are rounded in the program: ends that do not move are no move.
    if (place == place_of_ends(text, plan.towers[i - 1])) continue;
    text.line("G1 {} F{:.6g}", place, 1 / plan.minutes[i]);
  }
  text.line("G94");
}

void write_one_way(const WirePlan& plan, double feed, ProgramText& text) {
  std::vector<DrawnPoint> places;
  for (const WirePlace& at : plan.faces) places.push_back(at.left);
  const std::vector<PathPoint> way = with_arcs(places, {});
  text.line("F{}", text.number(to_nanometres(Mm(feed))));
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    const std::string place = text.place(way[i + 1].at);
    if (way[i].bulge == 0) {
      text.line("G1 {}", place);
      continue;
    }
    const DrawnPoint centre = to_centre(way[i].at, way[i + 1].at, way[i].bulge);
    text.line("{} {} I{} J{}", way[i].bulge > 0 ? "G3" : "G2", place, text.number(centre.x), text.number(centre.y));
  }
}

}  // namespace

std::string write_wire_program(const WirePlan& plan, const WireProgramOptions& options) {
  ProgramText text(options.units);
  text.line("({}, by passo cam wire)", in_comment(options.name));
  for (const std::string& file : options.files) text.line("(from {})", in_comment(file));
  for (const std::string& remark : options.remarks) text.line("({})", in_comment(remark));
  text.begin_modes();
  const WirePlace& start = options.has_four_axes ? plan.towers.front() : plan.faces.front();
  text.line("G0 {}", options.has_four_axes ? place_of_ends(text, start) : text.place(start.left));
  if (options.heat) {
    text.line("M3 S{}", *options.heat);
    text.line("G4 P3 (the wire gets hot)");
  }
  if (options.has_four_axes) {
    write_ends(plan, text);
  } else {
    write_one_way(plan, options.feed, text);
  }
  if (options.heat) text.line("M5");
  text.line("M2");
  return text.take();
}

}  // namespace passo
