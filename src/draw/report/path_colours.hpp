// PathColours: which colour each piece of a recorded path has. Private to report/.
//
// Speeds, depths and loads have the map of SpeedColours: fast is dark, deep is dark, and little margin is dark. Tools
// have colours that the colour-blind can tell apart (Okabe and Ito, 2008), without the two that hardly show on white
// paper.
#pragma once

#include "speed_colours.hpp"

#include "passo/report/path_recorder.hpp"
#include "passo/report/picture.hpp"

namespace passo {

class PathColours {
 public:
  PathColours(const PathRecorder& path, PathColour by);

  PathColour by() const { return by_; }
  // Pieces of one class have one colour, so that neighbours become one stroke.
  std::size_t classes() const;
  // `z` is the height of the piece's middle, relative to the base of the path.
  std::size_t class_of(const PathRecorder::Vertex& vertex, double z) const;
  Colour of_class(std::size_t index) const;
  // In how many parts a piece between these two heights is drawn, so that its colour follows its depth.
  int parts_between(double from_z, double to_z) const;

  static Colour of_tool(std::size_t index);

 private:
  PathColour by_;
  SpeedColours speeds_;
  double top_;     // of the feeds, relative to the base
  double height_;  // 0: all feeds are level
};

}  // namespace passo
