#include "cam_show_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "program_input.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/cam/drawing_file.hpp"
#include "passo/cam/edge_loops.hpp"

namespace passo {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_shown_points = 100'000;  // for the picture of the web interface
constexpr Nanometres shown_tolerance{20'000};

class ShapeList {
 public:
  explicit ShapeList(const Drawing& drawing) : drawing_(drawing) {}

  void add(const DrawnPath& path);
  void add(const DrawnHole& hole);
  Json json() const;

 private:
  void add(Json shape, std::uint32_t layer, std::uint32_t line);
  bool has_room(std::size_t points);
  std::string coordinate(Nanometres length) const {
    return fmt::format("{:g}", std::round(to_mm(length).value() * 1000) / 1000 + 0.0);
  }
  void extend(DrawnPoint least, DrawnPoint most);

  const Drawing& drawing_;
  Json shapes_ = Json::array();
  std::optional<std::pair<DrawnPoint, DrawnPoint>> box_ = {};
  std::size_t points_ = 0;
  std::size_t left_out_ = 0;
};

bool ShapeList::has_room(std::size_t points) {
  points_ += points;
  if (points_ <= most_shown_points) return true;
  ++left_out_;
  return false;
}

void ShapeList::extend(DrawnPoint least, DrawnPoint most) {
  if (!box_) box_.emplace(least, most);
  box_->first = {std::min(box_->first.x, least.x), std::min(box_->first.y, least.y)};
  box_->second = {std::max(box_->second.x, most.x), std::max(box_->second.y, most.y)};
}

// The name of a layer may have the colour and the names of the shape after it (tells_shapes of SvgOptions and
// DxfOptions).
void ShapeList::add(Json shape, std::uint32_t layer, std::uint32_t line) {
  std::istringstream lines(layer < drawing_.layers.size() ? drawing_.layers[layer] : "");
  std::string name;
  std::string color;
  std::getline(lines, name);
  std::getline(lines, color);
  Json names = Json::array();
  for (std::string one; std::getline(lines, one);) names.push_back(one);
  Json entry = {{"layer", name}, {"color", color}, {"names", std::move(names)}, {"line", line}};
  entry.update(shape);
  shapes_.push_back(std::move(entry));
}

void ShapeList::add(const DrawnPath& path) {
  const DrawnRing ring = chords_of_path(path.points, path.is_closed, shown_tolerance);
  for (const DrawnPoint& point : ring) extend(point, point);
  if (ring.size() < 2 || !has_room(ring.size())) return;
  std::string d;
  for (const DrawnPoint& point : ring) {
    d += fmt::format("{}{} {}", d.empty() ? "M" : "L", coordinate(point.x), coordinate(point.y));
  }
  add({{"closed", path.is_closed}, {"d", path.is_closed ? d + "Z" : d}}, path.layer, path.line);
}

void ShapeList::add(const DrawnHole& hole) {
  const Nanometres radius{hole.diameter.count / 2};
  extend({hole.at.x - radius, hole.at.y - radius}, {hole.at.x + radius, hole.at.y + radius});
  if (!has_room(1)) return;
  const std::string r = coordinate(radius.count > 0 ? radius : Nanometres{500'000});
  const std::string d = fmt::format("M{0} {1}m-{2} 0a{2} {2} 0 1 0 {3} 0a{2} {2} 0 1 0 -{3} 0Z", coordinate(hole.at.x),
                                    coordinate(hole.at.y), r, 2 * std::atof(r.c_str()));
  add({{"closed", true}, {"d", d}}, hole.layer, hole.line);
}

Json ShapeList::json() const {
  Json layers = Json::array();
  for (const std::string& name : drawing_.layers) {
    const std::string layer = name.substr(0, name.find('\n'));
    if (!layer.empty() && std::ranges::find(layers, Json(layer)) == layers.end()) layers.push_back(layer);
  }
  Json box = Json::array();
  if (box_) {
    for (const Nanometres length : {box_->first.x, box_->first.y, box_->second.x, box_->second.y}) {
      box.push_back(std::round(to_mm(length).value() * 1000) / 1000 + 0.0);
    }
  }
  return {{"layers", std::move(layers)}, {"shapes", shapes_}, {"box", std::move(box)}, {"left_out", left_out_}};
}

}  // namespace

int cam_show_shapes(const CamShowArguments& arguments) {
  if (arguments.files.size() != 1) return fail(exit_bad_program, "--shapes: expected one drawing");
  DrawingFileOptions reading;
  reading.svg.tells_shapes = true;
  reading.dxf.tells_shapes = true;
  Diagnostics findings;
  const Drawing drawing = read_drawing(arguments.files.front(), reading, findings);
  show(findings);
  if (findings.any_error()) return exit_bad_program;
  ShapeList shapes(drawing);
  for (const DrawnPath& path : drawing.paths) shapes.add(path);
  for (const DrawnHole& hole : drawing.holes) shapes.add(hole);
  say(shapes.json().dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
  return exit_done;
}

}  // namespace passo
