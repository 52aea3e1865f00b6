// Reads a board of EasyEDA's standard edition. A board is JSON; each of its shapes is a string whose fields are
// separated by "~". Lengths are in units of 10 mil, Y points down, and the canvas has its zero at head.x, head.y.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "copper_builder.hpp"
#include "design_readers.hpp"
#include "svg_path.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/base/read_double.hpp"
#include "passo/cam/bulge.hpp"
#include "passo/cam/edge_loops.hpp"

namespace passo {
namespace {

constexpr double easyeda_unit_nm = 254'000;
constexpr std::size_t most_easyeda_shapes = 2'000'000;
constexpr std::size_t most_easyeda_pieces = 1'000'000;  // of one path

std::vector<std::string_view> parts_between(std::string_view text, std::string_view mark) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(mark);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + mark.size());
  }
}

class EasyedaBoardReader {
 public:
  EasyedaBoardReader(const std::string& name, Diagnostics& diagnostics)
      : diagnostics_(diagnostics), builder_(name, "easyeda", "EasyEDA", "BoardOutLine", diagnostics) {}

  DesignBoard read(const nlohmann::json& json);

 private:
  using Fields = std::vector<std::string_view>;

  void read_shape(std::string_view text);
  void read_lib(std::string_view text);
  void read_track(const Fields& fields);
  void read_arc(const Fields& fields);
  void read_circle(const Fields& fields);
  void read_rectangle(const Fields& fields);
  void read_via(const Fields& fields);
  void read_pad(const Fields& fields);
  void read_hole(const Fields& fields);
  void read_area(const Fields& fields);
  void read_region(const Fields& fields);
  void draw(int layer, const std::string& net, DrawnPath path);
  DrawnRing pad_ring(const Fields& fields, DrawnPoint at);
  std::vector<DrawnPath> paths_of(std::string_view data);

  static std::string_view field(const Fields& fields, std::size_t index) {
    return index < fields.size() ? fields[index] : std::string_view();
  }
  double value(std::string_view text);
  double value(const Fields& fields, std::size_t index) { return value(field(fields, index)); }
  int layer(const Fields& fields, std::size_t index) {
    return static_cast<int>(std::clamp(value(fields, index), 0.0, 200.0));
  }
  Nanometres length(double units) const { return {std::llround(units * easyeda_unit_nm)}; }
  DrawnPoint point(double x, double y) const { return {length(x - zero_x_), length(zero_y_ - y)}; }
  std::vector<DrawnPoint> points(std::string_view text);
  std::vector<std::size_t> sheets_of(int layer) const;

  Diagnostics& diagnostics_;
  CopperBuilder builder_;
  double zero_x_ = 0;
  double zero_y_ = 0;
  std::uint32_t shape_ = 0;  // counts from 1: the file has no lines
  std::map<int, std::size_t> sheets_;
};

double EasyedaBoardReader::value(std::string_view text) {
  if (text.empty()) return 0;
  double read = 0;
  const auto [end, error] = read_double(text.data(), text.data() + text.size(), read);
  constexpr double farthest = 40'000;  // 10 m
  if (error == std::errc() && end == text.data() + text.size() && std::abs(read) <= farthest) return read;
  builder_.refuse("bad-number", 0,
                  fmt::format("'{}' in shape {} is no number, or too large", text.substr(0, 40), shape_),
                  "a number of up to 40,000 (10 m)");
  return 0;
}

std::vector<DrawnPoint> EasyedaBoardReader::points(std::string_view text) {
  std::vector<DrawnPoint> found;
  bool has_x = false;
  double x = 0;
  while (!text.empty() && !diagnostics_.any_error()) {
    const std::size_t begin = text.find_first_not_of(" ,");
    if (begin == std::string_view::npos) break;
    const std::size_t end = std::min(text.find_first_of(" ,", begin), text.size());
    const double read = value(text.substr(begin, end - begin));
    if (has_x) found.push_back(point(x, read));
    has_x = !has_x;
    x = read;
    text.remove_prefix(end);
  }
  return found;
}

// 1 and 2 are outer layers, 21 to 52 are inner layers, 11 stands for all copper layers.
std::vector<std::size_t> EasyedaBoardReader::sheets_of(int layer) const {
  constexpr int all_copper = 11;
  std::vector<std::size_t> found;
  for (const auto& [number, sheet] : sheets_) {
    if (layer == number || layer == all_copper) found.push_back(sheet);
  }
  return found;
}

void EasyedaBoardReader::draw(int layer, const std::string& net, DrawnPath path) {
  constexpr int outline_layer = 10;
  if (layer == outline_layer) return builder_.add_edge(std::move(path));
  for (const std::size_t sheet : sheets_of(layer)) builder_.add_stroke(sheet, net, path, 0);
}

// The data of an SVG path. Arcs become chords.
std::vector<DrawnPath> EasyedaBoardReader::paths_of(std::string_view data) {
  std::vector<SvgSubpath> subpaths;
  if (const auto flaw = read_svg_path(data, most_easyeda_pieces, subpaths)) {
    builder_.refuse("bad-path", 0, fmt::format("the path of shape {} cannot be read", shape_), flaw->expected);
    return {};
  }
  std::vector<DrawnPath> paths;
  const auto is_sane = [](SvgSpot spot) { return std::abs(spot.x) < 40'000 && std::abs(spot.y) < 40'000; };
  for (const SvgSubpath& subpath : subpaths) {
    DrawnPath path;
    path.is_closed = subpath.is_closed;
    const auto add = [&](SvgSpot spot) {
      if (is_sane(spot)) path.points.push_back({point(spot.x, spot.y), 0});
    };
    add(subpath.start);
    for (const SvgPiece& piece : subpath.pieces) {
      if (piece.arc) {
        const double radius = std::max(std::hypot(piece.arc->major.x, piece.arc->major.y),
                                       std::hypot(piece.arc->minor.x, piece.arc->minor.y));
        const std::size_t chords =
            radius < 40'000 ? chords_of_arc(radius * easyeda_unit_nm, piece.arc->sweep) : std::size_t{1};
        for (std::size_t i = 1; i < chords; ++i) {
          add(piece.arc->at(piece.arc->start +
                            piece.arc->sweep * static_cast<double>(i) / static_cast<double>(chords)));
        }
      }
      add(piece.end);
    }
    if (path.points.size() >= 2) paths.push_back(std::move(path));
  }
  return paths;
}

// TRACK~width~layer~net~points
void EasyedaBoardReader::read_track(const Fields& fields) {
  DrawnPath path;
  for (const DrawnPoint& at : points(field(fields, 4))) path.points.push_back({at, 0});
  path.width = length(value(fields, 1));
  if (path.points.size() >= 2) draw(layer(fields, 2), std::string(field(fields, 3)), std::move(path));
}

// ARC~width~layer~net~path
void EasyedaBoardReader::read_arc(const Fields& fields) {
  for (DrawnPath& path : paths_of(field(fields, 4))) {
    path.width = length(value(fields, 1));
    draw(layer(fields, 2), std::string(field(fields, 3)), std::move(path));
  }
}

// CIRCLE~x~y~radius~width~layer~id~locked~net
void EasyedaBoardReader::read_circle(const Fields& fields) {
  const double x = value(fields, 1);
  const double y = value(fields, 2);
  const double radius = value(fields, 3);
  draw(layer(fields, 5), std::string(field(fields, 8)),
       {.points = {{point(x - radius, y), 1}, {point(x + radius, y), 1}},
        .is_closed = true,
        .width = length(value(fields, 4))});
}

// RECT~x~y~across~up~layer~id~locked~width~fill
void EasyedaBoardReader::read_rectangle(const Fields& fields) {
  const double x = value(fields, 1);
  const double y = value(fields, 2);
  const double across = value(fields, 3);
  const double up = value(fields, 4);
  DrawnPath path{
      .points = {{point(x, y + up), 0}, {point(x + across, y + up), 0}, {point(x + across, y), 0}, {point(x, y), 0}},
      .is_closed = true,
      .width = length(value(fields, 8))};
  if (!field(fields, 9).empty() && field(fields, 9) != "none") {
    const DrawnRing ring = chords_of_path(path.points, true, gerber_tolerance);
    for (const std::size_t sheet : sheets_of(layer(fields, 5))) builder_.add_face(sheet, "", ring, 0);
  }
  draw(layer(fields, 5), "", std::move(path));
}

// VIA~x~y~diameter~net~hole radius
void EasyedaBoardReader::read_via(const Fields& fields) {
  const DrawnPoint at = point(value(fields, 1), value(fields, 2));
  const std::string net(field(fields, 4));
  builder_.add_hole({at, length(2 * value(fields, 5)), 0, 0});
  const DrawnRing ring = moved(disc_ring({}, static_cast<double>(length(value(fields, 3)).count)), at);
  for (const auto& [number, sheet] : sheets_) {
    builder_.add_face(sheet, net, ring, 0);
    builder_.add_place(sheet, net, at, 0);
  }
}

DrawnRing EasyedaBoardReader::pad_ring(const Fields& fields, DrawnPoint at) {
  const std::string_view shape = field(fields, 1);
  const auto across = static_cast<double>(length(value(fields, 4)).count);
  const auto up = static_cast<double>(length(value(fields, 5)).count);
  if (shape == "RECT" || shape == "POLYGON") {
    const std::vector<DrawnPoint> corners = points(field(fields, 10));  // where they lie on the board
    if (corners.size() >= 3) return corners;
  }
  if (across <= 0 || up <= 0) return {};
  DrawnRing ring = shape == "RECT"   ? rectangle_ring({}, across, up)
                   : shape == "OVAL" ? (across == up ? disc_ring({}, across) : obround_ring(across, up))
                                     : disc_ring({}, across);
  return moved(turned(std::move(ring), value(fields, 11) * std::numbers::pi / 180), at);
}

// PAD~shape~x~y~across~up~layer~net~number~hole radius~corners~degrees~id~hole length~hole ends~plated
void EasyedaBoardReader::read_pad(const Fields& fields) {
  const DrawnPoint at = point(value(fields, 2), value(fields, 3));
  const std::string net(field(fields, 7));
  const Nanometres drill = length(2 * value(fields, 9));
  const std::uint32_t plating = field(fields, 15) == "N" ? 1 : 0;
  const std::vector<DrawnPoint> ends = value(fields, 13) > 0 ? points(field(fields, 14)) : std::vector<DrawnPoint>{};
  if (ends.size() == 2 && ends[0] != ends[1]) {
    builder_.add_slot({.points = {{ends[0], 0}, {ends[1], 0}}, .width = drill, .layer = plating});
  } else {
    builder_.add_hole({at, drill, plating, 0});
  }
  const DrawnRing ring = pad_ring(fields, at);
  for (const std::size_t sheet : sheets_of(layer(fields, 6))) {
    builder_.add_face(sheet, net, ring, 0);
    builder_.add_place(sheet, net, at, 0);
  }
}

// HOLE~x~y~radius
void EasyedaBoardReader::read_hole(const Fields& fields) {
  builder_.add_hole({point(value(fields, 1), value(fields, 2)), length(2 * value(fields, 3)), 1, 0});
}

// COPPERAREA~width~layer~net~path~clearance~style
void EasyedaBoardReader::read_area(const Fields& fields) {
  if (field(fields, 6) == "none") return;
  const std::string net(field(fields, 3));
  const Nanometres width = length(value(fields, 1));
  const Nanometres isolate = std::max(length(value(fields, 5)), Nanometres{1'000});
  for (const DrawnPath& path : paths_of(field(fields, 4))) {
    for (const std::size_t sheet : sheets_of(layer(fields, 2))) {
      builder_.add_pour(sheet, net,
                        {.outline = chords_of_path(path.points, true, gerber_tolerance),
                         .width = width,
                         .isolate = isolate,
                         .edge_distance = isolate});
    }
  }
}

// SOLIDREGION~layer~net~path~type
void EasyedaBoardReader::read_region(const Fields& fields) {
  const std::string_view type = field(fields, 4);
  for (DrawnPath& path : paths_of(field(fields, 3))) {
    if (type == "npth" || type == "board") {  // an opening of the board
      path.is_closed = true;
      builder_.add_edge(path);
      continue;
    }
    const DrawnRing ring = chords_of_path(path.points, true, gerber_tolerance);
    for (const std::size_t sheet : sheets_of(layer(fields, 1))) {
      if (type == "cutout") {
        builder_.add_cutout(sheet, ring);
      } else {
        builder_.add_face(sheet, std::string(field(fields, 2)), ring, 0);
      }
    }
  }
}

// LIB~x~y~...#@$shape#@$shape
void EasyedaBoardReader::read_lib(std::string_view text) {
  const std::vector<std::string_view> parts = parts_between(text, "#@$");
  for (std::size_t i = 1; i < parts.size() && !diagnostics_.any_error() && !builder_.is_full(); ++i) {
    if (!parts[i].starts_with("LIB~")) read_shape(parts[i]);
  }
}

void EasyedaBoardReader::read_shape(std::string_view text) {
  if (text.starts_with("LIB~")) return read_lib(text);
  using Reader = void (EasyedaBoardReader::*)(const Fields&);
  struct Kind {
    std::string_view name;
    Reader read;
  };
  constexpr std::array kinds = {
      Kind{"TRACK", &EasyedaBoardReader::read_track},       Kind{"ARC", &EasyedaBoardReader::read_arc},
      Kind{"CIRCLE", &EasyedaBoardReader::read_circle},     Kind{"RECT", &EasyedaBoardReader::read_rectangle},
      Kind{"VIA", &EasyedaBoardReader::read_via},           Kind{"PAD", &EasyedaBoardReader::read_pad},
      Kind{"HOLE", &EasyedaBoardReader::read_hole},         Kind{"COPPERAREA", &EasyedaBoardReader::read_area},
      Kind{"SOLIDREGION", &EasyedaBoardReader::read_region}};
  const Fields fields = parts_between(text, "~");
  const auto* const kind = std::ranges::find(kinds, fields.front(), &Kind::name);
  if (kind != kinds.end()) return (this->*kind->read)(fields);
  if (fields.front() == "TEXT") {
    constexpr std::size_t layer_of_text = 7;
    for (const std::size_t sheet : sheets_of(layer(fields, layer_of_text))) builder_.add_text(sheet);
  }
  if (fields.front() == "SVGNODE") builder_.note_once("pictures (SVGNODE) are ignored");
}

// "1~TopLayer~#FF0000~true~true~true~": the copper layers in the list of all layers.
std::map<int, std::string> copper_layers_of(const nlohmann::json& json) {
  std::map<int, std::string> names = {{1, "TopLayer"}, {2, "BottomLayer"}};
  const auto layers = json.find("layers");
  if (layers == json.end() || !layers->is_array()) return names;
  constexpr int first_inner = 21;
  constexpr int last_inner = 52;
  for (const nlohmann::json& one : *layers) {
    if (!one.is_string()) continue;
    const std::vector<std::string_view> fields = parts_between(one.get_ref<const std::string&>(), "~");
    int number = 0;
    std::from_chars(fields[0].data(), fields[0].data() + fields[0].size(), number);
    const bool is_used = fields.size() > 5 && fields[5] == "true";
    if (number >= first_inner && number <= last_inner && is_used) names[number] = fields[1];
  }
  return names;
}

double number_in(const nlohmann::json& json, const char* key) {
  const auto found = json.is_object() ? json.find(key) : json.end();
  if (!json.is_object() || found == json.end()) return 0;
  double value = found->is_number() ? found->get<double>() : 0;
  if (found->is_string()) {
    const std::string& text = found->get_ref<const std::string&>();
    read_double(text.data(), text.data() + text.size(), value);
  }
  return std::abs(value) <= 40'000 ? value : 0;
}

DesignBoard EasyedaBoardReader::read(const nlohmann::json& json) {
  const auto shapes = json.find("shape");
  const auto head = json.find("head");
  if (head != json.end()) {
    zero_x_ = number_in(*head, "x");
    zero_y_ = number_in(*head, "y");
  }
  const std::map<int, std::string> names = copper_layers_of(json);
  for (const auto& [number, name] : names) {
    if (number != 2) sheets_[number] = builder_.add_sheet(name);
  }
  sheets_[2] = builder_.add_sheet(names.at(2));
  for (const nlohmann::json& shape : *shapes) {
    if (++shape_ > most_easyeda_shapes) {
      builder_.refuse("too-large", 0, "the board has over 2 million shapes", "a smaller board");
    }
    if (diagnostics_.any_error() || builder_.is_full()) break;
    if (shape.is_string()) read_shape(shape.get_ref<const std::string&>());
  }
  return builder_.take();
}

}  // namespace

bool looks_like_easyeda_board(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && text[first] == '{' && text.find("\"shape\"") != std::string_view::npos &&
         text.find("\"canvas\"") != std::string_view::npos;
}

DesignBoard read_easyeda_board(const std::string& name, std::string_view text, Diagnostics& diagnostics) {
  const auto refuse = [&](const char* code, std::string message, std::string expected) {
    diagnostics.add({.code = code,
                     .file = name,
                     .place = {},
                     .message = std::move(message),
                     .expected = std::move(expected),
                     .text = ""});
    return DesignBoard{};
  };
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (json.is_discarded()) return refuse("easyeda.syntax", "the file is not valid JSON", "a board saved by EasyEDA");
  const auto shapes = json.is_object() ? json.find("shape") : json.end();
  if (!json.is_object() || shapes == json.end() || !shapes->is_array())
    return refuse("easyeda.no-board", "the file has no list of shapes", "\"shape\": [...]");
  // 3 is a board, 1 a schematic, 4 a footprint. In old files it is at the start of a string.
  const auto head = json.find("head");
  double kind = 3;
  if (head != json.end() && head->is_object()) kind = number_in(*head, "docType");
  if (head != json.end() && head->is_string()) {
    const std::string& words = head->get_ref<const std::string&>();
    read_double(words.data(), words.data() + words.size(), kind);
  }
  constexpr double board_kind = 3;
  if (kind != board_kind)
    return refuse("easyeda.no-board", fmt::format("this is no board: its docType is {:g}", kind), "docType 3");
  return EasyedaBoardReader(name, diagnostics).read(json);
}

}  // namespace passo
