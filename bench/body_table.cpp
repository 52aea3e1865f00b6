// body_table [PASSO]: carves twenty models by `passo cam relief`, and prints for each the processor time, the memory,
// and how deep the program cuts into the model at most. An oracle computes the exact contact of the cutter with the
// triangles, every 0.05 mm along each feed move (src/cam/carve/tests/contact_oracle.hpp).
//
// PASSO: another build of the program to measure. `body_table --write FOLDER` only writes the models, as STL. The exit
// code is 1 if a program cuts deeper than 0.01 mm into its model.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "body_faces.hpp"
#include "contact_oracle.hpp"
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace passo {
namespace {

using namespace test;

constexpr double pi = std::numbers::pi;
constexpr double wide = 40;  // mm
constexpr double deep = 30;

struct Span {
  double low;
  double high;
};
// A block, turned about its middle.
Faces block(Span x, Span y, Span z, double degrees = 0) {
  return turned(box(x.low, y.low, z.low, x.high, y.high, z.high), degrees, (x.low + x.high) / 2, (y.low + y.high) / 2);
}

Faces plate() {
  return block({0, wide}, {0, deep}, {-1, 0});
}

struct ProfilePoint {
  double radius;
  double z;
};
// A solid of revolution; its profile begins and ends at the axis, or is closed.
Faces revolved(double x, double y, const std::vector<ProfilePoint>& profile, int parts) {
  Faces faces;
  const auto at = [&](const ProfilePoint& p, int i) {
    const double angle = 2 * pi * i / parts;
    return SurfacePoint{x + p.radius * std::cos(angle), y + p.radius * std::sin(angle), p.z};
  };
  for (std::size_t k = 0; k + 1 < profile.size(); ++k) {
    for (int i = 0; i < parts; ++i) {
      const ProfilePoint& a = profile[k];
      const ProfilePoint& b = profile[k + 1];
      if (a.radius > 0) faces.push_back({at(a, i), at(a, i + 1), at(b, i + 1)});
      if (b.radius > 0) faces.push_back({at(a, i), at(b, i + 1), at(b, i)});
    }
  }
  return faces;
}

Faces cylinder(double x, double y, double radius, double high, int parts) {
  return revolved(x, y, {{radius, 0}, {radius, high}, {0, high}}, parts);
}
Faces cone(double x, double y, double radius, double high, int parts) {
  return revolved(x, y, {{radius, 0}, {0, high}}, parts);
}
Faces ball(double x, double y, double z, double radius, int parts) {
  std::vector<ProfilePoint> profile;
  for (int i = 0; i <= parts / 2; ++i) {
    const double angle = pi * i / (parts / 2);
    profile.push_back({radius * std::sin(angle), z - radius * std::cos(angle)});
  }
  profile.front().radius = profile.back().radius = 0;
  return revolved(x, y, profile, parts);
}

struct Body {
  const char* name;
  const char* options;  // of `passo cam relief`
  std::vector<const char*> cutters;
  Faces faces;
};

constexpr const char* by_rows = "--step 0.4";
constexpr const char* by_contours = "--step 0.4 --way contours --entry plunge";

void add_walls_and_ribs(std::vector<Body>& all) {
  const auto begin = [&](const char* name, const char* options, std::vector<const char*> cutters) -> Faces& {
    all.push_back({name, options, std::move(cutters), plate()});
    return all.back().faces;
  };
  add(begin("block", by_contours, {"flat:2.3"}), block({10.013, 30.007}, {7.009, 23.003}, {0, 6}));
  add(begin("turned block", by_rows, {"flat:2.3"}), block({10, 30}, {8, 22}, {0, 6}, 17.3));
  Faces& stairs = begin("stairs", "--step 0.4 --way columns", {"bull:3:0.5"});
  for (int i = 0; i < 6; ++i) add(stairs, block({4 + 2.7 * i, 36}, {3 + 1.1 * i, 27}, {1.1 * i, 1.1 * (i + 1)}));
  add(begin("rib of 0.25 mm", by_rows, {"ball:3"}), block({20.05, 20.3}, {10, 20}, {0, 8}));
  Faces& ribs = begin("ribs of 2 to 42 um", by_contours, {"ball:3"});
  for (int i = 0; i < 5; ++i) add(ribs, block({4 + 7.1 * i, 4.002 + 7.11 * i}, {6, 24}, {0, 5}, 13.0 * i));
  Faces& lattice = begin("crossed ribs", "--step 0.3", {"taper:1:10:3"});
  for (int i = 0; i < 5; ++i) add(lattice, block({5 + 7.03 * i, 5.1 + 7.03 * i}, {2, 28}, {0, 4}, 8));
  for (int i = 0; i < 4; ++i) add(lattice, block({2, 38}, {4 + 7.01 * i, 4.1 + 7.01 * i}, {0, 3}, 8));
  Faces& slots = begin("slots", "--step 0.4 --rough flat:2.3 --rough-way offsets --rest taper:1:10:3",
                       {"flat:2.3", "ball:3", "taper:1:10:3"});
  for (int i = 0; i < 8; ++i) add(slots, block({2 + 4.5 * i, 5.3 + 4.37 * i}, {4, 26}, {0, 4}));
}

void add_tips_and_caves(std::vector<Body>& all) {
  const auto begin = [&](const char* name, const char* options, std::vector<const char*> cutters) -> Faces& {
    all.push_back({name, options, std::move(cutters), plate()});
    return all.back().faces;
  };
  Faces& tips = begin("tips", by_rows, {"vee:60:3"});
  Faces& needles = begin("needles of 0.1 mm", "--step 0.4 --way spiral", {"ball:3"});
  // The references above stay valid: `all` has room for every body.
  Faces& posts = begin("posts", by_contours, {"flat:2.3"});
  for (int i = 0; i < 12; ++i) {
    const double x = 5.03 + 9.97 * (i % 4);
    const double y = 5.01 + 9.99 * (i / 4);
    add(tips, cone(x, y, 3, 5, 12));
    add(needles, cylinder(x, y, 0.05, 5, 8));
    add(posts, cylinder(x, y, 3, 4, 60));
  }
  add(begin("pyramid", "--step 0.4 --way both", {"vee:90:3:0.4"}), revolved(20, 15, {{14, 0}, {0, 9}}, 4));
  add(begin("half a ball", by_contours, {"ball:3"}), ball(20, 15, 0, 12, 120));
  add(begin("mushroom", by_rows, {"ball:3"}), revolved(20, 15, {{2, 0}, {2, 5}, {10, 5}, {7, 8}, {0, 9}}, 60));
  Faces& arch = begin("arch", by_contours, {"bull:3:0.5"});
  add(arch, block({8, 12}, {10, 20}, {0, 6}));
  add(arch, block({28, 32}, {10, 20}, {0, 6}));
  add(arch, block({8, 32}, {10, 20}, {6, 8}));
  add(begin("floating ball", by_rows, {"taper:1:10:3"}), ball(20, 15, 7, 5, 60));
}

void add_scans(std::vector<Body>& all) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  const auto hills = [](double x, double y) {
    return 3 * std::sin(x * 0.35) * std::cos(y * 0.25) + 0.6 * std::sin(x * 1.7 + y) + 0.3 * std::cos(y * 2.3);
  };
  const auto scan = [&](double x, double y) { return hills(x, y) + 0.03 * share(random); };
  const auto rough = [&](double x, double y) { return hills(x, y) + 0.5 * share(random); };
  const auto cliffs = [](double x, double y) {
    return 4 * std::round(0.5 + 0.5 * std::sin(x * 0.6 + std::sin(y * 0.4)));
  };
  all.push_back({"hills", by_contours, {"ball:3"}, terrain(wide, deep, 80, 60, hills)});
  all.push_back({"scan of 24,000 triangles", by_rows, {"ball:3"}, terrain(wide, deep, 128, 96, scan)});
  all.push_back({"scan of 196,000 triangles", by_rows, {"ball:3"}, terrain(wide, deep, 362, 271, scan)});
  all.push_back({"rough scan", "--step 0.3", {"taper:1:10:3"}, terrain(wide, deep, 160, 120, rough)});
  all.push_back({"cliffs", by_contours, {"bull:3:0.5"}, terrain(wide, deep, 80, 60, cliffs)});
}

std::vector<Body> bodies() {
  std::vector<Body> all;
  all.reserve(20);
  add_walls_and_ribs(all);
  add_tips_and_caves(all);
  add_scans(all);
  return all;
}

void write_stl(const std::filesystem::path& path, const Faces& faces) {
  std::string bytes(80, ' ');
  const auto put = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  put(static_cast<std::uint32_t>(faces.size()));
  for (const SurfaceTriangle& face : faces) {
    for (int i = 0; i < 3; ++i) put(0.0F);
    for (const SurfacePoint& p : face) {
      for (const double value : {p.x, p.y, p.z}) put(static_cast<float>(value));
    }
    put(std::uint16_t{0});
  }
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

// The model as the file has it, in floats, where the program carves it: its lower left corner at X0 Y0, its top at Z0.
Faces carved(Faces faces) {
  SurfacePoint low{1e9, 1e9, 0};
  double top = -1e9;
  for (SurfaceTriangle& face : faces) {
    for (SurfacePoint& p : face) {
      for (double SurfacePoint::*axis : {&SurfacePoint::x, &SurfacePoint::y, &SurfacePoint::z}) {
        p.*axis = static_cast<double>(static_cast<float>(p.*axis));
      }
      low = {std::min(low.x, p.x), std::min(low.y, p.y), 0};
      top = std::max(top, p.z);
    }
  }
  for (SurfaceTriangle& face : faces) {
    for (SurfacePoint& p : face) p = {p.x - low.x, p.y - low.y, p.z - top};
  }
  return faces;
}

struct Use {
  double seconds = 0;
  double mib = 0;
  bool is_good = false;
};

double peak_kib(const std::string& status) {
  std::ifstream file(status);
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("VmHWM:")) return std::stod(line.substr(6));
  }
  return 0;
}

// Runs a command, without its output.
Use used_by(const std::vector<std::string>& words) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    dup2(nowhere, STDOUT_FILENO);
    execv(arguments.front(), arguments.data());
    _exit(127);
  }
  if (child < 0) return {};
  // The child's usage counts what this process had in memory when it was forked, so its own peak is read while it runs.
  const std::string of_child = "/proc/" + std::to_string(child) + "/status";
  double most_kib = 0;
  int status = 0;
  rusage usage{};
  for (pid_t ended = 0; ended == 0; ended = wait4(child, &status, WNOHANG, &usage)) {
    usleep(1000);
    const double here = peak_kib(of_child);
    if (here > 0) most_kib = here;  // the last one: the first may be from before the program was started
  }
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) / 1e6;
  };
  return {.seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime),
          .mib = most_kib / 1024,
          .is_good = WIFEXITED(status) && WEXITSTATUS(status) == 0};
}

double deepest(const Faces& faces, const std::string& program, const std::vector<const char*>& cutters) {
  test::ContactOracle oracle(carved(faces));
  double most = 0;
  for (const test::ReadMove& move : test::moves_of(program)) {
    if (move.is_rapid) continue;
    const OracleCutter& cutter = test::oracle_of(cutters[cutters.size() > 1 ? move.tool - 1 : 0]);
    const double length = std::hypot(move.to[0] - move.from[0], move.to[1] - move.from[1], move.to[2] - move.from[2]);
    const int parts = std::max(1, static_cast<int>(std::ceil(length / 0.05)));
    for (int i = 0; i <= parts; ++i) {
      const double share = static_cast<double>(i) / parts;
      const auto at = [&](int axis) { return move.from[axis] + (move.to[axis] - move.from[axis]) * share; };
      most = std::max(most, oracle.depth(cutter, at(0), at(1), at(2)));
    }
  }
  return most;
}

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    words.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

std::string joined(const std::vector<const char*>& words) {
  std::string all;
  for (const char* const word : words) all += (all.empty() ? "" : ", ") + std::string(word);
  return all;
}

// Prints a row of the table. Returns whether the program cuts into nothing.
bool measure(const Body& body, const std::string& passo, const std::filesystem::path& folder) {
  const std::filesystem::path model = folder / "body.stl";
  const std::filesystem::path program = folder / "body.ngc";
  write_stl(model, body.faces);
  std::vector<std::string> command = {passo, "cam", "relief", model.string(), "-o", program.string()};
  command.insert(command.end(), {"--cutter", body.cutters[body.cutters.size() > 1 ? 1 : 0]});
  for (const std::string& word : words_of(body.options)) command.push_back(word);
  const Use use = used_by(command);
  if (!use.is_good) {
    std::printf("| %s | %s | %s | failed | | |\n", body.name, joined(body.cutters).c_str(), body.options);
    return false;
  }
  std::ifstream file(program, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const double depth = deepest(body.faces, text, body.cutters);
  std::printf("| %s | %s | `%s` | %.2f s | %.0f MiB | %.4f mm |\n", body.name, joined(body.cutters).c_str(),
              body.options, use.seconds, use.mib, depth);
  std::fflush(stdout);
  return depth <= 0.01;
}

int run(const std::vector<std::string>& arguments) {
  const std::vector<Body> all = bodies();
  if (arguments.size() == 2 && arguments[0] == "--write") {
    for (const Body& body : all) {
      std::string name = body.name;
      std::replace(name.begin(), name.end(), ' ', '-');
      write_stl(std::filesystem::path(arguments[1]) / (name + ".stl"), body.faces);
    }
    return 0;
  }
  std::string pattern = (std::filesystem::temp_directory_path() / "body-table-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) return 1;
  std::printf("| model | cutters | options | processor time | memory | largest cut into the model |\n");
  std::printf("|---|---|---|---:|---:|---:|\n");
  bool is_good = true;
  for (const Body& body : all)
    is_good = measure(body, arguments.empty() ? PASSO_PROGRAM : arguments[0], pattern) && is_good;
  std::filesystem::remove_all(pattern);
  return is_good ? 0 : 1;
}

}  // namespace
}  // namespace passo

int main(int count, char** arguments) {
  return passo::run({arguments + 1, arguments + count});
}
