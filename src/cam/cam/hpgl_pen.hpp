// HpglPen: converts the pen movements of a plotter to paths and circles of a drawing. Private to cam/.
//
// Coordinates are in plotter units of 0.025 mm. If a dash pattern is set, lines and arcs are dashed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "drawing_builder.hpp"
#include "dxf_transform.hpp"

#include "passo/cam/hpgl.hpp"

namespace passo {

struct HpglSpot {
  double x = 0;
  double y = 0;
};

class HpglPen {
 public:
  HpglPen(const std::string& file, const HpglOptions& options, Diagnostics& diagnostics);

  // Selects a pen. With 0, no pen, nothing is drawn.
  void select_pen(std::uint32_t number);
  // Rotates the sheet about the origin, counterclockwise, by this number of quarter turns.
  void rotate_sheet(int quarters);
  // Sets alternating lengths of dashes and gaps; empty: solid.
  void set_dashes(std::vector<double> lengths);
  // Sets the line of the file with the current command.
  void set_line(std::uint32_t line) { line_ = line; }

  // Lowers the pen at its position. If it is raised again without a line, it leaves a dot.
  void lower();
  // Ends the line, or the dot if the pen has not moved since it was lowered.
  void raise();
  void move_to(HpglSpot to);
  void line_to(HpglSpot to);
  // Draws an arc about the centre; the sweep is in radians, positive counterclockwise.
  void arc(HpglSpot centre, double sweep);
  // Draws a circle about the current pen position, which does not change.
  void circle(double radius);
  void end_path();

  HpglSpot at() const { return at_; }
  double tolerance() const { return tolerance_; }  // chord tolerance
  bool has_drawn() const { return has_drawn_; }
  bool is_full() const { return builder_.is_full(); }
  DrawingBuilder& builder() { return builder_; }

 private:
  bool draws() const { return has_pen_ && is_chosen_; }
  void put(HpglSpot spot, double bulge_before = 0);
  void dashed_to(HpglSpot to);
  SourceLocation place() const { return {line_, line_ == 0 ? 0U : 1U, 1}; }

  const HpglOptions& options_;
  DrawingBuilder builder_;
  double unit_mm_;
  double tolerance_;
  DxfTransform sheet_;
  HpglSpot at_;
  DrawnPath path_;
  std::vector<double> dashes_;
  std::size_t dash_ = 0;  // index of the current dash or gap; even: dash
  double dash_used_ = 0;  // used length of the current dash or gap
  DrawnPoint last_ = {};  // where the last line or dot ended
  bool has_last_ = false;
  std::uint32_t layer_ = 0;
  std::uint32_t line_ = 0;
  bool has_pen_ = true;
  bool is_chosen_ = true;
  bool has_drawn_ = false;
};

}  // namespace passo
