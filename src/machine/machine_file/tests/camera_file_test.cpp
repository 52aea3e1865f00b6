#include "machine_text.hpp"

#include "passo/machine_file/camera_description.hpp"

namespace passo {
namespace {

Diagnostics findings_of(const std::string& camera) {
  Diagnostics diagnostics;
  static_cast<void>(parse_machine(sound_machine + camera, "m.toml", diagnostics));
  return diagnostics;
}
std::string first_camera_code(const std::string& camera) {
  const Diagnostics diagnostics = findings_of(camera);
  return diagnostics.all().empty() ? "" : diagnostics.all()[0].code;
}

TEST(CameraFile, gives_the_addresses_the_offset_and_how_the_picture_is_turned) {
  const std::string text = sound_machine + R"([camera]
url = "http://cam.local:8080/stream"
snapshot = "http://cam.local:8080/snapshot"
offset_mm = [42.5, -3.25]
rotation_deg = 180
mirrored = true
)";
  Diagnostics diagnostics;
  ASSERT_TRUE(parse_machine(text, "m.toml", diagnostics)) << render(diagnostics, false);
  for (const std::string& each : {text, "\xEF\xBB\xBF" + text}) {
    const auto camera = parse_camera(each);
    ASSERT_TRUE(camera);
    EXPECT_EQ(camera->stream.host_and_port(), "cam.local:8080");
    EXPECT_EQ(camera->stream.target, "/stream");
    ASSERT_TRUE(camera->snapshot);
    EXPECT_EQ(camera->snapshot->target, "/snapshot");
    EXPECT_EQ(camera->offset_x, Mm(42.5));
    EXPECT_EQ(camera->offset_y, Mm(-3.25));
    EXPECT_EQ(camera->rotation, 180);
    EXPECT_TRUE(camera->is_mirrored);
  }
}

TEST(CameraFile, needs_no_more_than_the_address) {
  const auto camera = parse_camera(sound_machine + "[camera]\nurl = \"http://10.0.0.7\"\n");
  ASSERT_TRUE(camera);
  EXPECT_FALSE(camera->snapshot);
  EXPECT_EQ(camera->offset_x, Mm(0));
  EXPECT_EQ(camera->rotation, 0);
  EXPECT_FALSE(parse_camera(sound_machine));
  EXPECT_FALSE(parse_camera(""));
}

TEST(CameraFile, is_refused_with_the_place_of_the_mistake) {
  const std::string good = "[camera]\nurl = \"http://cam/\"\n";
  EXPECT_EQ(first_camera_code(good), "");
  EXPECT_EQ(first_camera_code("[camera]\n"), "machine.missing-key");
  EXPECT_EQ(first_camera_code("[camera]\nurl = 5\n"), "machine.wrong-type");
  EXPECT_EQ(first_camera_code(good + "rotation_deg = 45\n"), "machine.camera");
  EXPECT_EQ(first_camera_code(good + "rotation_deg = 360\n"), "machine.out-of-range");
  EXPECT_EQ(first_camera_code(good + "mirrored = 1\n"), "machine.wrong-type");
  EXPECT_EQ(first_camera_code(good + "offset_mm = 5\n"), "machine.wrong-type");
  EXPECT_EQ(first_camera_code(good + "offset_mm = [5000, 0]\n"), "machine.out-of-range");
  EXPECT_EQ(first_camera_code(good + "snapshot = \"cam/still\"\n"), "machine.camera");
  EXPECT_EQ(first_camera_code(good + "zoom = 2\n"), "machine.unknown-key");
  const Diagnostics secure = findings_of("[camera]\nurl = \"https://cam/\"\n");
  ASSERT_EQ(secure.all().size(), 1U);
  EXPECT_EQ(secure.all()[0].code, "machine.camera");
  EXPECT_EQ(secure.all()[0].message, "camera.url is not a plain http address");
  EXPECT_EQ(secure.all()[0].text.substr(secure.all()[0].place.column - 1, 4), "\"htt");
  EXPECT_FALSE(parse_camera(sound_machine + "[camera]\nurl = \"https://cam/\"\n"));
}

}  // namespace
}  // namespace passo
