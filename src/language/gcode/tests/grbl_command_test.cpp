#include "passo/gcode/grbl_command.hpp"

#include "parsed_line.hpp"
#include <gmock/gmock.h>

namespace passo {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(GrblCommands, are_known_by_what_they_do) {
  struct Line {
    const char* line;
    const char* message;
    const char* expected;
  };
  for (const auto& [line, message, expected] :
       {Line{"$H", "$H homes the machine", "passo home"}, Line{" $h (home)", "$H homes", "passo home"},
        Line{"$HX", "$H homes", "passo home"}, Line{"$X", "$X clears an alarm", "the operator"},
        Line{"$32=1", "$32= changes a Grbl setting", "machine file"},
        Line{"$ 1 0 0 = 250.5", "$100= changes a Grbl setting", "setting"},
        Line{"$J=G91 X5 F100", "$J= jogs", "passo jog"},
        Line{"$N0=G21", "$N is a startup line", "in the program itself"}, Line{"$RST=*", "$RST= resets", "the sender"},
        Line{"$$", "$$ is a system command of Grbl", "the sender"},
        Line{"$", "$ is a system command of Grbl", "the sender"},
        Line{"$#", "$# is a system command of Grbl", "the sender"},
        Line{"$G0 X5", "$G0X5 is a system command of Grbl", "the sender"},
        Line{"$SLP", "$SLP is a system command of Grbl", "the sender"}}) {
    const ParsedLine parsed(line);
    EXPECT_THAT(parsed.fault_at(), StartsWith("gcode.grbl-command")) << line;
    EXPECT_THAT(parsed.fault().message, StartsWith(message)) << line;
    EXPECT_THAT(parsed.fault().message, HasSubstr("cannot be part of a program")) << line;
    EXPECT_THAT(parsed.fault().expected, HasSubstr(expected)) << line;
  }
}

TEST(GrblCommands, leave_the_number_of_the_spindle_alone) {
  for (const char* const line :
       {"$1 M3 S100", "$[1+1] M5", "$#1 M3", "$-1 M5", "$0", "$ABS[-1] M3", "M3 $1", "G0 X1"}) {
    EXPECT_TRUE(ParsedLine(line).good) << line;
    EXPECT_FALSE(grbl_command_in(line)) << line;
  }
}

}  // namespace
}  // namespace passo
