#include "passo/laser/burned_picture.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>
#include <utility>
#include <vector>

#include "passo/carve/level_picture.hpp"

namespace passo {
namespace {

struct FlatPlace {
  double x = 0;
  double y = 0;
};

struct BurnedLine {
  FlatPlace from;
  FlatPlace to;
  double energy = 0;  // S times minutes
};

// Reads the words of LaserProgram: one position in a line, absolute; arcs with I and J.
class BeamFollower {
 public:
  using Sink = std::function<void(const BurnedLine&)>;

  BeamFollower(ProgramUnits units, Sink sink)
      : unit_(units == ProgramUnits::mm   ? 1.0
              : units == ProgramUnits::cm ? 10.0
                                          : 25.4),
        sink_(std::move(sink)) {}

  void follow(std::string_view program) {
    while (!program.empty()) {
      const std::size_t end = std::min(program.find('\n'), program.size());
      read(program.substr(0, end));
      program.remove_prefix(std::min(end + 1, program.size()));
    }
  }

 private:
  void read(std::string_view line);
  void take(char letter, double value);
  void move();

  double unit_;
  Sink sink_;
  FlatPlace at_;
  FlatPlace to_;
  FlatPlace centre_;
  int motion_ = 0;
  bool is_on_ = false;
  double s_ = 0;
  double feed_ = 0;
};

void BeamFollower::read(std::string_view line) {
  if (line.starts_with('(')) return;
  to_ = at_;
  centre_ = {};
  while (!line.empty()) {
    const char letter = line.front();
    line.remove_prefix(1);
    if (letter < 'A' || letter > 'Z') continue;
    double value = 0;
    const auto read = std::from_chars(line.data(), line.data() + line.size(), value);
    line.remove_prefix(static_cast<std::size_t>(read.ptr - line.data()));
    take(letter, value);
  }
  if (to_.x != at_.x || to_.y != at_.y || centre_.x != 0 || centre_.y != 0) move();
}

void BeamFollower::take(char letter, double value) {
  switch (letter) {
    case 'G':
      if (value <= 3) motion_ = static_cast<int>(value);
      break;
    case 'M':
      if (value >= 3 && value <= 5) is_on_ = value != 5;
      break;
    case 'X': to_.x = value * unit_; break;
    case 'Y': to_.y = value * unit_; break;
    case 'I': centre_.x = value * unit_; break;
    case 'J': centre_.y = value * unit_; break;
    case 'S': s_ = value; break;
    case 'F': feed_ = value * unit_; break;
    default: break;
  }
}

void BeamFollower::move() {
  const double s = is_on_ ? s_ : 0;
  // A rapid with the beam on would burn, too.
  const double per_mm = feed_ > 0 ? s / feed_ : s;
  if (motion_ < 2) {
    if (s > 0) sink_({at_, to_, per_mm * std::hypot(to_.x - at_.x, to_.y - at_.y)});
    at_ = to_;
    return;
  }
  const FlatPlace centre{at_.x + centre_.x, at_.y + centre_.y};
  const double radius = std::hypot(centre_.x, centre_.y);
  const double start = std::atan2(-centre_.y, -centre_.x);
  double sweep = std::atan2(to_.y - centre.y, to_.x - centre.x) - start;
  constexpr double turn = 2 * std::numbers::pi;
  if (motion_ == 3 && sweep <= 0) sweep += turn;
  if (motion_ == 2 && sweep >= 0) sweep -= turn;
  constexpr double chord = 0.1;  // mm
  const int parts = std::clamp(static_cast<int>(std::abs(sweep) * radius / chord) + 1, 8, 10'000);
  FlatPlace from = at_;
  for (int k = 1; k <= parts && s > 0; ++k) {
    const double angle = start + sweep * k / parts;
    const FlatPlace next{centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)};
    sink_({from, next, per_mm * std::abs(sweep) * radius / parts});
    from = next;
  }
  at_ = to_;
}

// The corners of what is burned.
struct BurnedArea {
  FlatPlace least;
  FlatPlace most;
  bool is_empty = true;

  void add(const BurnedLine& line) {
    for (const FlatPlace& place : {line.from, line.to}) {
      if (is_empty) least = most = place;
      is_empty = false;
      least = {std::min(least.x, place.x), std::min(least.y, place.y)};
      most = {std::max(most.x, place.x), std::max(most.y, place.y)};
    }
  }
};

// The energy on each pixel.
class EnergyMap {
 public:
  EnergyMap(const BurnedArea& area, const BurnedView& view) {
    const double side = std::max({area.most.x - area.least.x, area.most.y - area.least.y, 1.0});
    const double margin = side / 30;
    constexpr double finest = 20;  // pixels per mm
    scale_ = std::min(finest, static_cast<double>(view.most_side) / (side + 2 * margin));
    least_ = {area.least.x - margin, area.least.y - margin};
    columns_ = static_cast<std::size_t>((area.most.x + margin - least_.x) * scale_) + 1;
    rows_ = static_cast<std::size_t>((area.most.y + margin - least_.y) * scale_) + 1;
    radius_ = std::max(0.75, view.spot.value() / 2 * scale_);
    energies_.resize(columns_ * rows_);
  }

  void add(const BurnedLine& line);
  std::string picture() const;

 private:
  void add_spot(double x, double y, double energy);

  FlatPlace least_;
  double scale_ = 1;
  double radius_ = 1;  // of the spot, in pixels
  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  std::vector<float> energies_;
};

void EnergyMap::add(const BurnedLine& line) {
  const double length = std::hypot(line.to.x - line.from.x, line.to.y - line.from.y) * scale_;
  constexpr double apart = 0.5;  // pixels
  const auto spots = static_cast<std::size_t>(length / apart) + 1;
  for (std::size_t k = 0; k < spots; ++k) {
    const double share = (static_cast<double>(k) + 0.5) / static_cast<double>(spots);
    const double x = (line.from.x + (line.to.x - line.from.x) * share - least_.x) * scale_;
    const double y = (line.from.y + (line.to.y - line.from.y) * share - least_.y) * scale_;
    add_spot(x, y, line.energy / static_cast<double>(spots));
  }
}

// A disc with a soft edge of one pixel. Its pixels share the energy.
void EnergyMap::add_spot(double x, double y, double energy) {
  const auto first_x = static_cast<std::ptrdiff_t>(std::floor(x - radius_ - 0.5));
  const auto first_y = static_cast<std::ptrdiff_t>(std::floor(y - radius_ - 0.5));
  const auto wide = static_cast<std::ptrdiff_t>(std::ceil(2 * radius_)) + 2;
  const auto each = [&](const auto& use) {
    for (std::ptrdiff_t j = std::max<std::ptrdiff_t>(0, first_y); j < first_y + wide; ++j) {
      for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(0, first_x); i < first_x + wide; ++i) {
        const double off = std::hypot(static_cast<double>(i) + 0.5 - x, static_cast<double>(j) + 0.5 - y);
        const double share = std::clamp(radius_ + 0.5 - off, 0.0, 1.0);
        const bool is_inside = i < static_cast<std::ptrdiff_t>(columns_) && j < static_cast<std::ptrdiff_t>(rows_);
        if (share > 0 && is_inside)
          use(energies_[static_cast<std::size_t>(j) * columns_ + static_cast<std::size_t>(i)], share);
      }
    }
  };
  double sum = 0;
  each([&](const float&, double share) { sum += share; });
  if (sum > 0) each([&](float& pixel, double share) { pixel += static_cast<float>(energy * share / sum); });
}

std::string EnergyMap::picture() const {
  std::vector<float> burned;
  std::ranges::copy_if(energies_, std::back_inserter(burned), [](float energy) { return energy > 0; });
  if (burned.empty()) return {};
  constexpr double black_share = 0.98;
  const auto black = burned.begin() + static_cast<std::ptrdiff_t>(static_cast<double>(burned.size() - 1) * black_share);
  std::nth_element(burned.begin(), black, burned.end());
  const double most = *black;
  // Light wood, brown, char.
  constexpr std::array<std::array<double, 3>, 3> colours{{{238, 217, 180}, {134, 84, 40}, {26, 18, 14}}};
  std::vector<std::uint8_t> pixels;
  pixels.reserve(columns_ * rows_ * 3);
  for (std::size_t row = rows_; row-- > 0;) {
    for (std::size_t column = 0; column < columns_; ++column) {
      const double dark = 2 * std::min(1.0, energies_[row * columns_ + column] / most);
      const std::size_t from = dark < 1 ? 0 : 1;
      for (std::size_t i = 0; i < 3; ++i) {
        const double colour =
            colours[from][i] + (colours[from + 1][i] - colours[from][i]) * (dark - static_cast<double>(from));
        pixels.push_back(static_cast<std::uint8_t>(std::lround(colour)));
      }
    }
  }
  return write_colour_picture(columns_, rows_, pixels);
}

}  // namespace

std::string draw_burned(std::string_view program, const BurnedView& view) {
  // Twice through the program needs less memory than its lines.
  BurnedArea area;
  BeamFollower(view.units, [&](const BurnedLine& line) { area.add(line); }).follow(program);
  if (area.is_empty) return {};
  EnergyMap map(area, view);
  BeamFollower(view.units, [&](const BurnedLine& line) { map.add(line); }).follow(program);
  return map.picture();
}

}  // namespace passo
