// The programs that passo cam job writes, beside those of an earlier run.
#include "kit/command_line.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using passo::test::on_router;
using passo::test::Outcome;
using passo::test::read;
using testing::HasSubstr;
using testing::Not;

class CamJobPrograms : public passo::test::CommandLine {
 protected:
  // Two pockets in a plate of 60 x 50 mm: T1 cuts the one on the left, T2 the one on the right. `words`: lines of
  // [job].
  std::string two_tools(const std::string& words, const std::string& more = "") {
    write("two.svg",
          "<svg xmlns='http://www.w3.org/2000/svg' xmlns:inkscape='http://www.inkscape.org/namespaces/inkscape' "
          "width='60mm' height='50mm' viewBox='0 0 60 50'>\n"
          "<g inkscape:groupmode='layer' inkscape:label='left'><rect x='10' y='10' width='10' height='30'/></g>\n"
          "<g inkscape:groupmode='layer' inkscape:label='right'><rect x='40' y='10' width='10' height='30'/></g>\n"
          "</svg>\n");
    return write("two.toml", "[job]\ndrawing = \"two.svg\"\n" + words +
                                 "\n[stock]\nsize = [60, 50]\nthickness = 4\n"
                                 "[tool.1]\nshape = \"flat\"\ndiameter_mm = 3\nfeed_mm_min = 600\nplunge_mm_min = 200\n"
                                 "[tool.2]\nshape = \"flat\"\ndiameter_mm = 6\nfeed_mm_min = 600\nplunge_mm_min = 200\n"
                                 "[[operation]]\nkind = \"pocket\"\ntool = 1\nlayer = \"left\"\ndepth = -2\n"
                                 "[[operation]]\nkind = \"pocket\"\ntool = 2\nlayer = \"right\"\ndepth = -2\n" +
                                 more);
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(path(name)); }
};

const std::string each_tool = "programs = \"each-tool\"";

TEST_F(CamJobPrograms, of_one_tool_name_it_and_change_nothing) {
  ASSERT_EQ(passo("cam job " + two_tools(each_tool)).code, 0);
  const std::string first = read(path("two-1-T1.ngc"));
  const std::string second = read(path("two-2-T2.ngc"));
  for (const std::string& program : {first, second}) EXPECT_THAT(program, Not(HasSubstr("M6")));
  EXPECT_THAT(first, HasSubstr("(tool 1: flat end, 3 mm)\n"));
  EXPECT_THAT(first, HasSubstr("(MSG, tool 1: flat end, 3 mm)\n"));
  EXPECT_THAT(second, HasSubstr("(MSG, tool 2: flat end, 6 mm)\n"));
  EXPECT_THAT(second, testing::ContainsRegex("M3 S[0-9]+\n"));
  EXPECT_THAT(passo("check " + path("two-2-T2.ngc") + on_router).err, Not(HasSubstr("warning")));
  // The simulation knows the tool by its comment.
  const Outcome cut = passo("simulate " + path("two-2-T2.ngc") + " --tool 1=flat:3 --tool 2=flat:6");
  EXPECT_EQ(cut.code, 0) << cut.err;
  EXPECT_THAT(cut.out, HasSubstr("T2 flat end, 6 mm"));
}

TEST_F(CamJobPrograms, for_grbl_change_their_tool_by_hand_and_the_simulation_sees_it) {
  ASSERT_EQ(passo("cam job " + two_tools("for = \"grbl\"")).code, 0);
  EXPECT_THAT(read(path("two.ngc")), HasSubstr("T2\nM0\n"));
  for (const std::string dialect : {"", " --dialect grbl"}) {
    const Outcome cut = passo("simulate " + path("two.ngc") + " --tool 1=flat:3 --tool 2=flat:6" + dialect);
    EXPECT_EQ(cut.code, 0) << cut.err;
    EXPECT_THAT(cut.out, HasSubstr("T1 flat end, 3 mm"));
    EXPECT_THAT(cut.out, HasSubstr("T2 flat end, 6 mm"));
    const Outcome checked = passo("check " + path("two.ngc") + on_router + dialect);
    EXPECT_EQ(checked.code, 0) << checked.err;
    EXPECT_EQ(checked.err, "");
    EXPECT_THAT(checked.out, HasSubstr("tool 2 by hand (M0)"));
  }
}

TEST_F(CamJobPrograms, for_grblhal_are_simulated_in_their_dialect) {
  ASSERT_EQ(passo("cam job " + two_tools("for = \"grblhal\"")).code, 0);
  const Outcome cut = passo("simulate " + path("two.ngc") + " --tool 1=flat:3 --tool 2=flat:6 --dialect grblhal");
  EXPECT_EQ(cut.code, 0) << cut.err;
  EXPECT_THAT(cut.out, HasSubstr("T2 flat end, 6 mm"));
  EXPECT_EQ(passo("check " + path("two.ngc") + on_router + " --dialect grblhal").code, 0);
  const Outcome other = passo("simulate " + path("two.ngc") + " --dialect mach3");
  EXPECT_EQ(other.code, 2);
  EXPECT_THAT(other.err, HasSubstr("expected linuxcnc, grbl or grblhal"));
}

TEST_F(CamJobPrograms, of_an_earlier_run_are_removed_if_the_job_does_not_make_them_any_more) {
  ASSERT_EQ(passo("cam job " + two_tools(each_tool)).code, 0);
  write("two-3-T9.ngc", "(somebody else's)\n");
  const Outcome one = passo("cam job " + two_tools(""));
  ASSERT_EQ(one.code, 0) << one.err;
  EXPECT_THAT(one.out, HasSubstr("changed: programs two-1-T1.ngc, two-2-T2.ngc -> two.ngc\n"));
  EXPECT_THAT(one.out, HasSubstr("removed: " + path("two-1-T1.ngc") + ", which the job does not make any more\n"));
  EXPECT_FALSE(exists("two-1-T1.ngc") || exists("two-2-T2.ngc"));
  EXPECT_TRUE(exists("two.ngc") && exists("two-3-T9.ngc"));
}

TEST_F(CamJobPrograms, stay_if_they_were_edited) {
  ASSERT_EQ(passo("cam job " + two_tools(each_tool)).code, 0);
  write("two-2-T2.ngc", "(by hand)\n");
  const Outcome one = passo("cam job " + two_tools(""));
  ASSERT_EQ(one.code, 0) << one.err;
  EXPECT_THAT(one.err, HasSubstr("two-2-T2.ngc: warning: the job does not make this program any more; it was edited"));
  EXPECT_EQ(read(path("two-2-T2.ngc")), "(by hand)\n");
  EXPECT_FALSE(exists("two-1-T1.ngc"));
}

TEST_F(CamJobPrograms, that_were_edited_are_overwritten_only_by_force) {
  const std::string job = two_tools("");
  ASSERT_EQ(passo("cam job " + job).code, 0);
  const std::string made = read(path("two.ngc"));
  write("two.ngc", made + "(by hand)\n");
  const Outcome refused = passo("cam job " + job);
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, HasSubstr("two.ngc: error: it was edited after the job had written it [job.edited]"));
  EXPECT_THAT(refused.err, HasSubstr("--force"));
  EXPECT_EQ(read(path("two.ngc")), made + "(by hand)\n");
  const Outcome forced = passo("cam job " + job + " --force");
  EXPECT_EQ(forced.code, 0) << forced.err;
  EXPECT_THAT(forced.err, HasSubstr("it was edited, and is overwritten [job.edited]"));
  EXPECT_EQ(read(path("two.ngc")), made);
}

TEST_F(CamJobPrograms, of_sheets_are_kept_and_removed_in_the_same_way) {
  const auto nested = [this](const std::string& words, const char* copies) {
    return two_tools(words, std::string("[nest]\nquantity = ") + copies + "\n");
  };
  ASSERT_EQ(passo("cam job " + nested("", "12")).code, 0);
  const std::string made = read(path("two-2.ngc"));
  write("two-2.ngc", made + "(by hand)\n");
  const Outcome refused = passo("cam job " + nested("", "12"));
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, HasSubstr("two-2.ngc: error: it was edited after the job had written it [job.edited]"));
  write("two-2.ngc", made);
  ASSERT_EQ(passo("cam job " + nested(each_tool, "12")).code, 0);
  EXPECT_FALSE(exists("two-1.ngc") || exists("two-2.ngc"));
  EXPECT_TRUE(exists("two-2-1-T1.ngc"));
  ASSERT_EQ(passo("cam job " + nested("", "1")).code, 0);
  EXPECT_FALSE(exists("two-1-1-T1.ngc") || exists("two-2-1-T1.ngc"));
  EXPECT_TRUE(exists("two.ngc"));
}

TEST_F(CamJobPrograms, changed_in_order_or_controller_are_reported) {
  ASSERT_EQ(passo("cam job " + two_tools("")).code, 0);
  EXPECT_THAT(passo("cam job " + two_tools("for = \"linuxcnc\"")).out,
              HasSubstr("changed: controller passo -> linuxcnc\n"));
  EXPECT_THAT(passo("cam job " + two_tools("for = \"linuxcnc\" # a comment")).out,
              HasSubstr("changed: nothing since the last run\n"));
}

TEST_F(CamJobPrograms, a_record_cannot_have_other_files_removed) {
  const std::string job = two_tools("");
  ASSERT_EQ(passo("cam job " + job).code, 0);
  auto record = nlohmann::ordered_json::parse(read(path("two.job.json")));
  write("notes.txt", read(path("two.ngc")));
  record["programs"].push_back({{"file", "notes.txt"}, {"fingerprint", record["programs"][0]["fingerprint"]}});
  record["programs"].push_back({{"file", "two.svg"}, {"fingerprint", record["programs"][0]["fingerprint"]}});
  write("two.job.json", record.dump());
  ASSERT_EQ(passo("cam job " + job).code, 0);
  EXPECT_TRUE(exists("notes.txt") && exists("two.svg"));
}

}  // namespace
