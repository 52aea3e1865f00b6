// Orders of CAM operations and of probing cycles: what docs/api/openapi.json says of them, and what is refused before
// anything begins.
#include "../cam_schema.hpp"

#include <fstream>

#include "kit/golden.hpp"
#include <gtest/gtest.h>

#include "passo/operations/study_arguments.hpp"
#include "passo/probing/probing_cycle.hpp"

namespace passo {
namespace {

// "CamDrill".
std::string schema_name(const CamOperation& operation) {
  std::string name = operation.name;
  name.front() = static_cast<char>(name.front() - 'a' + 'A');
  return "Cam" + name;
}

constexpr const char* description = "docs/api/openapi.json";

Json described() {
  std::ifstream file(std::string(PASSO_SOURCE_DIR "/") + description);
  return Json::parse(file);
}

TEST(CamSchemas, are_those_of_the_description) {
  Json document = described();
  Json jobs = Json::array();
  Json options = Json::array();
  for (const CamOperation& operation : cam_operations()) {
    document["components"]["schemas"][schema_name(operation)] = schema_of(operation);
    jobs.push_back(operation.name);
    options.push_back({{"$ref", "#/components/schemas/" + schema_name(operation)}});
  }
  Json& properties =
      document["paths"]["/cam"]["post"]["requestBody"]["content"]["application/json"]["schema"]["properties"];
  properties["job"]["enum"] = jobs;
  properties["options"]["anyOf"] = options;
  test::expect_golden(description, document.dump(1) + "\n");
}

TEST(StudySchema, is_that_of_the_description) {
  Json document = described();
  const Json tune = schema_of(tune_study());
  document["components"]["schemas"]["TuneStudy"] = tune;
  Json& order = document["paths"]["/study"]["post"]["requestBody"]["content"]["application/json"]["schema"];
  for (const auto& [name, option] : tune["properties"].items()) order["properties"][name] = option;
  test::expect_golden(description, document.dump(1) + "\n");
}

TEST(ProbingSchema, is_that_of_the_description) {
  Json document = described();
  Json& numbers = document["components"]["schemas"]["ProbingNumbers"];
  numbers = {{"type", "object"},
             {"description", "The numbers of probing cycles. x-cycles: the cycles that know one"},
             {"properties", Json::object()}};
  ProbingCycle usual;
  for (const ProbingField& field : probing_fields()) {
    Json& one = numbers["properties"][std::string(field.name)];
    one = {{"type", field.is_whole ? "integer" : "number"},
           {"minimum", field.low},
           {"maximum", field.high},
           {"default", field.value(usual)},
           {"description", std::string(field.words)}};
    for (const ProbingKind kind : all_probing_kinds()) {
      if (field.is_of(kind)) one["x-cycles"].push_back(std::string(name_of(kind)));
    }
  }
  Json& body = document["paths"]["/probe"]["post"]["requestBody"]["content"]["application/json"]["schema"];
  body["properties"]["cycle"]["enum"] = Json::array();
  for (const ProbingKind kind : all_probing_kinds()) {
    body["properties"]["cycle"]["enum"].push_back(std::string(name_of(kind)));
  }
  body["allOf"] = Json::array({{{"$ref", "#/components/schemas/ProbingNumbers"}}});
  test::expect_golden(description, document.dump(1) + "\n");
}

TEST(CamSchemas, say_what_an_option_may_be) {
  const Json outline = schema_of(*find_cam_operation("outline"));
  const Json& all = outline["properties"];
  EXPECT_EQ(all["tool"]["type"], Json({"string", "number"}));
  EXPECT_EQ(all["tool"]["default"], "2mm");
  EXPECT_EQ(all["tabs"]["default"], 4);
  EXPECT_EQ(all["tabs"]["maximum"], 1000.0);
  EXPECT_EQ(all["mirror"]["enum"], Json({"x", "y"}));
  EXPECT_FALSE(all["mirror"].contains("default"));
  EXPECT_EQ(all["zero"]["examples"], Json({"file", "lower-left"})) << "or X,Y";
  EXPECT_EQ(all["dog-bones"]["type"], "boolean");
  EXPECT_EQ(all["layer"]["items"]["type"], "string");
  EXPECT_FALSE(all.contains("output")) << "a file of this computer";
  EXPECT_FALSE(all.contains("EDGE")) << "its files have a member of their own";
  EXPECT_EQ(schema_of(*find_cam_operation("relief"))["properties"]["width"]["default"], "100mm");
  EXPECT_FALSE(schema_of(*find_cam_operation("engrave"))["properties"]["font"].contains("default"));
}

class CamOrders : public testing::Test {
 protected:
  // The words of the command line, or why there are none.
  std::string said(const char* operation, const std::string& name, const char* json) {
    const std::vector<CamOption> options = find_cam_operation(operation)->options();
    const CamOption* const option = find_ordered(options, name);
    if (option == nullptr) return "unknown";
    const auto values = ordered_values(*option, Json::parse(json), {"edge.gbr"});
    if (!values) return values.error();
    std::string text;
    for (const std::string& value : *values) text += "<" + value + ">";
    return text;
  }
};

TEST_F(CamOrders, become_words_of_the_command_line) {
  EXPECT_EQ(said("outline", "depth", "-1.5"), "<-1.5>");
  EXPECT_EQ(said("outline", "depth", R"("-30mil")"), "<-30mil>");
  EXPECT_EQ(said("outline", "tool", R"("1/8in")"), "<1/8in>");
  EXPECT_EQ(said("outline", "dog-bones", "true"), "<>");
  EXPECT_EQ(said("outline", "dog-bones", "false"), "");
  EXPECT_EQ(said("outline", "tab", R"(["1,2", "3,4"])"), "<1,2><3,4>");
  EXPECT_EQ(said("outline", "tool", R"("")"), "") << "nothing is said";
  EXPECT_EQ(said("isolate", "edge", R"("edge.gbr")"), "<edge.gbr>");
  EXPECT_EQ(said("engrave", "font", R"("simplex")"), "<simplex>");
  EXPECT_EQ(said("engrave", "font", R"("DejaVu Sans:bold")"), "<DejaVu Sans:bold>");
  EXPECT_EQ(said("outline", "ramp", R"("99")"), "<99>") << "the operation judges it";
}

TEST_F(CamOrders, that_cannot_be_are_refused) {
  EXPECT_EQ(said("outline", "output", R"("x")"), "unknown");
  EXPECT_EQ(said("outline", "EDGE", R"("x")"), "unknown");
  EXPECT_EQ(said("outline", "passes", "1"), "unknown") << "an option of another operation";
  EXPECT_EQ(said("outline", "ramp", "99"), "\"ramp\": expected a number from 0 to 60");
  EXPECT_EQ(said("outline", "mirror", R"("z")"), "\"mirror\": expected one of x, y");
  EXPECT_EQ(said("outline", "mirror", "1"), "\"mirror\": expected one of x, y");
  EXPECT_EQ(said("outline", "dog-bones", R"("yes")"), "\"dog-bones\": expected true or false");
  EXPECT_EQ(said("outline", "tool", "true"), "\"tool\": expected a text or a number");
  EXPECT_EQ(said("outline", "tool", R"(["1", "2"])"), "\"tool\": expected a text or a number");
  EXPECT_EQ(said("outline", "tab", R"([true])"), "\"tab\": expected a text, or a list of texts");
  EXPECT_EQ(said("isolate", "edge", R"("other.gbr")"), "\"edge\": expected a file that was sent");
  EXPECT_EQ(said("engrave", "font", R"("/usr/a.ttf")"),
            "\"font\": expected a file that was sent, or simplex, an installed font");
  EXPECT_EQ(said("engrave", "font", R"("a.ttf")"),
            "\"font\": expected a file that was sent, or simplex, an installed font");
  for (const char* value : {R"("../x")", R"("a/b")", R"("a\nb")", R"("a\\b")"}) {
    EXPECT_EQ(said("engrave", "text", value), "\"text\": expected a text or a number") << value;
  }
}

}  // namespace
}  // namespace passo
