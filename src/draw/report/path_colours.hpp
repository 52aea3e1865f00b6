// PathColours: the colour of each piece of a recorded path. Private to report/.
//
// Speeds, depths and loads use the map of SpeedColours: fast is dark, deep is dark, and a small margin is dark. Tools
// have colours that are distinguishable for the colour-blind (Okabe and Ito, 2008), without the two that are hardly
// visible on white paper.
#pragma once

#include "speed_colours.hpp"

#include "passo/report/path_recorder.hpp"
#include "passo/report/picture.hpp"

namespace passo {

class PathColours {
 public:
  PathColours(const PathRecorder& path, PathColour by);

  PathColour by() const { return by_; }
  // Returns the number of classes. Pieces of one class have the same colour, so that adjacent pieces are drawn as one
  // stroke.
  std::size_t classes() const;
  // `z` is the height of the piece's midpoint, relative to the base of the path.
  std::size_t class_of(const PathRecorder::Vertex& vertex, double z) const;
  Colour of_class(std::size_t index) const;
  // Returns the number of parts in which a piece between these heights is drawn, so that its colour follows its depth.
  int parts_between(double from_z, double to_z) const;

  static Colour of_tool(std::size_t index);

 private:
  PathColour by_;
  SpeedColours speeds_;
  double top_;     // top of the feed moves, relative to the base
  double height_;  // 0: all feed moves are at the same height
};

}  // namespace passo
