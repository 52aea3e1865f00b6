// Whatever the text is, there is no crash and no endless loop, and every operation is finite. Run it under the
// sanitizers.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>

#include "interpreted.hpp"
#include "kit/seed.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

namespace fs = std::filesystem;
using Random = std::mt19937_64;

std::size_t below(Random& random, std::size_t limit) {
  return std::uniform_int_distribution<std::size_t>(0, limit - 1)(random);
}

void run(const std::string& program) {
  constexpr int most_operations = 2000;
  InterpreterOptions options;
  options.idle_passes = 200;
  options.repeated_steps = 20'000;
  Diagnostics diagnostics;
  Interpreter interpreter(ProgramReader::from_text("fuzz.ngc", program), options, diagnostics);
  CanonPrinter printer;
  std::string canon;
  Operation operation;
  for (int i = 0; i < most_operations && interpreter.next(operation); ++i) {
    printer.print(operation, canon);
    if (const auto* const curve = std::get_if<operation::NurbsFeed>(&operation.what)) {
      ASSERT_GE(curve->points.size(), static_cast<std::size_t>(curve->order)) << program;
      for (const operation::ControlPoint& point : curve->points)
        ASSERT_TRUE(std::isfinite(point.x) && std::isfinite(point.y) && point.weight > 0) << program;
    }
    const auto* const feed = std::get_if<operation::StraightFeed>(&operation.what);
    const auto* const arc = std::get_if<operation::ArcFeed>(&operation.what);
    if (feed == nullptr && arc == nullptr) continue;
    for (const double value : (feed != nullptr ? feed->end : arc->end).values)
      ASSERT_TRUE(std::isfinite(value)) << program;
    if (arc != nullptr) {
      ASSERT_NE(arc->turns, 0) << program;
    }
  }
  const std::string rendered = render(diagnostics, true);
  ASSERT_EQ(rendered.empty(), diagnostics.all().empty());
}

constexpr std::string_view word_list =
    "G0|G1|G2|G3|G4|G5|G5.1|G5.2|G5.3|G50|G51|G10|L2|L20|G17|G18|G19|G20|G21|G28|G28.1|G30|G33|G33.1|G40|G41|G41.1|G42."
    "1|D.5|D-3|L3|G43|G43.1|"
    "G49|G52|"
    "G53|G54|G55|G59.3|G61|G64|G7|G8|G80|G90|G90.1|G91|G91.1|G92|G92.1|G92.2|G92.3|G93|G94|G95|M0|"
    "M2|M3|M5|M6|M7|M9|M49|M61|X1|X-2.5|Y3|Z.5|A90|U2|I1|J-1|K.5|R5|R-7|P1|P2|Q.1|F100|S200|T3|@5|"
    "^30|X#1|Y[#2+1]|#1=3|#2=[#1*2]|#<a>=1|X#<a>|(msg,x)|(debug,#1 #<a>)|;c|/|N10|H2|D1|%|G81|Z1e3|"
    "X99999999999|M19|$0|$-1|E1|L2|M50|M51|M52|M53|M62|M66|M67|M68|M70|M71|M72|M73|M98|M98 P1|M98 P2 "
    "L3|M99|G38.2|G38.3|"
    "G38.5|G96|G97|M101|O1|O2|#5599=0|(PROBEOPEN "
    "x)|(PROBECLOSE)|G82|G83|G73|G84|G74|G85|G86|G89|G98|G99|L3|Z-5|R.5|G76|P.4|I-2|J.3|K1|E.1|G70 Q7|G71 Q7|G71.2 "
    "Q7|G72 "
    "Q7|"
    "X20 Z2|C.1";
constexpr std::string_view control_list =
    "o1 sub|o1 endsub|o1 call|o1 call [1] [2]|o1 return [3]|o2 if [#1]|o2 elseif [1]|o2 else|"
    "o2 endif|o3 while [#1 LT 5]|o3 endwhile|o4 do|o4 while [0]|o4 while [1]|o5 repeat [3]|"
    "o5 endrepeat|o3 break|o5 continue|o4 break|o[#1] call|o<b> sub|o<b> endsub|o<b> call [#1]|"
    "o3 continue|o6|o7 sub|G1 X5 Z-2|X7 Z-6 A.3|G3 X9 Z-8 K-2|X11|o7 endsub";

std::vector<std::string> split(std::string_view list) {
  std::vector<std::string> parts;
  for (;;) {
    const std::size_t bar = list.find('|');
    parts.emplace_back(list.substr(0, bar));
    if (bar == std::string_view::npos) return parts;
    list.remove_prefix(bar + 1);
  }
}

TEST(Fuzz, random_blocks_are_interpreted_or_refused) {
  const std::vector<std::string> words = split(word_list);
  const std::vector<std::string> controls = split(control_list);
  Random random(test::seed());
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(test::seed()));
  for (int i = 0; i < 1500; ++i) {
    std::string program = below(random, 2) == 0 ? "G21 F100 S1 M3\n" : "";
    for (std::size_t line = 1 + below(random, 25); line > 0; --line) {
      if (below(random, 3) == 0) {
        program += controls[below(random, controls.size())];
      } else {
        for (std::size_t word = below(random, 5); word > 0; --word) program += words[below(random, words.size())] + " ";
      }
      program += "\n";
    }
    run(program);
    if (HasFatalFailure()) return;
  }
}

TEST(Fuzz, damaged_programs_are_interpreted_or_refused) {
  Random random(test::seed());
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(test::seed()));
  const char letters[] = "GMXYZIJKRPO0123456789.-[]#<>()/% \n=+*";
  for (const auto& entry :
       fs::directory_iterator(fs::path(PASSO_SOURCE_DIR) / "src/language/interpreter/tests/golden")) {
    if (entry.path().extension() != ".ngc") continue;
    const std::string whole = contents(entry.path().string());
    for (int i = 0; i < 100; ++i) {
      std::string program = whole;
      for (std::size_t hits = 1 + below(random, 6); hits > 0; --hits) {
        const std::size_t at = below(random, program.size());
        switch (below(random, 4)) {
          case 0: program[at] = letters[below(random, sizeof letters - 1)]; break;
          case 1: program.erase(at, 1 + below(random, 20)); break;
          case 2: program.insert(at, 1, letters[below(random, sizeof letters - 1)]); break;
          default: program.insert(at, program.substr(below(random, program.size()), below(random, 60))); break;
        }
      }
      run(program);
      if (HasFatalFailure()) return;
    }
  }
}

}  // namespace
}  // namespace passo
