// GerberOldCodes: handles deprecated codes that translate, scale, mirror or rotate the whole image. Private to cam/.
#pragma once

#include <string_view>

#include "gerber_findings.hpp"
#include "gerber_numbers.hpp"
#include "gerber_shapes.hpp"

namespace passo {

class GerberOldCodes {
 public:
  GerberOldCodes(GerberFindings& findings, const GerberNumbers& numbers) : findings_(findings), numbers_(numbers) {}

  // Returns false if the current command is none of these.
  bool read();

  // Maps a coordinate of the file to the image: swaps the axes (AS), then mirrors (MI), scales (SF) and offsets (OF).
  DrawnPoint placed(Nanometres x, Nanometres y) const;
  int quarter_turns() const { return quarter_turns_; }  // IR: rotation of the whole image, counterclockwise
  bool is_negative() const { return is_negative_; }     // IP: the image is negative

 private:
  bool read_axes(double& a, double& b);
  void read_turn();

  GerberFindings& findings_;
  const GerberNumbers& numbers_;
  bool exchanges_axes_ = false;
  double mirror_x_ = 1;
  double mirror_y_ = 1;
  double scale_x_ = 1;
  double scale_y_ = 1;
  DrawnPoint offset_;
  int quarter_turns_ = 0;
  bool is_negative_ = false;
};

}  // namespace passo
