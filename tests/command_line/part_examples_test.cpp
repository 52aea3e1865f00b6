// The parts of examples/jobs: what each job leaves of its stock beside the solid that its drawing means.
#include <cmath>
#include <cstdint>
#include <cstring>

#include "kit/command_line.hpp"
#include "kit/drawn_letters.hpp"
#include "kit/drawn_picture.hpp"
#include "kit/drawn_solid.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace {

using passo::test::checkout;
using passo::test::DrawnCut;
using passo::test::DrawnSolid;
using passo::test::FlatPoint;
using passo::test::on_router;
using passo::test::Outcome;
using passo::test::read;
using passo::test::read_dxf_shapes;
using passo::test::read_shapes;
using enum DrawnCut::Kind;

// The chords of an arc may be a tenth of a cell away from it.
double tolerance_of(double cell) {
  return cell / 10 + 0.005;
}

struct ExamplePart {
  const char* name;
  double width;
  double length;
  double thickness;
  const char* tools;  // for passo simulate
  std::vector<DrawnCut> cuts;
  FlatPoint corner = {};                            // of the stock
  std::optional<FlatPoint> zero = FlatPoint{0, 0};  // in the drawing; empty: its lower left corner
  const char* ending = ".svg";
};

std::ostream& operator<<(std::ostream& out, const ExamplePart& part) {
  return out << part.name;
}

constexpr double through = -100;

// The relief of the coaster: the centres of the outermost pixels are 80 mm apart. Scallops are 0.05 mm high.
constexpr FlatPoint ripples_low{10, 10};
constexpr FlatPoint ripples_high{90, 90};

// Calculated by the test that needs it: every test of this program lists the parts.
const passo::test::DrawnRelief& relief_of_ripples() {
  static const passo::test::DrawnPicture picture(checkout + "/examples/jobs/coaster.png", ripples_low, ripples_high,
                                                 -2);
  static const passo::test::DrawnRelief relief(picture, ripples_low, ripples_high, 2, 0.06);
  return relief;
}

DrawnCut ripples() {
  return {.kind = passo::test::DrawnCut::Kind::relief,
          .cutter = 4,
          .low = ripples_low,
          .high = ripples_high,
          .surface = [](FlatPoint at) { return relief_of_ripples().surface(at); },
          .left = [](FlatPoint at) { return relief_of_ripples().left(at); }};
}

const std::vector<ExamplePart>& parts() {
  static const std::vector<ExamplePart> all = {
      {"plate",
       120,
       80,
       8,
       "--tool 1=flat:6 --tool 2=flat:5",
       {{around, "outline", -6.5, 6},
        {pocket, "pockets", -3, 6},
        {pocket, "center", through, 6},
        {pocket, "holes", through, 5}}},
      {"spacer",
       60,
       60,
       6,
       "--tool 1=flat:4 --tool 2=vee:118:4.2",
       {{around, "outline", -4.5, 4}, {pocket, "bore", through, 4}, {pocket, "holes", through, 4.2}}},
      {"bearing-holder",
       90,
       90,
       10,
       "--tool 1=flat:6 --tool 2=vee:118:5.5 --tool 3=vee:90:6:0.2",
       {{around, "outline", -8, 6},
        {pocket, "seat", -7, 6},
        {pocket, "through", through, 6},
        {pocket, "holes", through, 5.5},
        {outer_chamfer, "outline", 0.5, 6}}},
      {"keychain",
       80,
       50,
       3,
       "--tool 1=flat:2",
       {{around, "outline", -2.2, 2}, {pocket, "star", -1, 2}, {pocket, "ring", through, 2}}},
      {"box-lid",
       140,
       100,
       6,
       "--tool 1=flat:6",
       {{around, "outline", -4.5, 6}, {pocket, "rabbet", -3, 6}, {pocket, "notch", -2, 6}}},
      {"name-plate",
       130,
       64,
       8,
       "--tool 1=flat:6 --tool 2=flat:3",
       {{around, "outline", -6, 6}, {pocket, "field", -1.5, 3}}},
      {"drill-jig",
       110,
       72,
       8,
       "--tool 1=flat:6 --tool 2=vee:118:3 --tool 3=vee:118:5",
       {{around, "outline", -6, 6},
        {pocket, "edge", -2, 6},
        {pocket, "h3", through, 3},
        {pocket, "h5", through, 5},
        {pocket, "h8", through, 6}}},
      {"panel",
       150,
       90,
       3,
       "--tool 1=flat:3 --tool 2=vee:118:3.2",
       {{around, "outline", -2.2, 3},
        {pocket, "recess", -1, 3},
        {within, "window", -2.2, 3},
        {pocket, "connector", through, 3},
        {pocket, "switches", through, 3},
        {pocket, "lamps", through, 3},
        {pocket, "screws", through, 3.2}}},
      // In the stock, the thread mill is as wide as its neck.
      {"threaded-bracket",
       110,
       80,
       10,
       "--tool 1=flat:6 --tool 2=vee:118:5 --tool 3=vee:90:8 --tool 4=flat:2.6",
       {{around, "outline", -8, 6},
        {pocket, "recess", -2, 6},
        {pocket, "m20", through, 6},
        {pocket, "m6", through, 5},
        {inner_chamfer, "m6", 0.7, 8}}},
      {"cam-disc", 100, 100, 8, "--tool 1=flat:3", {{around, "outline", -6, 3}, {pocket, "bore", through, 3}}},
      {"knob",
       60,
       60,
       10,
       "--tool 1=flat:3",
       {{around, "outline", -7.5, 3}, {pocket, "recess", -3, 3}, {pocket, "shaft", through, 3}}},
      {"chess-board",
       180,
       180,
       8,
       "--tool 1=flat:6 --tool 2=flat:2",
       {{around, "outline", -6, 6}, {pocket, "fields", -1, 2}}},
      {"hinge-plate",
       90,
       66,
       2,
       "--tool 1=flat:3 --tool 2=vee:118:4 --tool 3=vee:90:10:0.2",
       {{around, "outline", -1.3, 3},
        {pocket, "holes", through, 4},
        {pocket, "slot", through, 3},
        {inner_chamfer, "holes", 1.4, 10}}},
      {"dial-front",
       120,
       120,
       8,
       "--tool 1=flat:3 --tool 2=vee:118:6",
       {{pocket, "dowels", through, 6},
        {pocket, "hours", -1.5, 3},
        {pocket, "ring", -1, 3},
        {pocket, "shaft", through, 3}}},
      {"dial-back",
       120,
       120,
       8,
       "--tool 1=flat:6",
       {{around, "outline", -6, 6}, {pocket, "movement", -5, 6}, {pocket, "hanger", -3, 6}, {pocket, "wire", -3, 6}}},
      {"sign",
       186,
       66,
       12,
       "--tool 1=vee:60:12 --tool 2=flat:4",
       {{around, "outline", -11.7, 4},
        {.kind = v_groove, .layer = "border", .z = -1},
        {pocket, "screws", through, 4},
        {.kind = v_carved, .layer = "letters"}},
       {-3, -3}},
      {"finger-box",
       300,
       170,
       6,
       "--tool 1=flat:3",
       {{around_with_bones, "sides", -5.3, 3}, {within, "finger holes", -5.7, 3}, {pocket, "grooves", -3, 3}}},
      {"bracket",
       110,
       100,
       10,
       "--tool 1=flat:8 --tool 2=flat:4 --tool 3=vee:90:8",
       {{.kind = face, .z = -0.3},
        {around, "OUTLINE", -8.3, 8},
        {pocket, "RECESS", -4, 8},
        {pocket, "BORES", through, 8},
        {pocket, "HOLES", through, 4},
        {outer_chamfer, "OUTLINE", 0.8, 8},
        {inner_chamfer, "BORES", 0.8, 8}},
       {-10, -10},
       FlatPoint{},
       ".dxf"},
      {"clock",
       180,
       180,
       8,
       "--tool 1=vee:60:6:0.2 --tool 2=flat:3",
       {{around, "outline", -7.7, 3},
        {.kind = v_groove, .layer = "ticks", .z = -0.8, .tip = 0.2},
        {.kind = v_groove, .layer = "ring", .z = -0.6, .tip = 0.2},
        {pocket, "shaft", through, 3}},
       {-90, -90},
       FlatPoint{90, 90}},
      {"coaster",
       100,
       100,
       8,
       "--tool 1=flat:4 --tool 2=ball:4",
       {{around, "", -7.7, 4}, ripples()},
       {-50, -50},
       FlatPoint{50, 50}},
      {"guitar",
       230,
       150,
       20,
       "--tool 1=flat:8 --tool 2=flat:5",
       {{around, "body", -17.3, 8},
        {pocket, "neck pocket", -12, 5},
        {pocket, "pickups", -14, 5},
        {pocket, "controls", -16, 8},
        {pocket, "bridge", -15, 5}},
       {-12, -12},
       std::nullopt},
      {"shelf-bracket",
       450,
       300,
       9,
       "--tool 1=flat:5",
       {{around, "outline", -8.7, 5}, {pocket, "slot", -4, 5}, {pocket, "screws", through, 5}}},
      {"gear",
       90,
       90,
       6,
       "--tool 1=flat:4 --tool 2=flat:2",
       {{around, "teeth", -5.7, 2}, {pocket, "bore", through, 4}, {pocket, "web", through, 4}},
       {-45, -45},
       FlatPoint{50, 50}}};
  return all;
}

// The heights of a stock at the centres of its cells, from the solid that passo simulate writes.
class LeftStock {
 public:
  LeftStock(const std::string& stl, const ExamplePart& part, double cell)
      : cell_(cell),
        across_(count(part.width)),
        up_(count(part.length)),
        thickness_(part.thickness),
        corner_(part.corner) {
    heights_.assign(across_ * up_, -1e9F);
    constexpr std::size_t head = 84;
    constexpr std::size_t triangle = 50;
    for (std::size_t at = head; at + triangle <= stl.size(); at += triangle) {
      for (std::size_t corner = 1; corner <= 3; ++corner) {
        float xyz[3];
        std::memcpy(xyz, stl.data() + at + 12 * corner, sizeof xyz);
        take(xyz);
      }
    }
  }

  std::size_t across() const { return across_; }
  std::size_t up() const { return up_; }
  FlatPoint place(std::size_t i, std::size_t j) const {
    return {corner_.x + (static_cast<double>(i) + 0.5) * cell_, corner_.y + (static_cast<double>(j) + 0.5) * cell_};
  }
  // Below the stock where it is cut through.
  double height(std::size_t i, std::size_t j) const { return static_cast<double>(heights_[j * across_ + i]); }

  // The number of cells that do not hang together with the corner of the stock.
  std::size_t loose_cells() const {
    std::vector<bool> seen(heights_.size());
    std::vector<std::size_t> open = {0};
    seen[0] = true;
    while (!open.empty()) {
      const std::size_t at = open.back();
      open.pop_back();
      const auto visit = [&](bool is_there, std::size_t next) {
        if (!is_there || seen[next] || !is_solid(next)) return;
        seen[next] = true;
        open.push_back(next);
      };
      visit(at % across_ > 0, at - 1);
      visit(at % across_ + 1 < across_, at + 1);
      visit(at >= across_, at - across_);
      visit(at + across_ < heights_.size(), at + across_);
    }
    std::size_t loose = 0;
    for (std::size_t i = 0; i < heights_.size(); ++i) loose += is_solid(i) && !seen[i] ? 1 : 0;
    return loose;
  }

 private:
  std::size_t count(double length) const { return static_cast<std::size_t>(std::ceil(length / cell_ - 1e-9)); }
  bool is_solid(std::size_t cell) const { return static_cast<double>(heights_[cell]) > -thickness_ + 0.01; }
  void take(const float* xyz) {
    const double i = (static_cast<double>(xyz[0]) - corner_.x) / cell_ - 0.5;
    const double j = (static_cast<double>(xyz[1]) - corner_.y) / cell_ - 0.5;
    const double column = std::round(i);
    const double row = std::round(j);
    // The rim of the solid is not at the centre of a cell.
    if (std::abs(i - column) > 0.1 || std::abs(j - row) > 0.1 || column < 0 || row < 0) return;
    if (column >= static_cast<double>(across_) || row >= static_cast<double>(up_)) return;
    float& height = heights_[static_cast<std::size_t>(row) * across_ + static_cast<std::size_t>(column)];
    height = std::max(height, xyz[2]);
  }

  double cell_;
  std::size_t across_;
  std::size_t up_;
  double thickness_;
  FlatPoint corner_;
  std::vector<float> heights_;
};

// Where a copy of the part lies on its sheet: turned about the drawing's zero, then moved.
struct PlacedCopy {
  double degrees = 0;
  FlatPoint by = {};

  FlatPoint in_drawing(FlatPoint at) const {
    const double angle = -degrees * std::numbers::pi / 180;
    const double x = at.x - by.x;
    const double y = at.y - by.y;
    return {x * std::cos(angle) - y * std::sin(angle), x * std::sin(angle) + y * std::cos(angle)};
  }
};

std::vector<PlacedCopy> copies_of(const nlohmann::json& record) {
  std::vector<PlacedCopy> copies;
  if (!record.contains("nest")) return {{}};
  for (const nlohmann::json& copy : record["nest"]["sheets"][0]["copies"]) {
    copies.push_back({copy["degrees"], {copy["x_mm"], copy["y_mm"]}});
  }
  return copies;
}

// Between copies, the stock is free.
DrawnSolid::Heights heights_of(const DrawnSolid& solid, const std::vector<PlacedCopy>& copies, FlatPoint at) {
  if (copies.size() == 1) return solid.at(copies.front().in_drawing(at));
  DrawnSolid::Heights all{.least = -1e9};
  for (const PlacedCopy& copy : copies) {
    const FlatPoint here = copy.in_drawing(at);
    const DrawnSolid::Heights one = solid.at(here);
    if (solid.is_part(here)) all.least = one.least;
    all.most = std::min(all.most, one.most);
    all.wall = std::min(all.wall, one.wall);
    all.may_be_left = all.may_be_left || one.may_be_left;
  }
  return all;
}

// The letters of the sign, which its drawing lacks.
void add_letters(std::map<std::string, passo::test::DrawnShapes>& layers) {
  constexpr const char* usual_font = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
  layers["letters"] = passo::test::letters_of("PASSO", usual_font, 22, {90, 19});
}

class PartExamples : public passo::test::CommandLine, public testing::WithParamInterface<ExamplePart> {};

TEST_P(PartExamples, the_job_leaves_the_solid_of_the_drawing) {
  const ExamplePart& part = GetParam();
  const std::string name = part.name;
  const std::string folder = checkout + "/examples/jobs/";
  // One program, whatever the job says.
  std::string job = read(folder + name + ".toml");
  if (const std::string each = "programs = \"each-tool\"\n"; job.find(each) != std::string::npos) {
    job.erase(job.find(each), each.size());
  }
  std::filesystem::copy(folder, path("jobs"));
  const Outcome made = passo("cam job " + write("jobs/" + name + ".toml", job) + " --json -o " + path("p.ngc"));
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(made.err, "");
  const Outcome ran = passo("run " + path("p.ngc") + on_router);
  EXPECT_EQ(ran.code, 0) << ran.out << ran.err;

  const double cell = part.width > 125 ? 0.5 : 0.3;
  const double tolerance = tolerance_of(cell);
  const Outcome cut = passo(fmt::format("simulate {} --cell {} --stock X{}:{},Y{}:{},Z{}:0 {} --stl {} --stl-step 1",
                                        path("p.ngc"), cell, part.corner.x, part.corner.x + part.width, part.corner.y,
                                        part.corner.y + part.length, -part.thickness, part.tools, path("left.stl")));
  ASSERT_EQ(cut.code, 0) << cut.out << cut.err;
  const LeftStock left(read(path("left.stl")), part, cell);
  const std::string drawing = read(folder + name + part.ending);
  auto layers = std::string(part.ending) == ".dxf" ? read_dxf_shapes(drawing) : read_shapes(drawing);
  if (name == "sign") add_letters(layers);
  const std::vector<PlacedCopy> copies = copies_of(nlohmann::json::parse(made.out));
  FlatPoint zero = part.zero.value_or(FlatPoint{1e9, 1e9});
  if (!part.zero) {
    for (const auto& [layer, shapes] : layers) {
      zero = {std::min(zero.x, shapes.low().x), std::min(zero.y, shapes.low().y)};
    }
  }
  const DrawnSolid solid(layers, part.cuts, part.thickness, tolerance);
  std::size_t gouged = 0;
  std::size_t kept = 0;
  std::string places;
  int shown = 0;
  for (std::size_t j = 0; j < left.up(); ++j) {
    for (std::size_t i = 0; i < left.across(); ++i) {
      const FlatPoint at = left.place(i, j);
      const DrawnSolid::Heights wanted = heights_of(solid, copies, {at.x + zero.x, at.y + zero.y});
      if (wanted.wall < tolerance) continue;
      const double height = left.height(i, j);
      const bool is_low = height < wanted.least - tolerance;
      const bool is_high = height > std::max(wanted.most, -part.thickness) + tolerance && !wanted.may_be_left;
      gouged += is_low ? 1 : 0;
      kept += is_high ? 1 : 0;
      if ((is_low || is_high) && ++shown <= 6) {
        places += fmt::format("\nat X{:.1f} Y{:.1f}: {:.3f}, meant {:.3f} to {:.3f}", at.x, at.y, height, wanted.least,
                              wanted.most);
      }
    }
  }
  EXPECT_EQ(gouged, 0U) << places;
  EXPECT_EQ(kept, 0U) << places;
  EXPECT_EQ(left.loose_cells(), 0U);
}

INSTANTIATE_TEST_SUITE_P(All, PartExamples, testing::ValuesIn(parts()), [](const auto& info) {
  std::string name = info.param.name;
  std::ranges::replace(name, '-', '_');
  return name;
});

}  // namespace
