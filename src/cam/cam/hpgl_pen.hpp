// HpglPen: what the pen of a plotter draws, as paths and circles of a drawing. Private to cam/.
//
// Places are in plotter units of 0.025 mm. Lines, also those of arcs, are dashed where dashes are set.
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

  // 0: no pen; then nothing is drawn.
  void select_pen(std::uint32_t number);
  // How the sheet is turned, counterclockwise about 0, in quarters.
  void rotate_sheet(int quarters);
  // Lengths of lines and gaps in turn; empty: solid.
  void set_dashes(std::vector<double> lengths);
  // Of the file: where the command stands that draws.
  void set_line(std::uint32_t line) { line_ = line; }

  void move_to(HpglSpot to);
  void line_to(HpglSpot to);
  // Around the centre; the sweep, in radians, is above 0 counterclockwise.
  void arc(HpglSpot centre, double sweep);
  // About the place where the pen is, which stays there.
  void circle(double radius);
  void end_path();

  HpglSpot at() const { return at_; }
  double tolerance() const { return tolerance_; }  // of chords
  bool has_drawn() const { return has_drawn_; }
  bool is_full() const { return builder_.is_full(); }
  DrawingBuilder& builder() { return builder_; }

 private:
  bool draws() const { return has_pen_ && is_chosen_; }
  void put(HpglSpot spot, double bulge_before = 0);
  void dashed_to(HpglSpot to);
  SourcePlace place() const { return {line_, line_ == 0 ? 0U : 1U, 1}; }

  const HpglOptions& options_;
  DrawingBuilder builder_;
  double unit_mm_;
  double tolerance_;
  DxfTransform sheet_;
  HpglSpot at_;
  DrawnPath path_;
  std::vector<double> dashes_;
  std::size_t dash_ = 0;  // which one the pen is in; even: it draws
  double dash_used_ = 0;  // so much of it
  std::uint32_t layer_ = 0;
  std::uint32_t line_ = 0;
  bool has_pen_ = true;
  bool is_chosen_ = true;
  bool has_drawn_ = false;
};

}  // namespace passo
