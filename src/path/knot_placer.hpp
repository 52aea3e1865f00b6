// KnotPlacer: places the knots, where the smoothed path is tied to the path.
//
//       node            exact piece             node
//   --+--+--O--+--+-----------------------+--+---O---+--+--
//     knots at the node and at half its width, its width and one and a half (for slow bending farther, and one more)
//
// A node is a junction, or several junctions close to each other. Its width w says how far around the node the path is
// rounded. A corner within the tolerance e needs w = 4 e / |change of the tangent|. A change of curvature needs w =
// sqrt(10 e / |change|). Knots that are at most 0.4 radii apart follow an arc well. Where the knots of two nodes would
// meet, the nodes share the room. If the rest between two nodes is long compared with the knots' distance, it stays as
// programmed: an exact piece. (A curve that was fitted to chords never does; knots at most 0.08 radii apart follow it.)
// The knots between two exact pieces make one smoothed stretch.
//
// For slow bending, s advances more slowly than the spline's parameter around a corner (Pace). The sharper the corner,
// the slower s advances.
//
// Looks two nodes ahead. A node takes in at most `most_clustered` junctions.
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
  double along = 0;  // s in the piece
  double rate = 1;   // ds/dt, t being the spline's parameter; 1 beside exact pieces
};

struct ExactPiece {
  std::uint64_t piece = 0;
  double from = 0;  // s in the piece
  double to = 0;
};

class KnotPlacer {
 public:
  static constexpr int most_clustered = 64;

  KnotPlacer(RunReader& reader, Smoothness smoothness);

  // Gives the next mark of the run.
  enum class Mark { knot, end_of_stretch, exact_piece };
  // Begins a run. The run before has been read to its end.
  void begin();
  // False at the end of the run.
  [[nodiscard]] bool next(Mark& mark);
  const Knot& knot() const { return knot_; }
  const ExactPiece& exact_piece() const { return exact_; }

 private:
  struct Node {
    double s = 0;
    double width = 0;  // 0: the node is not rounded
    double turn = 0;   // the change of the unit tangent; 0 where t advances with s
    std::uint64_t before = 0;
    std::uint64_t after = 0;  // the pieces around the node
  };
  const Piece& piece(std::uint64_t number) const { return reader_.pieces()[number]; }
  // The junctions after the pieces `first` to `last`.
  struct Cluster {
    std::uint64_t first = 0;
    std::uint64_t last = 0;
    double turn = 0;  // how far the tangents between are from the first at most
    double tube = 0;
  };
  bool find_node(Node& node);
  bool extend(Cluster& cluster);
  double width_of(const Cluster& cluster) const;
  double turn_of(const Cluster& cluster) const;
  static bool goes_on(const Piece& before, const Piece& after);
  static double room_of(const Node& node, const Node& before, const Node& after);
  void fill_gap();
  void add_knots_on_bend(double first, double last, double spacing);
  void add_knot(double s, double rate = 1);

  struct Spacing;
  static const Spacing& spacing_for(Smoothness smoothness);
  double rate_at(const Node& node, std::size_t knot, std::size_t knots) const;

  RunReader& reader_;
  const Spacing& spacing_;
  std::uint64_t junction_ = 0;  // the junction after this piece is the next to belong to a node
  bool all_found_ = false;
  std::array<Node, 4> nodes_;  // the gap is between the second and the third
  std::size_t known_ = 0;

  bool in_stretch_ = false;
  std::uint64_t knot_piece_ = 0;
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
