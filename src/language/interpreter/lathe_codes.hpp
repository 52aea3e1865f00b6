// LatheCodes: the words of the lathe cycles G70, G71, G72 (.1 .2), and their contours.
//
// A cycle's block moves to its X and Z. The lines of its subroutine are then read as a contour and not executed (by
// interpreter.cpp). At the end of the subroutine, the cuts are planned. LatheCycle generates the moves.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "cutter_codes.hpp"
#include "cycle_codes.hpp"
#include "lathe_cycle.hpp"

#include "passo/gcode/symbols.hpp"

namespace passo {

class LatheCodes final : public CycleCodes {
 public:
  LatheCodes(BlockContext& block, CutterCodes& cutter_codes, SymbolTable& symbols)
      : CycleCodes(block), cutter_codes_(cutter_codes), symbols_(symbols) {}

  bool start(CodeNumber code);

  // Returns whether the cycle waits for the blocks of contour_sub(), one by one.
  bool wants_contour() const { return contour_ != nullptr && contour_->open; }
  Symbol contour_sub() const { return contour_->sub; }
  Span contour_span() const { return contour_->span; }
  // Adds a line of the contour. Its words are those of the context. readable: the words could be read.
  void add_to_contour(bool readable);
  // Plans the cuts at the end of the subroutine. Returns false if nothing is cut.
  bool end_contour();
  void abandon_contour() { contour_->open = false; }
  // Returns the line with the cycle whose contour was read last.
  std::string_view text() const { return contour_->text; }

  Cycle& cycle() override { return *cycle_; }
  bool finish() override;

 private:
  static constexpr std::size_t most_segments = 10'000;
  // The data of a cycle while its contour is read.
  struct Contour {
    bool open = true;
    bool good = true;  // whether all lines so far were valid
    std::uint64_t errors_before = 0;
    CodeNumber code = 0;
    BlockWords words;  // words of the cycle's block
    Span span;         // position of the cycle's Q, used for errors of the contour as a whole
    std::string text;  // line of the cycle's block
    Block block;
    OperationSource source;
    Symbol sub;
    Point start;        // tool position before the first cut
    LathePoint corner;  // last point of the contour so far
    LatheContour shape;
  };

  bool check(CodeNumber code);
  LathePoint lathe_point(const Point& point) const;
  double word(char letter, double otherwise) const { return words_.has(letter) ? words_[letter] : otherwise; }
  bool add_segment();
  void warn_of_unused_words();
  bool contour_point(LathePoint& end);
  bool contour_arc(LatheSegment& segment);
  bool add_corner(const LatheSegment& behind);
  void lead_out();
  LatheFault plan_roughing();
  LatheFault plan_finishing();
  void begin(std::variant<LatheRoughing, LatheFinishing> cuts);
  bool report_contour(LatheFault fault);
  bool fail_contour(FindingWords message, FindingWords expected);

  CutterCodes& cutter_codes_;
  SymbolTable& symbols_;
  std::unique_ptr<Contour> contour_;  // created when the first cycle starts
  std::optional<LatheCycle> cycle_;
};

}  // namespace passo
