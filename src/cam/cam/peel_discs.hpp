// PeelDiscs: a spatial index of the discs of a cleared region. Private to cam/.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

namespace passo {

struct PeelDisc {
  double x = 0;  // nm
  double y = 0;
  double radius = 0;
};

class PeelDiscs {
 public:
  std::size_t size() const { return all_.size(); }

  void add(const PeelDisc& disc) {
    const int power = std::ilogb(disc.radius + 1) + 1;
    Class& sizes = classes_[power];
    sizes.side = std::ldexp(1.0, power);
    sizes.cells[key(cell(disc.x, sizes.side), cell(disc.y, sizes.side))].push_back(all_.size());
    all_.push_back(disc);
  }

  // Calls visit(disc) for all discs within `reach` of the point, and possibly for some others.
  template <class Visit>
  void for_near(double x, double y, double reach, const Visit& visit) const {
    for (const auto& entry_of_class : classes_) {
      const Class& sizes = entry_of_class.second;
      const double far = reach + sizes.side;
      const std::int64_t left = cell(x - far, sizes.side);
      const std::int64_t right = cell(x + far, sizes.side);
      const std::int64_t low = cell(y - far, sizes.side);
      const std::int64_t high = cell(y + far, sizes.side);
      if (static_cast<double>(right - left + 1) * static_cast<double>(high - low + 1) >
          static_cast<double>(sizes.cells.size())) {
        for (const auto& entry : sizes.cells) visit_all(entry.second, visit);
        continue;
      }
      for (std::int64_t row = low; row <= high; ++row) {
        for (std::int64_t column = left; column <= right; ++column) {
          const auto found = sizes.cells.find(key(column, row));
          if (found != sizes.cells.end()) visit_all(found->second, visit);
        }
      }
    }
  }

  bool contain(double x, double y) const {
    bool is_in = false;
    for_near(x, y, 0,
             [&](const PeelDisc& disc) { is_in = is_in || std::hypot(disc.x - x, disc.y - y) <= disc.radius + 1; });
    return is_in;
  }

 private:
  // Discs with a radius of at most one cell.
  struct Class {
    double side = 0;
    std::map<std::int64_t, std::vector<std::size_t>> cells = {};
  };
  static std::int64_t cell(double place, double side) { return static_cast<std::int64_t>(std::floor(place / side)); }
  static std::int64_t key(std::int64_t column, std::int64_t row) { return column * 0x1'0000'0000 + row; }
  template <class Visit>
  void visit_all(const std::vector<std::size_t>& indices, const Visit& visit) const {
    for (const std::size_t i : indices) visit(all_[i]);
  }

  std::vector<PeelDisc> all_;
  std::map<int, Class> classes_;
};

}  // namespace passo
