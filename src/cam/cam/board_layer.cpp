#include "passo/cam/board_layer.hpp"

#include <algorithm>
#include <iterator>
#include <map>

#include "passo/cam/design_board.hpp"
#include "passo/diagnostics/file_bytes.hpp"

namespace passo {

Region face_of(const Drawing& drawing) {
  std::vector<DrawnRing> areas;
  std::map<Nanometres, std::vector<DrawnRing>> strokes;  // by width
  for (const DrawnHole& hole : drawing.holes) {
    if (hole.diameter.count > 0) strokes[hole.diameter].push_back({hole.at});
  }
  for (const DrawnPath& path : drawing.paths) {
    if (path.points.size() < 2) continue;
    DrawnRing ring = chords_of_path(path.points, path.is_closed, usual_chord_tolerance);
    if (path.width.count > 0) {
      if (path.is_closed) ring.push_back(ring.front());
      strokes[path.width].push_back(std::move(ring));
    } else if (path.is_closed || ring.front() == ring.back()) {
      areas.push_back(std::move(ring));
    }
  }
  std::vector<Region> regions = {filled(std::move(areas))};
  for (const auto& [width, ways] : strokes) regions.push_back(swept(ways, {width.count / 2}));
  return regions.size() == 1 ? std::move(regions.front()) : united(regions);
}

std::vector<NetPlace> net_places_of(const GerberLayer& layer) {
  std::vector<NetPlace> places;
  if (layer.is_negative) return places;
  for (const std::vector<GerberPad>* const some : {&layer.pads, &layer.named}) {
    for (const GerberPad& pad : *some) {
      const bool is_known = pad.aperture < layer.apertures.size();
      const Nanometres across = is_known ? layer.apertures[pad.aperture].across : Nanometres{};
      places.push_back({pad.at, pad.net < layer.nets.size() ? layer.nets[pad.net] : "", {across.count / 2}});
    }
  }
  return places;
}

namespace {

// The layers of the board that are chosen; none is chosen: the edge, or the only one with copper.
BoardLayer layer_of(DesignBoard board, const std::string& path, const DrawingFileOptions& options,
                    Diagnostics& diagnostics) {
  BoardLayer layer;
  layer.lines.file = path;
  std::vector<Region> faces;
  const auto take = [&](GerberLayer& from) {
    std::ranges::move(net_places_of(from), std::back_inserter(layer.nets));
    faces.push_back(std::move(from.dark));
    std::ranges::move(from.strokes.paths, std::back_inserter(layer.lines.paths));
    std::ranges::move(from.strokes.notes, std::back_inserter(layer.lines.notes));
  };
  std::vector<std::string> wanted = options.dxf.layers;
  if (wanted.empty() && options.is_edge) wanted = {board.edge_name};
  std::string known;  // layers that have something on them
  std::size_t with_copper = 0;
  for (const DesignLayer& one : board.copper) {
    if (one.layer.dark.empty()) continue;
    known += (known.empty() ? "--layer " : " or ") + one.name;
    if (++with_copper == 1 && options.dxf.layers.empty() && !options.is_edge) wanted = {one.name};
  }
  if (options.dxf.layers.empty() && !options.is_edge && with_copper > 1) {
    diagnostics.add(of_file("kicad.which-layer", path, "the board has copper on several layers", known));
    return layer;
  }
  for (const std::string& name : wanted) {
    const auto found = std::ranges::find_if(board.copper, [&](const DesignLayer& one) { return one.name == name; });
    if (name != board.edge_name && found == board.copper.end()) {
      diagnostics.add(of_file("kicad.no-layer", path, "there is no copper layer '" + name + "'",
                              known + (known.empty() ? "--layer " : " or ") + board.edge_name));
      return layer;
    }
    take(name == board.edge_name ? board.edge : found->layer);
  }
  layer.face = faces.size() == 1 ? std::move(faces.front()) : united(faces);
  return layer;
}

}  // namespace

BoardLayer read_board_layer(const std::string& path, const DrawingFileOptions& options, Diagnostics& diagnostics) {
  BoardLayer layer;
  layer.lines.file = path;
  const FileKind kind{.area = "drawing",
                      .expected = "a Gerber, DXF or drill file, or a board of KiCad, EAGLE or EasyEDA"};
  const std::optional<std::string> bytes = read_bytes(path, kind, diagnostics);
  if (!bytes) return layer;
  if (looks_like_design_board(*bytes)) {
    DesignBoard board = read_design_board(path, *bytes, diagnostics);
    return diagnostics.any_error() ? layer : layer_of(std::move(board), path, options, diagnostics);
  }
  if (!looks_like_gerber(*bytes)) {
    layer.lines = read_drawing(path, options, diagnostics);
    layer.face = face_of(layer.lines);
    return layer;
  }
  GerberLayer gerber = read_gerber(path, *bytes, diagnostics);
  if (gerber.is_negative && !options.is_edge) {
    layer.bare = std::move(gerber.dark);
  } else {
    layer.face = std::move(gerber.dark);
  }
  layer.nets = net_places_of(gerber);
  layer.lines = std::move(gerber.strokes);
  layer.lines.file = path;
  return layer;
}

Region covered_by(const BoardLayer& layer, const Region& board, Diagnostics& diagnostics) {
  if (!layer.bare) return layer.face;
  if (board.empty()) {
    diagnostics.add(of_file("isolation.negative", layer.lines.file,
                            "the layer is a negative: its copper covers the whole board except the drawn areas",
                            "the board outline: --edge FILE, or an outline file"));
    return {};
  }
  return united(layer.face, subtracted(board, *layer.bare));
}

BoardEdge board_edge(const BoardLayer& layer, Nanometres join, Diagnostics& diagnostics) {
  Diagnostics found;
  BoardEdge edge;
  edge.loops = edge_loops(layer.lines, join, found, OpenRows::slots);
  edge.board = board_within(edge.loops);
  for (const Diagnostic& one : found.all()) diagnostics.add(one);
  if (edge.board.empty() && !found.any_error()) edge.board = layer.face;
  return edge;
}

}  // namespace passo
