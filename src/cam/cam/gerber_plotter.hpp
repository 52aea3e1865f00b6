// GerberPlotter: executes the drawing commands of a Gerber file. It draws flashes, strokes and contours with the
// current aperture, polarity and mode into an image or into a block. Private to cam/.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gerber_findings.hpp"
#include "gerber_image.hpp"

namespace passo {

enum class Interpolation : std::uint8_t { linear, clockwise, counterclockwise };
enum class Quadrants : std::uint8_t { unknown, single, multi };

struct PlotterAperture {
  std::size_t index = 0;  // index into GerberLayer::apertures
  bool is_round = false;
  double diameter = 0;                 // nm, if the aperture is round
  Region shape = {};                   // about the origin
  std::unique_ptr<GerberImage> block;  // used instead of a shape
};

// The parameters of a stroke that define the centre of its arc.
struct ArcWords {
  Offset ij = {};
  bool has_any = false;
};

class GerberPlotter {
 public:
  GerberPlotter(GerberLayer& layer, GerberFindings& findings, std::size_t most_points)
      : layer_(layer),
        findings_(findings),
        most_points_(most_points),
        budget_(static_cast<double>(most_points) / static_cast<double>(most_gerber_points)) {
    frames_.emplace_back();
  }

  // Set the current modes. `modal`: the transformation of apertures.
  void set_dark(bool is_dark);
  void set_modal(const GerberPlacement& modal);
  const GerberPlacement& modal() const { return modal_; }
  Interpolation interpolation = Interpolation::linear;
  Quadrants quadrants = Quadrants::unknown;
  std::uint32_t net = 0;  // of the strokes and contours

  void define(std::uint32_t code, PlotterAperture aperture);
  void select(std::uint32_t code);

  DrawnPoint at() const { return at_; }
  void move_to(DrawnPoint place);
  void draw_to(DrawnPoint place, const ArcWords& words);
  void flash(DrawnPoint place, std::uint32_t of_net);
  void begin_region();
  void end_region();
  bool in_region() const { return in_region_; }

  void begin_block(std::uint32_t code);
  void end_block();
  void begin_repeat(std::int64_t across, std::int64_t up, DrawnPoint step);
  void end_repeat();

  // Reserves points before they are created. Returns false, and reports it once, if the limit would be exceeded.
  bool has_room_for(std::size_t points);
  bool is_full() const { return is_full_; }
  // Does the same for rings to be united.
  bool can_unite(const std::vector<DrawnRing>& rings);
  RegionBudget& budget() { return budget_; }

  // Returns everything drawn. Closes blocks that are still open, and adds a note.
  GerberImage finish();

 private:
  struct Frame {
    GerberImage image;
    bool is_block = false;    // whether this is an aperture block
    std::uint32_t code = 0;   // aperture number of a block
    std::int64_t across = 1;  // columns of a repeat
    std::int64_t up = 1;
    DrawnPoint step = {};
  };
  // The current aperture, transformed.
  struct Tool {
    bool is_round = false;
    double diameter = 0;
    Region shape;
    DrawnRing hull;
  };

  GerberImage& image() { return frames_.back().image; }
  const PlotterAperture* aperture();
  const Tool& tool();
  void finish_stroke();
  void finish_contour();
  void draw_way(std::size_t first, std::size_t last);
  void keep_name(DrawnPoint place);
  void add_to_path(const GerberArc* arc, DrawnPoint to);
  bool find_arc(DrawnPoint to, const ArcWords& words, GerberArc& arc);
  Frame* push_frame();  // null, and reported, if there are too many
  void pop_frame();

  GerberLayer& layer_;
  GerberFindings& findings_;
  std::vector<Frame> frames_;
  std::map<std::uint32_t, PlotterAperture> apertures_;
  std::uint32_t code_ = 0;  // number of the selected aperture; 0: none
  bool is_dark_ = true;
  GerberPlacement modal_;
  DrawnPoint at_;
  bool in_region_ = false;
  std::vector<DrawnPoint> way_;  // the current stroke or contour as chords
  DrawnPath path_;               // the same stroke, including its arcs
  Tool tool_;
  bool tool_is_new_ = true;
  std::size_t points_ = 0;
  std::size_t most_points_;
  bool is_full_ = false;
  RegionBudget budget_;
};

// Adds the extent of an aperture's shape to the data shown to the user.
void measure(const Region& shape, GerberAperture& aperture);

}  // namespace passo
