// KnotPlacer: places the knots, at which the smoothed path is tied to the programmed path.
//
//       node            exact piece             node
//   --+--+--O--+--+-----------------------+--+---O---+--+--
//     knots at the node and at multiples of its width
//
// A node is a junction, or several junctions close to each other. The path is rounded within its width w around the
// node. A corner that is rounded on its inner side within the tolerance e needs w = 4 e / |change of the tangent|. A
// change of curvature needs w = sqrt(10 e / |change|). A corner that may also swing wide to its outer side has a larger
// width and knots farther out. Swinging wide is excluded where the axis that limits the speed reverses (for slow
// bending: only in a sharp corner), and next to an arc that leaves no room. Knots that are at most 0.4 radii apart
// follow an arc well. Where the knots of two nodes would meet, the nodes share the room. If the remaining path between
// two nodes is long compared with the knot spacing, it stays as programmed: an exact piece. If it is so short that each
// node has at most two knots in it, there are more knots in between, at most a width apart. (This is never so for a
// curve that was fitted to chords; knots at most 0.08 radii apart follow it.) The knots between two exact pieces form
// one smoothed section.
//
// For slow bending, s advances more slowly than the spline's parameter around a corner (Pace). The sharper the corner,
// the slower s advances.
//
// The look-ahead is two nodes. A node contains at most `most_clustered` junctions.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "run_reader.hpp"

#include "passo/path/path_smoother.hpp"

namespace passo {

struct Knot {
  double s = 0;  // s in the run
  std::uint64_t piece = 0;
  double along = 0;          // s in the piece
  double rate = 1;           // ds/dt, where t is the spline's parameter; 1 next to exact pieces
  double weight = 1;         // weight of the bend here
  double change_weight = 1;  // weight of the change of the bend, in the span after the knot
  bool is_even = false;      // between corners that are alike, in legs that are alike
};

struct ExactPiece {
  std::uint64_t piece = 0;
  double from = 0;  // s in the piece
  double to = 0;
};

class KnotPlacer {
 public:
  static constexpr int most_clustered = 64;
  // Where the feed is at most this, it is the speed in corners too. Then the shortest path is the fastest.
  static constexpr MmPerSecond slow_feed{10};
  static bool is_slow(const Piece& piece) { return piece.segment.speed <= slow_feed; }

  KnotPlacer(RunReader& reader, Smoothness smoothness);

  // Returns the next mark of the run.
  enum class Mark { knot, end_of_stretch, exact_piece };
  // Begins a run. The previous run must have been read to its end.
  void begin();
  // False at the end of the run.
  [[nodiscard]] bool next(Mark& mark);
  const Knot& knot() const { return knot_; }
  const ExactPiece& exact_piece() const { return exact_; }

 private:
  struct Spacing {
    // Corner widths: the curve that turns by `change` within the width w and deviates from the corner by e has w = 4 e
    // / change. Wider curves, which cannot use all of their width, proved to be better.
    double corner_width = 4;
    std::span<const double> knots;  // in widths, from the node
    // Increase of ds/dt away from a corner compared with the corner itself, per w times the change of the tangent.
    double quickening = 0;
    double sharp_from = 1e-9;             // for a smaller change of the tangent the increase is smaller
    const Spacing* closer = nullptr;      // for nodes without room for the first knot
    double apart_from = 0;                // in widths: if a node on either side is nearer than this, `in_company`
                                          // places the knots
    const Spacing* in_company = nullptr;  // for the same width
    bool comes_closer = false;            // all knots move closer if the room is slightly too small for one of the
                                          // first
    // Weights of the change of the bend, span by span from the node on. Empty: 1.
    std::span<const double> change_weights = {};
  };
  // Returns the same spacing, but if a node on either side is nearer than `apart_from` widths, `in_company` places the
  // knots.
  static Spacing in_company_from(Spacing spacing, double apart_from, const Spacing& in_company) {
    spacing.apart_from = apart_from;
    spacing.in_company = &in_company;
    return spacing;
  }
  static const Spacing slow_bending;
  static const Spacing swinging_slowly;
  static const Spacing gentle_close_company;
  static const Spacing gentle_company;
  static const Spacing gentle_apart;
  static const Spacing swinging_gently;
  static const Spacing slow_company;
  static const Spacing slow_apart;
  static const Spacing swinging_twice;
  static const Spacing on_short_legs;
  static const Spacing swinging;
  static const Spacing inside;
  struct Node {
    double s = 0;
    double width = 0;  // 0: the node is not rounded
    double turn = 0;   // the change of the unit tangent; 0 where t advances with s
    std::uint64_t before = 0;
    std::uint64_t after = 0;  // the pieces around the node
    const Spacing* spacing = &inside;
    double weight_fall = 0;  // decay of the weight of the bend with the distance, per width
  };
  const Piece& piece(std::uint64_t number) const { return reader_.pieces()[number]; }
  // The junctions after the pieces `first` to `last`.
  struct Cluster {
    std::uint64_t first = 0;
    std::uint64_t last = 0;
    double turn = 0;  // maximum change from the first tangent to those in between
    double tube = 0;
  };
  struct Places {
    const Spacing* spacing = &inside;
    double width = 0;
    std::size_t count = 0;  // number of the spacing's knots that are used

    double offset(std::size_t i) const { return i == 0 ? 0 : spacing->knots[i - 1] * width; }
    // Returns the weight of the span between the knots i and i + 1. The span after the last knot has no weight of its
    // own.
    double change_weight(std::size_t i) const {
      return i < count && i < spacing->change_weights.size() ? spacing->change_weights[i] : 1;
    }
  };
  static Places places_of(const Node& node, double width, double room, double nearest, bool alone);
  bool find_node(Node& node);
  bool extend(Cluster& cluster);
  double width_of(const Cluster& cluster) const;
  double turn_of(const Cluster& cluster) const;
  static bool follows_spindle(const Piece& before, const Piece& after);
  static bool goes_on(const Piece& before, const Piece& after);
  static double nearest_to(const Node& node, const Node& before, const Node& after);
  void fill_gap();
  void add_knots_on_bend(double first, double last, double spacing);
  void add_knots_apart(double first, double last, double apart);
  bool is_even_gap() const;
  void add_knot(double s, double rate = 1, double change_weight = 1);

  const Spacing& spacing_of(const Cluster& cluster) const;
  static bool has_room_to_swing(const Piece& piece, const Point& bend, double width);
  static double reversal(const Piece& before, const Piece& after);
  double weight_fall_of(const Cluster& cluster) const;
  double weight_at(double s) const;
  static double rate_at(const Node& node, const Places& places, std::size_t knot);

  RunReader& reader_;
  const bool bends_slowly_;
  std::uint64_t junction_ = 0;  // the junction after this piece is the next candidate for a node
  bool all_found_ = false;
  std::array<Node, 4> nodes_;  // the gap is between the second and the third
  std::size_t known_ = 0;

  bool in_stretch_ = false;
  std::uint64_t knot_piece_ = 0;
  bool gap_is_even_ = false;
  struct Step {
    Mark mark;
    Knot knot;
  };
  std::vector<Step> steps_;  // the steps of one gap
  std::size_t at_ = 0;
  ExactPiece gap_exact_;
  Knot knot_;
  ExactPiece exact_;
};

}  // namespace passo
