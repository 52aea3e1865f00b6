// What is wrong in a program: the code, the line, the column and how much of the line it is about.
#include "interpreted.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

struct Wrong {
  const char* program;
  const char* code;
  std::uint32_t line;
  std::uint32_t column;
  std::uint32_t length;
};

const Wrong wrongs[] = {
    {"G21\nG1 X10\n", "gcode.missing-feed", 2, 1, 2},
    {"G21 G1\nX10 Y2\n", "gcode.missing-feed", 1, 5, 2},
    {"G93\nF5 G1 X1\nX2\n", "gcode.missing-feed", 3, 1, 2},
    {"G95 F1\nG1 X1\n", "gcode.missing-speed", 2, 1, 2},
    {"G12 X1\n", "gcode.unknown-code", 1, 1, 3},
    {"G0 G0.5\n", "gcode.unknown-code", 1, 4, 4},
    {"M200\n", "gcode.unknown-code", 1, 1, 4},
    {"M100.5\n", "gcode.unknown-code", 1, 1, 6},
    {"M101 P1\n", "gcode.user-code", 1, 1, 4},
    {"M100 M101\n", "gcode.modal-conflict", 1, 6, 4},
    {"M3 $1\n", "gcode.no-such-spindle", 1, 4, 2},
    {"M3 $0.5\n", "gcode.no-such-spindle", 1, 4, 4},
    {"M19 R1 $-1\n", "gcode.no-such-spindle", 1, 8, 3},
    {"G0 X1 $0\n", "gcode.unused-word", 1, 7, 2},
    {"M19 R361\n", "gcode.bad-angle", 1, 5, 4},
    {"M19 R1 P3\n", "gcode.not-whole", 1, 8, 2},
    {"M19 Q0\n", "gcode.negative-word", 1, 5, 2},
    {"M19 R1 M3\n", "gcode.modal-conflict", 1, 8, 2},
    {"G64 M19 R90 S0\n", "gcode.ambiguous-word", 1, 9, 3},
    {"G96\n", "gcode.missing-word", 1, 1, 3},
    {"G96 D0 S1\n", "gcode.negative-word", 1, 5, 2},
    {"M62\n", "gcode.missing-word", 1, 1, 3},
    {"M62 P-1\n", "gcode.not-whole", 1, 5, 3},
    {"M65 P64\n", "gcode.not-whole", 1, 5, 3},
    {"M62 P1 G4 P1\n", "gcode.repeated-word", 1, 11, 2},
    {"M62 P1 G4\n", "gcode.ambiguous-word", 1, 5, 2},
    {"M67 E1\n", "gcode.missing-word", 1, 1, 3},
    {"M68 Q1\n", "gcode.missing-word", 1, 1, 3},
    {"M66\n", "gcode.missing-word", 1, 1, 3},
    {"M66 P1 E1\n", "gcode.ambiguous-word", 1, 8, 2},
    {"M66 P1 L3\n", "gcode.bad-wait", 1, 8, 2},
    {"M66 P1 L3 Q0\n", "gcode.bad-wait", 1, 11, 2},
    {"M66 E1 L3 Q1\n", "gcode.bad-wait", 1, 8, 2},
    {"M66 P1 L5 Q1\n", "gcode.not-whole", 1, 8, 2},
    {"M72\n", "gcode.nothing-saved", 1, 1, 3},
    {"M70\nM71\nM72\n", "gcode.nothing-saved", 3, 1, 3},
    {"M70\no1 sub\nM72\no1 endsub\no1 call\n", "gcode.nothing-saved", 3, 1, 3},
    {"G38.2 X1\n", "gcode.missing-feed", 1, 1, 5},
    {"F1 G38.2\n", "gcode.missing-axis", 1, 4, 5},
    {"F1 G38.2 X0\n", "gcode.probe-too-short", 1, 4, 5},
    {"G93\nG38.3 X1 F1\n", "gcode.probe-mode", 2, 1, 5},
    {"G95 S1 F1 M3\nG38.3 X1\n", "gcode.probe-mode", 2, 1, 5},
    {"F1 G53 G38.2 X1\n", "gcode.g53-without-move", 1, 4, 3},
    {"M98\n", "gcode.missing-word", 1, 1, 3},
    {"M98 P1.5\n", "gcode.not-whole", 1, 5, 4},
    {"M98 P1 L-1\nO1\nM99\n", "gcode.not-whole", 1, 8, 3},
    {"M98 P7\nM2\n", "gcode.unknown-sub", 1, 1, 3},
    {"G0 X3 M98 P1\nM2\nO1\nM99\n", "gcode.unused-word", 1, 1, 2},
    {"M98 P1 #1=3\nM2\nO1\nM99\n", "gcode.unused-word", 1, 8, 4},
    {"M98 P1\nM2\no1 sub\no1 endsub\n", "gcode.mixed-subs", 1, 1, 3},
    {"o1 call\nM2\nO1\nM99\n", "gcode.mixed-subs", 1, 1, 0},
    {"M98 P1\nM2\nO1\no1 endsub\n", "gcode.mixed-subs", 4, 1, 0},
    {"M98 P1\nM2\nO1\no1 return\n", "gcode.mixed-subs", 4, 1, 0},
    {"o1 call\nM2\no1 sub\nM99\no1 endsub\n", "gcode.mixed-subs", 4, 1, 3},
    {"M98 P1\nM2\nO1\nG0 X1\n", "gcode.unclosed-o-word", 3, 1, 0},
    {"M98 P1\nM2\nO1\nM98 P1\nM99\n", "gcode.calls-too-deep", 4, 1, 3},
    {"G0 X1\nM98 P1 L1000\nM2\nO1\nM99\n", "gcode.endless-loop", 4, 1, 0},
    {"G-1\n", "gcode.unknown-code", 1, 1, 3},
    {"G41 D7\n", "gcode.unknown-tool", 1, 5, 2},
    {"G42 D1.5\n", "gcode.not-whole", 1, 5, 4},
    {"G41 D-1\n", "gcode.not-whole", 1, 5, 3},
    {"G42.1\n", "gcode.missing-word", 1, 1, 5},
    {"G41.1 D2 L1\n", "gcode.cutter-compensation", 1, 10, 2},
    {"G18\nG41.1 D2 L10\n", "gcode.not-whole", 2, 10, 3},
    {"G19\nG41.1 D2\n", "gcode.cutter-compensation", 2, 1, 5},
    {"G41.1 D2\nG42.1 D2\n", "gcode.cutter-compensation", 2, 1, 5},
    {"G41.1 D2 G64\n", "gcode.cutter-compensation", 1, 10, 3},
    {"G41.1 D2\nG0 X10\nG18\n", "gcode.cutter-compensation", 3, 1, 3},
    {"G41.1 D2\nG0 X10\nT1 M6\n", "gcode.cutter-compensation", 3, 4, 2},
    {"G41.1 D2\nG0 X10\nM61 Q1\n", "gcode.cutter-compensation", 3, 1, 3},
    {"G41.1 D2\nG0 X10\nM49\n", "gcode.cutter-compensation", 3, 1, 3},
    {"G41.1 D2\nG0 X10\nG43.1 Z1\n", "gcode.cutter-compensation", 3, 1, 5},
    {"G41.1 D2\nG0 X10\nG49\n", "gcode.cutter-compensation", 3, 1, 3},
    {"G41.1 D2\nG0 X10\nG55\n", "gcode.cutter-compensation", 3, 1, 3},
    {"G41.1 D2\nG0 X10\nG61\n", "gcode.cutter-compensation", 3, 1, 3},
    {"G41.1 D2\nG0 X10\nG98\n", "gcode.cutter-compensation", 3, 1, 3},
    {"G41.1 D2\nG0 X10\nG28\n", "gcode.cutter-compensation", 3, 1, 3},
    {"G41.1 D2\nG0 X10\nG28.1\n", "gcode.cutter-compensation", 3, 1, 5},
    {"G41.1 D2\nG0 X10\nG30 X1\n", "gcode.cutter-compensation", 3, 1, 3},
    {"G41.1 D2\nG0 X10\nG53 G0 X1\n", "gcode.cutter-compensation", 3, 1, 3},
    {"G41.1 D2\nG0 X10\nG92 X0\n", "gcode.cutter-compensation", 3, 1, 3},
    {"G41.1 D2\nG0 X10\nG92.1\n", "gcode.cutter-compensation", 3, 1, 5},
    {"G41.1 D2\nG0 X10\nG52 X1\n", "gcode.cutter-compensation", 3, 1, 3},
    {"G41.1 D2\nG0 X10\nG10 L2 P1 X1\n", "gcode.cutter-compensation", 3, 1, 3},
    {"G41.1 D2\nG0 X10\nG10 L20 P0 X1\n", "gcode.cutter-compensation", 3, 1, 3},
    {"G41.1 D2\nG0 X10\nM3 G33 Z1 K1\n", "gcode.cutter-compensation", 3, 4, 3},
    {"G41.1 D2\nG0 X10\nG40 G18\n", "gcode.cutter-compensation", 3, 5, 3},
    {"G41.1 D2\nG0 X1\n", "gcode.cutter-entry", 2, 1, 2},
    {"G41.1 D2\nG0 Z1\n", "gcode.cutter-entry", 2, 1, 2},
    {"F1 G41.1 D2\nG2 X.5 Y.5 J.5\n", "gcode.cutter-entry", 2, 1, 2},
    {"F1 G41.1 D2\nG3 X1.9596 Y.4 J5\n", "gcode.cutter-entry", 2, 1, 2},
    {"F1 G41.1 D8\nG3 X5 Y1 I2.5 J.5\n", "gcode.cutter-gouge", 2, 1, 2},
    {"F1 G41.1 D4\nG1 X10\nG3 Y2 J1\n", "gcode.cutter-gouge", 3, 1, 2},
    {"F1 G41.1 D4\nG1 X10\nX20\nY1\n X10\n", "gcode.cutter-gouge", 5, 2, 3},
    {"F1 G41.1 D4\nG1 X10\nX20\nY1\nX10\nY10\nX30\n", "gcode.cutter-gouge", 5, 1, 3},
    {"F1 G41.1 D2\nG1 X10\nG2 Y8 J4\nG3 X10.5 Y8 I.25\n", "gcode.cutter-gouge", 4, 1, 2},
    {"F1 G41.1 D2\nG1 X10\nG40\nG3 X12 I1\n", "gcode.arc-after-compensation", 4, 1, 2},
    {"G10 L1 P1 Z5\n", "gcode.unknown-tool", 1, 8, 2},
    {"G10 L1 Z5\n", "gcode.missing-word", 1, 1, 3},
    {"G10 L3 P1 Z5\n", "gcode.missing-word", 1, 5, 2},
    {"G10 L2 P1 Q5\n", "gcode.unused-word", 1, 11, 2},
    {"G43.2\n", "gcode.missing-word", 1, 1, 5},
    {"G43.2 H1 X2\n", "gcode.unused-word", 1, 7, 2},
    {"G43.2 X2 G0\n", "gcode.axis-conflict", 1, 1, 5},
    {"F1 G87 X1 Z-1 R2 I1 J1 K1\n", "gcode.cycle-spindle", 1, 4, 3},
    {"F1 M3 G87 X1 Z-1 R2 I1 J1\n", "gcode.missing-word", 1, 7, 3},
    {"F1 G88 X1 Z-1 R2 P1\n", "gcode.cycle-spindle", 1, 4, 3},
    {"F1 M3 G88 X1 Z-1 R2\n", "gcode.missing-word", 1, 7, 3},
    {"F1 G17.1 G81 U1 W-1 R2 X1\n", "gcode.cycle-axis", 1, 24, 2},
    {"F1 G17.1 G2 X1 I1\n", "gcode.wrong-plane", 1, 10, 2},
    {"G19.1 G41.1 D1\n", "gcode.cutter-compensation", 1, 7, 5},
    {"G10 L0\nT1 M6\nG10 L0\n", "gcode.tool-loaded", 3, 5, 2},
    {"G0 X#<_hal[motion.foo]>\n", "gcode.no-hal", 1, 5, 19},
    {"G0 G1 X1 F1\n", "gcode.modal-conflict", 1, 4, 2},
    {"G17 G18\n", "gcode.modal-conflict", 1, 5, 3},
    {"M3 S1 M5\n", "gcode.modal-conflict", 1, 7, 2},
    {"M7 M8\n", "gcode.modal-conflict", 1, 4, 2},
    {"G4 P1 G92 X1\n", "gcode.modal-conflict", 1, 7, 3},
    {"G0 X1 Y2 X3\n", "gcode.repeated-word", 1, 10, 2},
    {"G0 X1 K2\n", "gcode.unused-word", 1, 7, 2},
    {"G0 X1 D1\n", "gcode.unused-word", 1, 7, 2},
    {"H1\n", "gcode.unused-word", 1, 1, 2},
    {"P1\n", "gcode.unused-word", 1, 1, 2},
    {"G80 X1\n", "gcode.unused-word", 1, 5, 2},
    {"X1\n", "gcode.missing-motion", 1, 1, 2},
    {"G0\nG80\n  Y1\n", "gcode.missing-motion", 3, 3, 2},
    {"G92\n", "gcode.missing-axis", 1, 1, 3},
    {"G0 Z1 M3 S1\nG33 K1\n", "gcode.missing-axis", 2, 1, 3},
    {"G0 G92 X1\n", "gcode.axis-conflict", 1, 4, 3},
    {"G28 G1 F1 X1\n", "gcode.axis-conflict", 1, 1, 3},
    {"G43.1 G0 Z1\n", "gcode.axis-conflict", 1, 1, 5},
    {"F-10\n", "gcode.negative-word", 1, 1, 4},
    {"M3 S-1\n", "gcode.negative-word", 1, 4, 3},
    {"G4 P-1\n", "gcode.negative-word", 1, 4, 3},
    {"G4\n", "gcode.missing-word", 1, 1, 2},
    {"M61\n", "gcode.missing-word", 1, 1, 3},
    {"G10 P1 X1\n", "gcode.missing-word", 1, 1, 3},
    {"G10 L2 X1\n", "gcode.missing-word", 1, 1, 3},
    {"M3\nG33 Z1\n", "gcode.missing-word", 2, 1, 3},
    {"G10 L2 P10 X1\n", "gcode.not-whole", 1, 8, 3},
    {"T1.5\n", "gcode.not-whole", 1, 1, 4},
    {"T-1\n", "gcode.not-whole", 1, 1, 3},
    {"G43 H1.5\n", "gcode.not-whole", 1, 5, 4},
    {"F1 G2 X1 I.5 P1.5\n", "gcode.not-whole", 1, 14, 4},
    {"F1 G2 X1 I.5 P0\n", "gcode.not-whole", 1, 14, 2},
    {"M6\n", "gcode.missing-tool", 1, 1, 2},
    {"G53 X1\n", "gcode.missing-motion", 1, 5, 2},
    {"F1 G5 X1 P1 Q1\n", "gcode.missing-word", 1, 4, 2},
    {"F1 G5 X1 I1 P1 Q1\n", "gcode.missing-word", 1, 10, 2},
    {"F1 G5 X1 J1 P1 Q1\n", "gcode.missing-word", 1, 10, 2},
    {"F1 G5 X1 I1 J1 P1\n", "gcode.missing-word", 1, 16, 2},
    {"F1 G5 X1 I1 J1\n", "gcode.missing-word", 1, 4, 2},
    {"F1 G5 X1 I1 J1 P1 Q1\nG0 X0\nG5 X2 P1 Q1\n", "gcode.missing-word", 3, 1, 2},
    {"F1 G5 X1 I1 J1 P1 Q1\nG28\nG5 X2 P1 Q1\n", "gcode.missing-word", 3, 1, 2},
    {"F1 G5.1 X1 I1\n", "gcode.missing-word", 1, 12, 2},
    {"F1 G5.1 X1\n", "gcode.missing-word", 1, 4, 4},
    {"F1 G5.1 X1 I1 J1\nX2\n", "gcode.missing-word", 2, 1, 2},
    {"F1 G18 G5 X1 I1 J1 P1 Q1\n", "gcode.spline-plane", 1, 8, 2},
    {"F1 G19 G5.1 X1 I1 J1\n", "gcode.spline-plane", 1, 8, 4},
    {"F1 G5 X1 Z1 I1 J1 P1 Q1\n", "gcode.spline-axis", 1, 10, 2},
    {"F1 G5.1 X1 A1 I1 J1\n", "gcode.spline-axis", 1, 12, 2},
    {"F1 G5.2 X1 Y1 Z2 P1\n", "gcode.spline-axis", 1, 15, 2},
    {"G5 X1 I1 J1 P1 Q1\n", "gcode.missing-feed", 1, 1, 2},
    {"G5.1 X1 I1 J1\n", "gcode.missing-feed", 1, 1, 4},
    {"G5.2 X1 Y1 P1\nX2 Y1 P1\nG5.3\n", "gcode.missing-feed", 1, 1, 4},
    {"G93 G5 X1 I1 J1 P1 Q1\n", "gcode.missing-feed", 1, 5, 2},
    {"G93 G5.2 X1 Y1 P1 F1\nG5.3\n", "gcode.spline-inverse-time", 1, 5, 4},
    {"F1 G5.2 X1 Y1 P1\nX2 Y2 P1\nG93\nG5.3 F2\n", "gcode.spline-inverse-time", 4, 1, 4},
    {"F1 G53 G5.1 X1 I1 J1\n", "gcode.g53-without-move", 1, 4, 3},
    {"F1 G5.2 X1 P1\nG5.3\n", "gcode.missing-word", 1, 9, 2},
    {"F1 G5.2 X1 Y1\nG5.3\n", "gcode.missing-word", 1, 4, 4},
    {"F1 G5.2 X1 Y1 P0\nG5.3\n", "gcode.bad-weight", 1, 15, 2},
    {"F1 G5.2 X1 Y1 P1\nX2 Y2 P-1\nG5.3\n", "gcode.bad-weight", 2, 7, 3},
    {"F1 G5.2 X1 Y1 P1\nG5.2 P2\nG5.3\n", "gcode.missing-axis", 2, 1, 4},
    {"F1 G5.2 X1 Y1 P1 L2\nG5.3\n", "gcode.not-whole", 1, 18, 2},
    {"F1 G5.2 X1 Y1 P1 L11\nG5.3\n", "gcode.not-whole", 1, 18, 3},
    {"F1 G5.2 X1 Y1 P1\nG5.3\n", "gcode.too-few-points", 2, 1, 4},
    {"F1 G5.2 X1 Y1 P1 L4\nX2 Y2 P1\nG5.3\n", "gcode.too-few-points", 3, 1, 4},
    {"G5.3\n", "gcode.no-nurbs", 1, 1, 4},
    {"F1 G5.2 X1 Y1 P1\nX2 Y2 P1\nG5.3 X1\nG5.3\n", "gcode.unused-word", 3, 6, 2},
    {"F1 G5.2 X1 Y1 P1\nX2 Y2 P1\nG1 X1\n", "gcode.open-nurbs", 3, 1, 2},
    {"F1 G5.2 X1 Y1 P1\nG55\n", "gcode.open-nurbs", 2, 1, 3},
    {"F1 G5.2 X1 Y1 P1\nG92 X0\n", "gcode.open-nurbs", 2, 1, 3},
    {"F1 G5.2 X1 Y1 P1\nM2\n", "gcode.open-nurbs", 2, 1, 2},
    {"o1 sub\no2 sub\no2 endsub\no1 endsub\n", "gcode.stray-o-word", 2, 1, 6},
    {"G65 A2\n", "gcode.missing-word", 1, 1, 3},
    {"G65 P1.5\n", "gcode.not-whole", 1, 5, 4},
    {"G65 P1 A2\n", "gcode.unknown-sub", 1, 1, 3},
    {"G66 P1\n", "gcode.unknown-sub", 1, 1, 3},
    {"o1 sub\no1 endsub\nG65 P1\n", "gcode.mixed-subs", 3, 1, 3},
    {"G65 P1 G4\nO1\nM99\n", "gcode.macro-argument", 1, 8, 2},
    {"M3 G65 P1\nO1\nM99\n", "gcode.macro-argument", 1, 1, 2},
    {"G65 P1 @2\nO1\nM99\n", "gcode.macro-argument", 1, 8, 2},
    {"G65 P1 A1 A2\nO1\nM99\n", "gcode.repeated-word", 1, 11, 2},
    {"G65 P1 #1=2\nO1\nM99\n", "gcode.unused-word", 1, 8, 4},
    {"G66 P1\nG66 P1\nO1\nM99\n", "gcode.nested-macro", 2, 1, 3},
    {"G66 P1\nG0 X1\nM2\nO1\nG66 P1\nM99\n", "gcode.nested-macro", 5, 1, 3},
    {"G51\n", "gcode.missing-word", 1, 1, 3},
    {"G51 X1 Y1\n", "gcode.missing-word", 1, 1, 3},
    {"G51 P0\n", "gcode.zero-scale", 1, 5, 2},
    {"G51 P2 J3\n", "gcode.unused-word", 1, 8, 2},
    {"G51 A0 P2\n", "gcode.scale-axis", 1, 5, 2},
    {"F1 G51 I2\nG2 X1 I1\n", "gcode.uneven-scaling", 2, 1, 2},
    {"F1 G51 I2 J-2\nG2 X1 I1\n", "gcode.uneven-scaling", 2, 1, 2},
    {"G51 P2\nG0 @1 ^1\n", "gcode.scaled-motion", 2, 1, 2},
    {"G53\n", "gcode.g53-without-move", 1, 1, 3},
    {"F1 G53 G2 X1 I.5\n", "gcode.g53-without-move", 1, 4, 3},
    {"G91\nG53 G0 X1\n", "gcode.g53-incremental", 2, 1, 3},
    {"F1\nG2 X1\n", "gcode.missing-center", 2, 1, 2},
    {"F1 G90.1\nG2 X1 I1\n", "gcode.missing-center", 2, 1, 2},
    {"F1\nG2 X1 I1 R2\n", "gcode.mixed-arc", 2, 10, 2},
    {"F1\nG2 X1 I.5 K1\n", "gcode.wrong-center", 2, 11, 2},
    {"F1\nG2 X1 I.7\n", "gcode.arc-radii-differ", 2, 1, 2},
    {"F1\nG3 X1 Y1 I0\n", "gcode.zero-arc", 2, 1, 2},
    {"F1\nG2 X10 R4\n", "gcode.impossible-arc", 2, 8, 2},
    {"F1\nG2 X0 Y0 R4\n", "gcode.impossible-arc", 2, 10, 2},
    {"F1\nG33 Z1 K1\n", "gcode.spindle-off", 2, 1, 3},
    {"M3\nG33 Z1 K1 F1\n", "gcode.unused-word", 2, 11, 2},
    {"G4 P1 G2 X1 I.5 F1\n", "gcode.ambiguous-word", 1, 4, 2},
    {"G0 X1 @5\n", "gcode.bad-polar", 1, 7, 2},
    {"G0 @5\n", "gcode.bad-polar", 1, 4, 2},
    {"F1 G81 X1 Z-1\n", "gcode.missing-word", 1, 4, 3},
    {"F1 G81 X1 R1\n", "gcode.missing-word", 1, 4, 3},
    {"F1 G18 G81 X1 Z1 R1\n", "gcode.missing-word", 1, 8, 3},
    {"F1 G82 X1 Z-1 R1\n", "gcode.missing-word", 1, 4, 3},
    {"F1 G83 X1 Z-1 R1\n", "gcode.missing-word", 1, 4, 3},
    {"F1 G73 X1 Z-1 R1\n", "gcode.missing-word", 1, 4, 3},
    {"F1 G89 X1 Z-1 R1\n", "gcode.missing-word", 1, 4, 3},
    {"F1 G81 X1 Z-1 R1\nG0 X2\nG81 X3\n", "gcode.missing-word", 3, 1, 3},
    {"F1 G81 X1 Z-1 R1\nG82 X3\n", "gcode.missing-word", 2, 1, 3},
    {"F1 G81 X1 Z-1 R1\nG18 X3\n", "gcode.missing-word", 2, 5, 2},
    {"F1\nG81 X1\nX2\nX3\n", "gcode.missing-word", 2, 1, 3},
    {"F1 G81 X1 Z2 R1\n", "gcode.retract-below-bottom", 1, 14, 2},
    {"F1 G81 X1 Z-1 R1\nZ2\n", "gcode.retract-below-bottom", 2, 1, 2},
    {"F1 G91 G81 X1 Z2 R1\n", "gcode.retract-below-bottom", 1, 18, 2},
    {"G81 X1 Z-1 R1\n", "gcode.missing-feed", 1, 1, 3},
    {"F1 G93\nG81 X1 Z-1 R1\n", "gcode.cycle-inverse-time", 2, 1, 3},
    {"F1 G81 X1 Z-1 R1\nA90\n", "gcode.cycle-axis", 2, 1, 3},
    {"F1 G81 X1 Z-1 R1 W2\n", "gcode.cycle-axis", 1, 18, 2},
    {"F1 G81 X1 Z-1 R1 L0\n", "gcode.not-whole", 1, 18, 2},
    {"F1 G81 X1 Z-1 R1 L1.5\n", "gcode.not-whole", 1, 18, 4},
    {"F1 G82 X1 Z-1 R1 P-1\n", "gcode.negative-word", 1, 18, 3},
    {"F1 G83 X1 Z-1 R1 Q0\n", "gcode.negative-word", 1, 18, 2},
    {"F1 G83 X1 Z-1 R1 Q.00001\n", "gcode.peck-too-small", 1, 18, 7},
    {"F1 G81 X1 Z-1 R1 P1\n", "gcode.unused-word", 1, 18, 2},
    {"F1 G81 X1 Z-1 R1 Q1\n", "gcode.unused-word", 1, 18, 2},
    {"F1 G81 X1 Z-1 R1\nR2\n", "gcode.unused-word", 2, 1, 2},
    {"F1 G81\n", "gcode.missing-axis", 1, 4, 3},
    {"F1 G81 X1 Z-1 R1 G28\n", "gcode.axis-conflict", 1, 18, 3},
    {"F1 G84 X1 Z-1 R1\n", "gcode.cycle-spindle", 1, 4, 3},
    {"F1 M4 G84 X1 Z-1 R1\n", "gcode.cycle-spindle", 1, 7, 3},
    {"F1 M3 G74 X1 Z-1 R1\n", "gcode.cycle-spindle", 1, 7, 3},
    {"F1 G86 X1 Z-1 R1 P1\n", "gcode.cycle-spindle", 1, 4, 3},
    {"G76 P1 Z-9 I-1 J.1 K1\n", "gcode.spindle-off", 1, 1, 3},
    {"M3\nG76 Z-9 I-1 J.1 K1\n", "gcode.missing-word", 2, 1, 3},
    {"M3\nG76 P1 Z-9 J.1 K1\n", "gcode.missing-word", 2, 1, 3},
    {"M3\nG76 P1 Z-9 I-1 K1\n", "gcode.missing-word", 2, 1, 3},
    {"M3\nG76 P1 Z-9 I-1 J.1\n", "gcode.missing-word", 2, 1, 3},
    {"M3\nG76 P0 Z-9 I-1 J.1 K1\n", "gcode.bad-thread", 2, 5, 2},
    {"M3\nG76 P1 Z-9 I0 J.1 K1\n", "gcode.bad-thread", 2, 12, 2},
    {"M3\nG76 P1 Z-9 I-1 J0 K1\n", "gcode.bad-thread", 2, 16, 2},
    {"M3\nG76 P1 Z-9 I-1 J1 K1\n", "gcode.bad-thread", 2, 19, 2},
    {"M3\nG76 P1 Z-9 I-1 J.1 K1 Q81\n", "gcode.bad-thread", 2, 23, 3},
    {"M3\nG76 P1 Z-9 I-1 J.1 K1 R9\n", "gcode.bad-thread", 2, 23, 2},
    {"M3\nG76 P1 Z-9 I-1 J.1 K1 E5 L3\n", "gcode.bad-thread", 2, 23, 2},
    {"M3\nG76 P1 X9 I-1 J.1 K1\n", "gcode.bad-thread", 2, 1, 3},
    {"M3\nG76 P1 Z-9 I-1 J.1 K1 L4\n", "gcode.not-whole", 2, 23, 2},
    {"M3\nG76 P1 Z-9 I-1 J.1 K1 H-1\n", "gcode.not-whole", 2, 23, 3},
    {"M3\nG76 P1 Z-9 I-1 J.1 K1 B1\n", "gcode.cycle-axis", 2, 23, 2},
    {"G18 F1\nG71 X1\n", "gcode.missing-word", 2, 1, 3},
    {"F1\nG71 Q1 X1\n", "gcode.wrong-plane", 2, 1, 3},
    {"G18\nG71 Q1 X1\n", "gcode.missing-feed", 2, 1, 3},
    {"G18 F1 G93\nG71 Q1 X1\n", "gcode.cycle-inverse-time", 2, 1, 3},
    {"G18 F1\nG71 Q1.5 X1\n", "gcode.not-whole", 2, 5, 4},
    {"G18 F1\nG71 Q7 X1\n", "gcode.unknown-sub", 2, 5, 2},
    {"G18 F1\nG71 Q7 X1 I0\n", "gcode.negative-word", 2, 11, 2},
    {"G18 F1\nG70 Q7 X1 P0\n", "gcode.not-whole", 2, 11, 2},
    {"G18 F1\nG70 Q7 X1 I1\n", "gcode.unused-word", 2, 11, 2},
    {"o7 sub\nG0 X5\nG1 Z-2\nG1 Z1 X7\no7 endsub\nG18 F1 G71 Q7 X9 Z2\nG0 X9\n", "gcode.bad-contour", 6, 12, 2},
    {"o7 sub\nG0 X5\no7 endsub\nG18 F1 G71 Q7 X9 Z2\nG0 X9\n", "gcode.bad-contour", 4, 12, 2},
    {"o7 sub\nG0 X5\nG33 Z-2 K1\no7 endsub\nG18 F1 G71 Q7 X9 Z2\nG0 X9\n", "gcode.bad-contour", 3, 1, 3},
    {"o7 sub\nG0 X5\nG2 Z-2\nG1 X9\no7 endsub\nG18 F1 G71 Q7 X9 Z2\nG0 X9\n", "gcode.missing-center", 3, 1, 2},
    {"o7 sub\nG0 X5\nG1 Z-2 A1 C1\no7 endsub\nG18 F1 G71 Q7 X9 Z2\nG0 X9\n", "gcode.bad-contour", 3, 11, 2},
    {"o7 sub\nG0 X5 U1\nG1 Z-2\no7 endsub\nG18 F1 G71 Q7 X9 Z2\nG0 X9\n", "gcode.bad-contour", 2, 7, 2},
    {"#1=[1/0]\n", "gcode.division-by-zero", 1, 0, 0},
    {"G0 X#<nothing>\n", "gcode.unknown-parameter", 1, 5, 10},
    {"G0 X#5602\n", "gcode.unknown-parameter", 1, 5, 5},
    {"#5602=1\n", "gcode.bad-parameter-number", 1, 0, 0},
    {"#0=1\n", "gcode.bad-parameter-number", 1, 0, 0},
    {"#[1.5]=1\n", "gcode.bad-parameter-number", 1, 0, 0},
    {"#5420=1\n", "gcode.read-only-parameter", 1, 1, 7},
    {"#<_x>=1\n", "gcode.read-only-parameter", 1, 1, 7},
    {"(abort, no stock)\n", "gcode.abort", 1, 1, 17},
    {"G0 X1\no100 while [1]\nG4 P0\nM0\n", "gcode.unclosed-o-word", 2, 1, 0},
    {"G0 X1\n  o100 if [0]\nG4 P0\n", "gcode.unclosed-o-word", 2, 3, 0},
    {"o<mine> sub\nG0 X1\n", "gcode.unclosed-o-word", 1, 1, 0},
    {"o1 repeat [2]\no2 if [1]\no1 endrepeat\nM2\n", "gcode.unclosed-o-word", 2, 1, 0},
    {"o1 sub\no2 while [1]\no1 endsub\no1 call\nM2\n", "gcode.unclosed-o-word", 2, 1, 0},
    {"o1 endwhile\n", "gcode.stray-o-word", 1, 1, 0},
    {"o1 endif\n", "gcode.stray-o-word", 1, 1, 0},
    {"o1 break\n", "gcode.stray-o-word", 1, 1, 0},
    {"o1 return\n", "gcode.stray-o-word", 1, 1, 0},
    {"o1 sub\no1 endsub\no1 sub\no1 endsub\nM2\n", "gcode.stray-o-word", 3, 1, 0},
    {"o1 call\n", "gcode.unknown-sub", 1, 1, 0},
    {"G0 X1\no1 sub\no1 call\no1 endsub\no1 call\nM2\n", "gcode.calls-too-deep", 3, 1, 0},
    {"o1 repeat [5]\no2 while [1]\n#1=1\no2 endwhile\no1 endrepeat\n", "gcode.endless-loop", 2, 1, 0},
    {"o1 do\no1 while [1]\n", "gcode.endless-loop", 1, 1, 0},
    {"#1=0.5\no[#1] call\n", "gcode.bad-o-word", 2, 0, 0},
    {"o[0.5] call\n", "gcode.bad-o-word", 1, 0, 0},
};

TEST(Diagnostics, say_what_is_wrong_and_where) {
  InterpreterOptions options;
  options.idle_passes = 100;
  for (const Wrong& wrong : wrongs) {
    const Interpreted result = interpret_text(wrong.program, options);
    const Diagnostic* first = nullptr;
    for (const Diagnostic& diagnostic : result.diagnostics.all()) {
      if (diagnostic.severity == Severity::error && first == nullptr) first = &diagnostic;
    }
    ASSERT_NE(first, nullptr) << wrong.program;
    EXPECT_EQ(result.diagnostics.errors(), 1U) << wrong.program << result.rendered();
    EXPECT_EQ(first->code, wrong.code) << wrong.program << result.rendered();
    EXPECT_EQ(first->file, "test.ngc");
    EXPECT_EQ(first->place.line, wrong.line) << wrong.program << result.rendered();
    if (wrong.column != 0) {
      EXPECT_EQ(first->place.column, wrong.column) << wrong.program << result.rendered();
    }
    if (wrong.length != 0) {
      EXPECT_EQ(first->place.length, wrong.length) << wrong.program << result.rendered();
    }
    EXPECT_FALSE(first->message.empty());
    EXPECT_FALSE(first->message.ends_with('.')) << first->message;
    EXPECT_FALSE(first->text.empty()) << wrong.program;
  }
}

TEST(Diagnostics, all_errors_of_a_program_are_told_in_one_go) {
  const Interpreted result = interpret_text("G21 F100\nG1 X1 K1\nG12\nG2 X5\nT1.5\no9 endif\nG1 X2\nM2\n");
  EXPECT_EQ(result.diagnostics.errors(), 5U) << result.rendered();
  std::vector<std::uint32_t> lines;
  for (const Diagnostic& diagnostic : result.diagnostics.all()) lines.push_back(diagnostic.place.line);
  EXPECT_THAT(lines, testing::ElementsAre(2, 3, 4, 5, 6));
  EXPECT_EQ(result.all<operation::StraightFeed>().size(), 1U);
}

TEST(Diagnostics, a_wrong_line_in_a_loop_is_told_once) {
  const Interpreted result = interpret_text("G21\no1 repeat [50]\nG0 X1 K1\nno G-code\nG0 X2\no1 endrepeat\nM2\n");
  EXPECT_EQ(result.diagnostics.errors(), 2U) << result.rendered();
}

TEST(Diagnostics, one_wrong_arc_does_not_make_the_next_one_wrong) {
  const Interpreted result = interpret_text("G21 F100\nG2 X10 I2\nG2 X20 I5\nG2 X30 I5\nM2\n");
  EXPECT_EQ(result.diagnostics.errors(), 1U) << result.rendered();
}

TEST(Diagnostics, a_missing_feed_is_told_once_and_not_at_every_move) {
  const Interpreted result = interpret_text("G21\nG1 X1\nX2\nX3\nG94\nX4\nM2\n");
  EXPECT_EQ(result.diagnostics.errors(), 1U) << result.rendered();
}

TEST(Diagnostics, the_nearest_code_is_suggested) {
  const Interpreted result = interpret_text("G59.4\n");
  EXPECT_EQ(result.diagnostics.all().front().expected.substr(0, 4), "G59.") << result.rendered();
}

TEST(Diagnostics, a_code_of_another_control_names_what_does_the_same_here) {
  const auto expected = [](const std::string& program) {
    const Interpreted result = interpret_text(program);
    return result.diagnostics.all().front().expected;
  };
  EXPECT_EQ(expected("G12 I5\n"), "G2 or G3 with I and J, for a full circle");
  EXPECT_EQ(expected("M29 S500\n"), "G33.1: on other controls, this code announces rigid tapping");
  EXPECT_EQ(expected("G38 Z-1\n"), "G38.2, G38.3, G38.4 or G38.5");
  EXPECT_EQ(expected("G123\n"), "a code listed in docs/gcode.md");
}

TEST(Diagnostics, an_unused_word_tells_which_codes_use_it) {
  const Interpreted result = interpret_text("G0 X1 K1\nM2\n");
  EXPECT_EQ(result.diagnostics.all().front().expected, "K with G2, G3, G33, G33.1, G51, G76 or G87");
}

TEST(Diagnostics, reading_stops_when_there_are_enough) {
  std::string program = "G21\n";
  for (int i = 0; i < 1000; ++i) program += "G12\n";
  Diagnostics diagnostics(20);
  const InterpreterOptions options;
  Interpreter interpreter(ProgramReader::from_text("test.ngc", program), options, diagnostics);
  Operation operation;
  while (interpreter.next(operation)) {
  }
  EXPECT_TRUE(diagnostics.full());
  EXPECT_LT(interpreter.offset(), 200U);
}

TEST(Diagnostics, an_offset_without_a_tool_table_is_a_warning_and_told_once) {
  const Interpreted result = interpret_text("T2 M6\nG43\nG43 H5\nM2\n");
  ASSERT_EQ(result.diagnostics.all().size(), 1U) << result.rendered();
  EXPECT_EQ(result.diagnostics.all().front().severity, Severity::warning);
  EXPECT_EQ(result.diagnostics.all().front().code, "gcode.no-tool-table");
}

TEST(Diagnostics, a_message_that_linuxcnc_would_hide_is_a_warning) {
  const Interpreted result = interpret_text("G0 X1 (msg,look) (note)\nM2\n");
  ASSERT_EQ(result.diagnostics.all().size(), 1U) << result.rendered();
  EXPECT_EQ(result.diagnostics.all().front().code, "gcode.hidden-comment");
}

TEST(Diagnostics, a_number_without_its_letter_and_an_exponent_are_told_as_what_they_are) {
  const std::string dwell = interpret_text("G4 500\nM2\n").rendered();
  EXPECT_THAT(dwell, testing::HasSubstr(":1:1: error: there is no G4500"));
  EXPECT_THAT(dwell, testing::HasSubstr("a letter before the second number; a space does not end a number"));
  const std::string exponent = interpret_text("G0 X1e3\nM2\n").rendered();
  EXPECT_THAT(exponent, testing::HasSubstr(":1:6: error: no code of this block uses the word E"));
  EXPECT_THAT(exponent, testing::HasSubstr("numbers cannot have an exponent, so 1E3 is written 1000"));
  EXPECT_THAT(interpret_text("G0 X1 E3\nM2\n").rendered(), testing::Not(testing::HasSubstr("exponent")));
}

}  // namespace
}  // namespace passo
