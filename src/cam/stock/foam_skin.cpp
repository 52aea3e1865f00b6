#include "passo/stock/foam_skin.hpp"

#include <algorithm>

namespace passo {
namespace {

// The places along one axis: one cell of `step`, with the edges of the block before and behind them. An edge belongs to
// the cell beside it.
struct LinePlaces {
  std::vector<double> at = {};
  std::vector<std::size_t> cell = {};
};

// A node of the lattice: its place, and the distance from what is melted; 0 on the edges of the block.
struct Node {
  Vector3 at;
  double clear = 0;
  std::size_t number = 0;
  std::size_t column = 0;
  std::size_t row = 0;
  std::size_t slice = 0;
};

class Lattice3 {
 public:
  Lattice3(const FoamBlock& foam, std::size_t step) : foam_(foam) {
    for (std::size_t i = std::min(step / 2, foam.columns() - 1); i < foam.columns(); i += step)
      add(x_, foam.x_of(i), i);
    for (std::size_t j = std::min(step / 2, foam.rows() - 1); j < foam.rows(); j += step) add(y_, foam.y_of(j), j);
    for (std::size_t k = 0; k < foam.slices(); ++k) add(z_, foam.z_of(k), k);
    const StockBlock& block = foam.block();
    edge(x_, block.low.x, block.low.x + static_cast<double>(foam.columns()) * foam.cell());
    edge(y_, block.low.y, block.low.y + static_cast<double>(foam.rows()) * foam.cell());
    edge(z_, block.low.z, block.high.z);
  }

  std::size_t across() const { return x_.at.size(); }
  std::size_t up() const { return y_.at.size(); }
  std::size_t deep() const { return z_.at.size(); }

  Node node(std::size_t i, std::size_t j, std::size_t k) const {
    Node node{.at = {x_.at[i], y_.at[j], z_.at[k]},
              .number = (k * up() + j) * across() + i,
              .column = x_.cell[i],
              .row = y_.cell[j],
              .slice = z_.cell[k]};
    const bool at_edge = i == 0 || j == 0 || k == 0 || i + 1 == across() || j + 1 == up() || k + 1 == deep();
    if (!at_edge) node.clear = double{foam_.clearance(node.row, node.slice)[node.column]};
    return node;
  }

 private:
  static void add(LinePlaces& places, double at, std::size_t cell) {
    places.at.push_back(at);
    places.cell.push_back(cell);
  }
  static void edge(LinePlaces& places, double low, double high) {
    places.at.insert(places.at.begin(), low);
    places.cell.insert(places.cell.begin(), places.cell.front());
    add(places, high, places.cell.back());
  }

  const FoamBlock& foam_;
  LinePlaces x_;
  LinePlaces y_;
  LinePlaces z_;
};

bool is_foam(const Node& node) {
  return node.clear > 0;
}

// Where the surface crosses between two nodes. Whichever comes first, the place is the same, bit for bit.
Vector3 crossing(const Node& one, const Node& other) {
  const Node& a = one.number < other.number ? one : other;
  const Node& b = one.number < other.number ? other : one;
  if (a.clear == 0) return a.at;
  if (b.clear == 0) return b.at;
  return a.at + (b.at - a.at) * (a.clear / (a.clear - b.clear));
}

using Use = std::function<void(const SkinTriangle&)>;

void give(const Vector3& a, const Vector3& b, const Vector3& c, const Node& inside, const Use& use) {
  if (a == b || b == c || c == a) return;
  use({.corners = {a, b, c}, .column = inside.column, .row = inside.row, .slice = inside.slice});
}

// The surface within a tetrahedron whose corners 1, 2, 3 turn counterclockwise, seen from beyond them.
void cut_tetrahedron(const std::array<const Node*, 4>& corners, const Use& use) {
  std::array<std::size_t, 4> inside = {};
  std::array<std::size_t, 4> outside = {};
  std::size_t count = 0;
  std::size_t others = 0;
  for (std::size_t i = 0; i < 4; ++i) is_foam(*corners[i]) ? inside[count++] = i : outside[others++] = i;
  if (count == 0 || count == 4) return;
  // An even order of the corners with the one, or the first of the two, in front.
  constexpr std::size_t turned[4][4] = {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 0, 1, 3}, {3, 0, 2, 1}};
  const auto node = [&](std::size_t i) -> const Node& { return *corners[i]; };
  if (count != 2) {
    const std::size_t lone = count == 1 ? inside[0] : outside[0];
    const auto& order = turned[lone];
    const Vector3 a = crossing(node(lone), node(order[1]));
    const Vector3 b = crossing(node(lone), node(order[2]));
    const Vector3 c = crossing(node(lone), node(order[3]));
    count == 1 ? give(a, b, c, node(lone), use) : give(a, c, b, node(inside[0]), use);
    return;
  }
  // Pairs of corners inside, with the pair outside in the order that makes all four even.
  const std::size_t a = inside[0];
  const std::size_t b = inside[1];
  std::size_t c = outside[0];
  std::size_t d = outside[1];
  const bool is_odd = (a + b) % 2 == 0;  // (0,2,1,3), (1,3,0,2)
  if (is_odd) std::swap(c, d);
  const Vector3 ac = crossing(node(a), node(c));
  const Vector3 ad = crossing(node(a), node(d));
  const Vector3 bd = crossing(node(b), node(d));
  const Vector3 bc = crossing(node(b), node(c));
  give(ac, ad, bd, node(a), use);
  give(ac, bd, bc, node(a), use);
}

// The six tetrahedra around the diagonal of a box. Bit 0 is X, bit 1 Y, bit 2 Z.
constexpr std::size_t tetrahedra[6][4] = {{0, 1, 3, 7}, {0, 5, 1, 7}, {0, 3, 2, 7},
                                          {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 6, 4, 7}};

}  // namespace

void foam_skin(const FoamBlock& foam, std::size_t step, const Use& use) {
  const Lattice3 lattice(foam, std::max<std::size_t>(1, step));
  const std::size_t across = lattice.across();
  // Which nodes of a layer, and of the one after it, have foam: most boxes have nothing else.
  const auto layer = [&](std::size_t k) {
    std::vector<unsigned char> has_foam;
    has_foam.reserve(across * lattice.up());
    for (std::size_t j = 0; j < lattice.up(); ++j) {
      for (std::size_t i = 0; i < across; ++i) has_foam.push_back(is_foam(lattice.node(i, j, k)) ? 1 : 0);
    }
    return has_foam;
  };
  std::vector<unsigned char> near = layer(0);
  for (std::size_t k = 0; k + 1 < lattice.deep(); ++k) {
    std::vector<unsigned char> far = layer(k + 1);
    for (std::size_t j = 0; j + 1 < lattice.up(); ++j) {
      for (std::size_t i = 0; i + 1 < across; ++i) {
        const std::size_t at = j * across + i;
        const int of_foam = near[at] + near[at + 1] + near[at + across] + near[at + across + 1] + far[at] +
                            far[at + 1] + far[at + across] + far[at + across + 1];
        if (of_foam == 0 || of_foam == 8) continue;
        std::array<Node, 8> nodes;
        for (std::size_t n = 0; n < 8; ++n) nodes[n] = lattice.node(i + (n & 1U), j + (n >> 1U & 1U), k + (n >> 2U));
        for (const auto& corners : tetrahedra) {
          cut_tetrahedron({&nodes[corners[0]], &nodes[corners[1]], &nodes[corners[2]], &nodes[corners[3]]}, use);
        }
      }
    }
    near = std::move(far);
  }
}

}  // namespace passo
