#include "simulate_report.hpp"

#include <cmath>

#include <fmt/format.h>

#include "passo/base/counted.hpp"
#include "passo/diagnostics/findings_json.hpp"

namespace passo {
namespace {

std::string tools_in_words(const Simulation& simulation) {
  std::string words;
  for (std::size_t i = 0; i < simulation.tools.size(); ++i) {
    words += fmt::format("{}T{} {}", i > 0 ? "; " : "", simulation.numbers[i], describe(simulation.tools[i].cutter));
  }
  return words;
}

std::string line_in_words(const LargestOf& largest) {
  return largest.line > 0 ? fmt::format(", line {}", largest.line) : "";
}

std::string side_in_words(const FieldDifference::Side& side) {
  if (side.cells == 0) return "none";
  return fmt::format("{:.3f} mm\u00B3, at most {} at {}", side.volume, mm_in_words(side.largest),
                     place_in_words(side.place));
}

std::string duration_in_words(Seconds time) {
  const auto seconds = static_cast<long>(std::lround(time.value()));
  if (seconds < 60) return fmt::format("{:.1f} s", time.value());
  return seconds < 3600 ? fmt::format("{}:{:02} min", seconds / 60, seconds % 60)
                        : fmt::format("{}:{:02}:{:02} h", seconds / 3600, seconds / 60 % 60, seconds % 60);
}

nlohmann::ordered_json as_json(const Vector3& place) {
  return {{"x", place.x}, {"y", place.y}, {"z", place.z}};
}

nlohmann::ordered_json as_json(const LargestOf& largest, const char* name) {
  return {{name, largest.value}, {"line", largest.line}};
}

nlohmann::ordered_json as_json(const FieldDifference::Side& side) {
  nlohmann::ordered_json json = {{"volume_mm3", side.volume}, {"largest_mm", side.largest}, {"cells", side.cells}};
  if (side.cells > 0) json["place"] = as_json(side.place);
  return json;
}

}  // namespace

std::string in_short(const Simulation& simulation) {
  return fmt::format(
      "{}   \u00B7   {:.1f} cm\u00B3 removed   \u00B7   {} at most in a move   \u00B7   cells of {:g} mm",
      tools_in_words(simulation), simulation.summary.volume() / 1000, mm_in_words(simulation.summary.depth().value),
      simulation.field.cell());
}

std::string to_text(const Simulation& simulation) {
  const CutSummary& summary = simulation.summary;
  const HeightField& field = simulation.field;
  const StockBlock& block = field.block();
  std::string text = fmt::format("{}: {}, {} of them cut\n", simulation.program, counted(summary.moves(), "move"),
                                 summary.cutting_moves());
  const auto add = [&](const char* name, const std::string& words) { text += fmt::format("{:<16}{}\n", name, words); };
  add("stock",
      fmt::format("X {:g} to {:g}, Y {:g} to {:g}, Z {:g} to {:g}; {} x {} cells of {:g} mm", block.low.x, block.high.x,
                  block.low.y, block.high.y, block.low.z, block.high.z, field.columns(), field.rows(), field.cell()));
  add("tools", tools_in_words(simulation));
  const double share = 100 * summary.volume() / simulation.volume_before;
  add("removed", fmt::format("{:.2f} cm\u00B3, {:.1f} % of the stock", summary.volume() / 1000, share));
  if (summary.cutting_moves() > 0) {
    add("removal rate",
        fmt::format("{:.2f} mm\u00B3/s on average over {} of cutting; at most {:.2f}{}", summary.mean_rate(),
                    duration_in_words(summary.cutting_time()), summary.rate().value, line_in_words(summary.rate())));
    add("depth of cut",
        fmt::format("{} at most{}", mm_in_words(summary.depth().value), line_in_words(summary.depth())));
    add("engagement",
        fmt::format("{:.0f} % of the diameter at most{}; above {:.0f} % over {:.0f} % of the cutting distance",
                    100 * summary.engagement().value, line_in_words(summary.engagement()),
                    100 * CutSummary::heavy_engagement,
                    summary.cutting_way() > 0 ? 100 * std::min(1.0, summary.heavy_way() / summary.cutting_way()) : 0));
  }
  if (simulation.difference) {
    add("material left", side_in_words(simulation.difference->left));
    const FieldDifference& difference = *simulation.difference;
    add("gouges", difference.gouge.cells > 0
                      ? side_in_words(difference.gouge)
                      : fmt::format("none deeper than {}, or {} sideways into a wall",
                                    mm_in_words(difference.unseen_depth), mm_in_words(difference.unseen_sideways)));
  }
  return text;
}

std::string to_json(const Simulation& simulation, const Diagnostics& findings) {
  const CutSummary& summary = simulation.summary;
  const HeightField& field = simulation.field;
  nlohmann::ordered_json tools = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < simulation.tools.size(); ++i) {
    tools.push_back({{"tool", simulation.numbers[i]},
                     {"shape", std::string(name_of(simulation.tools[i].cutter.kind()))},
                     {"diameter_mm", 2 * simulation.tools[i].cutter.radius.value()}});
  }
  nlohmann::ordered_json json = {
      {"good", !findings.any_error()},
      {"moves", summary.moves()},
      {"cutting_moves", summary.cutting_moves()},
      {"stock",
       {{"low", as_json(field.block().low)},
        {"high", as_json(field.block().high)},
        {"cell_mm", field.cell()},
        {"columns", field.columns()},
        {"rows", field.rows()}}},
      {"tools", std::move(tools)},
      {"removed_mm3", summary.volume()},
      {"left_mm3", field.volume()},
      {"cutting_time_s", summary.cutting_time().value()},
      {"cutting_way_mm", summary.cutting_way()},
      {"mean_removal_mm3_s", summary.mean_rate()},
      {"largest_removal", as_json(summary.rate(), "mm3_s")},
      {"largest_depth", as_json(summary.depth(), "mm")},
      {"largest_engagement", as_json(summary.engagement(), "of_diameter")},
      {"heavy_engagement", {{"above_of_diameter", CutSummary::heavy_engagement}, {"way_mm", summary.heavy_way()}}},
      {"rapids_through_stock", summary.count(CutTrouble::Kind::rapid)},
      {"cuts_deeper_than_flutes", summary.count(CutTrouble::Kind::flutes)},
      {"holder_hits", summary.count(CutTrouble::Kind::holder)},
      {"clamp_hits", summary.count(CutTrouble::Kind::clamp)},
      {"cuts_below_stock", summary.count(CutTrouble::Kind::below)}};
  if (simulation.difference) {
    json["material_left"] = as_json(simulation.difference->left);
    json["gouges"] = as_json(simulation.difference->gouge);
    json["unseen_gouge"] = {{"deep_mm", simulation.difference->unseen_depth},
                            {"sideways_mm", simulation.difference->unseen_sideways}};
  }
  json["findings"] = findings_json(findings.all());
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace passo
