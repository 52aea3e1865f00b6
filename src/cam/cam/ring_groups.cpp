#include "ring_groups.hpp"

#include <algorithm>
#include <numeric>

namespace passo {

IndexGroups::IndexGroups(std::size_t count) : up_(count) {
  std::iota(up_.begin(), up_.end(), std::size_t{0});
}

std::size_t IndexGroups::of(std::size_t index) {
  while (up_[index] != index) index = up_[index] = up_[up_[index]];
  return index;
}

void IndexGroups::join(std::size_t a, std::size_t b) {
  a = of(a);
  b = of(b);
  up_[std::max(a, b)] = std::min(a, b);
}

namespace {

// Joins boxes that are within reach. False: given up, as too many lie side by side.
bool join_near(const std::vector<DrawnBox>& boxes, Nanometres reach, IndexGroups& groups) {
  constexpr std::size_t most_looks = 200;  // for each box
  std::vector<std::size_t> by_left(boxes.size());
  std::iota(by_left.begin(), by_left.end(), std::size_t{0});
  std::ranges::stable_sort(by_left, {}, [&](std::size_t i) { return boxes[i].least.x; });
  std::vector<std::size_t> beside;  // boxes that may reach as far right as the next
  std::size_t looks = 0;
  for (const std::size_t i : by_left) {
    const DrawnBox& box = boxes[i];
    std::erase_if(beside, [&](std::size_t k) { return boxes[k].most.x.count + reach.count < box.least.x.count; });
    looks += beside.size();
    if (looks > most_looks * boxes.size()) return false;
    for (const std::size_t k : beside) {
      const bool apart = boxes[k].most.y.count + reach.count < box.least.y.count ||
                         box.most.y.count + reach.count < boxes[k].least.y.count;
      if (!apart) groups.join(i, k);
    }
    beside.push_back(i);
  }
  return true;
}

// The groups as lists of indices, in the order of their first.
std::vector<std::vector<std::size_t>> listed(IndexGroups& groups, std::size_t count, bool are_told) {
  std::vector<std::vector<std::size_t>> found;
  std::vector<std::size_t> place(count);  // in `found`, of each group's first
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t first = are_told ? groups.of(i) : 0;
    if (first == i) {
      place[i] = found.size();
      found.emplace_back();
    }
    found[place[first]].push_back(i);
  }
  return found;
}

}  // namespace

std::vector<std::vector<std::size_t>> groups_apart(const std::vector<DrawnBox>& boxes, Nanometres reach) {
  IndexGroups groups(boxes.size());
  const bool are_told = join_near(boxes, reach, groups);
  return listed(groups, boxes.size(), are_told);
}

Region gathered(const std::vector<Region>& apart) {
  Region all;
  for (const Region& one : apart) all.rings.insert(all.rings.end(), one.rings.begin(), one.rings.end());
  return all;
}

}  // namespace passo
