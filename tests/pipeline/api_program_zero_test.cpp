// Where the zero of a program lies for the part that is executed, as the web interface shows positions.
#include <map>

#include "pipeline/api_kit.hpp"

namespace passo {
namespace {

using test::ApiRun;
using test::Json;

TEST(ApiProgramZero, follows_the_offsets_of_the_program_as_the_machine_executes_it) {
  ApiRun run;
  run.own();
  EXPECT_TRUE(run.get("/status")["program_zero"].is_null());
  run.post(fmt::format("/programs/{}/run", run.upload("G21 G90 F600\n"
                                                      "G10 L2 P2 X10 Z-1\n"
                                                      "G1 X2\n"
                                                      "G55\n"
                                                      "G1 X-5\n"
                                                      "G43.1 Z3\n"
                                                      "G1 X-4 Z2\n"
                                                      "G92 X1\n"
                                                      "G1 X2\n"
                                                      "G92.1 G49 G54 G1 X1 Z0\n"
                                                      "M2\n")));
  ASSERT_EQ(run.status, 202U);
  std::map<int, std::pair<double, double>> zeros;  // X and Z, for each line
  ASSERT_TRUE(run.turn_until([&] {
    const Json status = run.get("/status");
    const Json zero = status["program_zero"];
    if (zero.is_object()) zeros[status["line"]] = {zero["x"], zero["z"]};
    return status["job"]["state"] == "done";
  }));
  const std::map<int, std::pair<double, double>> expected = {
      {3, {0, 0}}, {5, {10, -1}}, {7, {10, 2}}, {9, {5, 2}}, {10, {0, 0}}};
  EXPECT_EQ(zeros, expected);
  EXPECT_TRUE(run.get("/status")["program_zero"].is_null()) << "no program runs";
}

}  // namespace
}  // namespace passo
