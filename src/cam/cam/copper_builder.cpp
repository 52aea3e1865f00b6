#include "copper_builder.hpp"

#include <algorithm>
#include <iterator>

#include "kicad_shapes.hpp"
#include <fmt/format.h>

#include "passo/base/counted.hpp"
#include "passo/cam/edge_loops.hpp"

namespace passo {

CopperBuilder::CopperBuilder(const std::string& name, const char* area, const char* software, const char* edge_name,
                             Diagnostics& diagnostics)
    : name_(name), area_(area), software_(software), diagnostics_(diagnostics), edge_name_(edge_name) {
  edge_.strokes.file = name;
  edge_.strokes.layers = {edge_name};
  edge_.apertures.emplace_back();
  edge_.function = "Profile";
  edge_.software = software;
  drills_.file = name;
  drills_.layers = {"plated", "not plated"};
}

std::size_t CopperBuilder::add_sheet(std::string name) {
  sheets_.push_back({std::move(name)});
  return sheets_.size() - 1;
}

void CopperBuilder::refuse(const char* code, std::uint32_t line, std::string message, std::string expected) {
  diagnostics_.add({.code = area_ + "." + code,
                    .file = name_,
                    .place = {line, line == 0 ? 0U : 1U, 1},
                    .message = std::move(message),
                    .expected = std::move(expected),
                    .text = ""});
}

bool CopperBuilder::has_room_for(std::size_t points, std::uint32_t line) {
  points_ += points + 4;
  if (points_ <= most_gerber_points) return !is_full_;
  if (!is_full_) refuse("too-large", line, "the board has too many points", "at most 16 million");
  is_full_ = true;
  return false;
}

bool CopperBuilder::affords(const std::vector<Region>& objects, std::uint32_t line) {
  if (budget_.affords(objects)) return true;
  if (!is_full_) refuse("too-large", line, "the lines of the board cross too often to be merged", "a simpler board");
  is_full_ = true;
  return false;
}

std::uint32_t CopperBuilder::net_index(Sheet& sheet, const std::string& net) {
  const auto [entry, is_new] = sheet.net_indices.try_emplace(net, static_cast<std::uint32_t>(sheet.nets.size()));
  if (is_new) sheet.nets.push_back(net);
  return entry->second;
}

void CopperBuilder::add_line(std::size_t sheet, const std::string& net, const DrawnPath& path, std::uint32_t line) {
  if (path.width.count <= 0 || path.points.empty() || !has_room_for(kicad_stroke_points(path), line)) return;
  for (Region& area : kicad_stroke_regions({&path, 1})) sheets_[sheet].objects[net].push_back(std::move(area));
}

void CopperBuilder::add_stroke(std::size_t sheet, const std::string& net, const DrawnPath& path, std::uint32_t line) {
  if (path.width.count <= 0 || path.points.empty()) return;
  add_line(sheet, net, path, line);
  if (is_full_) return;
  Sheet& on = sheets_[sheet];
  on.image.strokes.push_back(path);
  if (!net.empty()) on.image.named.push_back({path.points.front().at, 0, net_index(on, net), line});
}

void CopperBuilder::add_face(std::size_t sheet, const std::string& net, DrawnRing ring, std::uint32_t line,
                             Nanometres rim) {
  if (ring.size() < 3 || !has_room_for(ring.size(), line) || !affords({Region{{ring}}}, line)) return;
  Region face = filled({std::move(ring)});
  if (rim.count > 0) {
    face = grown(face, {rim.count / 2}, gerber_tolerance);
    for (const DrawnRing& one : face.rings) points_ += one.size();
  }
  if (!face.empty()) sheets_[sheet].objects[net].push_back(std::move(face));
}

void CopperBuilder::add_area(std::size_t sheet, const std::string& net, DrawnRing ring, std::uint32_t line) {
  if (ring.size() >= 3 && has_room_for(ring.size(), line)) sheets_[sheet].objects[net].push_back({{std::move(ring)}});
}

void CopperBuilder::add_place(std::size_t sheet, const std::string& net, DrawnPoint at, std::uint32_t line) {
  Sheet& on = sheets_[sheet];
  on.image.pads.push_back({at, 0, net_index(on, net), line});
}

void CopperBuilder::add_pour(std::size_t sheet, const std::string& net, CopperPour pour) {
  if (pour.outline.size() >= 3 && has_room_for(pour.outline.size(), 0))
    sheets_[sheet].pours.emplace_back(net, std::move(pour));
}

void CopperBuilder::add_cutout(std::size_t sheet, DrawnRing ring) {
  if (ring.size() >= 3 && has_room_for(ring.size(), 0)) sheets_[sheet].cutouts.push_back(std::move(ring));
}

void CopperBuilder::add_edge(DrawnPath path) {
  if (path.points.size() >= 2 && has_room_for(kicad_stroke_points(path), 0))
    edge_.strokes.paths.push_back(std::move(path));
}

void CopperBuilder::add_hole(const DrawnHole& hole) {
  if (hole.diameter.count > 0 && has_room_for(1, hole.line)) drills_.holes.push_back(hole);
}

void CopperBuilder::add_slot(DrawnPath slot) {
  if (slot.width.count > 0 && slot.points.size() >= 2 && has_room_for(slot.points.size(), slot.line))
    drills_.paths.push_back(std::move(slot));
}

void CopperBuilder::note_once(const std::string& words) {
  if (std::ranges::find(drills_.notes, words) == drills_.notes.end()) drills_.notes.push_back(words);
}

Region CopperBuilder::poured(Sheet& sheet, const std::string& net, const CopperPour& pour) const {
  std::vector<Region> others;
  for (const auto& [other, objects] : sheet.objects) {
    if (other != net || net.empty()) others.insert(others.end(), objects.begin(), objects.end());
  }
  const Nanometres half{pour.width.count / 2};
  Region area = grown(filled({pour.outline}), half, gerber_tolerance);
  area = subtracted(area, grown(united(others), pour.isolate, gerber_tolerance));
  if (!sheet.cutouts.empty()) area = subtracted(area, filled(sheet.cutouts));
  std::vector<DrawnRing> edges;
  for (const DrawnPath& path : edge_.strokes.paths) {
    edges.push_back(chords_of_path(path.points, path.is_closed, gerber_tolerance));
    if (path.is_closed) edges.back().push_back(edges.back().front());
  }
  if (pour.edge_distance.count > 0) area = subtracted(area, swept(edges, pour.edge_distance, gerber_tolerance));
  for (const DrawnHole& hole : drills_.holes) {
    if (hole.layer == 0) continue;  // plated: its pad has copper
    area = subtracted(area, swept({{hole.at}}, {hole.diameter.count / 2 + pour.isolate.count}, gerber_tolerance));
  }
  if (half.count > 0) area = grown(grown(area, {-half.count}, gerber_tolerance), half, gerber_tolerance);
  const auto own = sheet.objects.find(net);
  if (net.empty()) return area;
  const Region connected = own == sheet.objects.end() ? Region{} : united(own->second);
  Region kept;
  for (Region& part : parts_of(area)) {
    if (!common(part, connected).empty()) std::ranges::move(part.rings, std::back_inserter(kept.rings));
  }
  return kept;
}

void CopperBuilder::pour(Sheet& sheet) {
  std::ranges::stable_sort(sheet.pours, {}, [](const auto& pour) { return pour.second.rank; });
  for (const auto& [net, one] : sheet.pours) {
    std::vector<Region> all = {{{one.outline}}};
    for (const auto& [other, objects] : sheet.objects) all.insert(all.end(), objects.begin(), objects.end());
    if (!affords(all, 0)) return;
    Region area = poured(sheet, net, one);
    if (!area.empty()) sheet.objects[net].push_back(std::move(area));
  }
}

GerberLayer CopperBuilder::layer_of(Sheet& sheet) {
  GerberLayer layer;
  const std::size_t pours = sheet.pours.size();
  if (!is_full_) pour(sheet);
  for (auto& [net, objects] : sheet.objects) {
    for (Region& object : objects) sheet.image.add(std::move(object), true);
  }
  layer.software = software_;
  layer.function = "Copper";
  layer.apertures.emplace_back();
  layer.nets = std::move(sheet.nets);
  layer.pads = std::move(sheet.image.pads);
  layer.named = std::move(sheet.image.named);
  layer.strokes.file = name_;
  layer.strokes.layers = {sheet.name};
  layer.strokes.paths = std::move(sheet.image.strokes);
  if (pours > 0) {
    layer.strokes.notes.push_back(
        fmt::format("{} poured by Passo, without thermal reliefs: {} does not store the poured copper",
                    pours == 1 ? "a polygon is" : fmt::format("{} polygons are", pours), software_));
  }
  if (sheet.texts > 0) {
    layer.strokes.notes.push_back(sheet.texts == 1 ? "a text on this layer is ignored"
                                                   : fmt::format("{} texts on this layer are ignored", sheet.texts));
  }
  std::ranges::move(sheet.notes, std::back_inserter(layer.strokes.notes));
  if (std::optional<Region> dark = composed(std::move(sheet.image), budget_)) {
    layer.dark = std::move(*dark);
  } else if (!diagnostics_.any_error()) {
    refuse("too-large", 0, "the lines on " + sheet.name + " cross too often to be merged", "a simpler board");
  }
  return layer;
}

DesignBoard CopperBuilder::take() {
  DesignBoard board;
  board.edge_name = edge_name_;
  for (Sheet& sheet : sheets_) {
    if (diagnostics_.any_error()) break;
    board.copper.push_back({sheet.name, layer_of(sheet)});
  }
  if (!diagnostics_.any_error()) {
    const std::vector<Region> lines = kicad_stroke_regions(edge_.strokes.paths);
    if (budget_.affords(lines)) edge_.dark = united(lines);
  }
  board.edge = std::move(edge_);
  board.drills = std::move(drills_);
  return board;
}

}  // namespace passo
