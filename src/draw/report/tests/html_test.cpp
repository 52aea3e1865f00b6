#include "passo/report/html.hpp"

#include "motion.hpp"

#include "passo/report/picture.hpp"

namespace passo {
namespace {

TEST(Html, text_cannot_break_out_of_its_place) {
  EXPECT_EQ(html_text("<script>alert('x')</script> & \"y\""),
            "&lt;script&gt;alert(&#39;x&#39;)&lt;/script&gt; &amp; &quot;y&quot;");
  EXPECT_EQ(html_text("\u00B5m, \u65E5"), "\u00B5m, \u65E5");
  EXPECT_EQ(html_text(std::string("a\0b\x1b[31m\xff\xc3", 10)), "a\uFFFDb\uFFFD[31m\uFFFD\uFFFD");
}

TEST(Html, a_picture_has_ids_of_its_own) {
  const std::string svg = inline_svg(
      "<?xml version=\"1.0\"?>\n<svg width=\"5\"><g id=\"g1\"/><use xlink:href=\"#g1\"/><g "
      "clip-path=\"url(#g1)\"/></svg>",
      "top", "a \"view\"");
  EXPECT_EQ(
      svg,
      "<svg role=\"img\" aria-label=\"a &quot;view&quot;\" width=\"5\"><g id=\"top-g1\"/><use xlink:href=\"#top-g1\"/>"
      "<g clip-path=\"url(#top-g1)\"/></svg>");
  EXPECT_EQ(inline_svg("no picture", "top", ""), "");
}

TEST(Html, a_png_is_in_the_page_as_base64) {
  EXPECT_EQ(inline_png("f", ""), "<img alt=\"\" src=\"data:image/png;base64,Zg==\">\n");
  EXPECT_EQ(inline_png("fo", ""), "<img alt=\"\" src=\"data:image/png;base64,Zm8=\">\n");
  EXPECT_EQ(inline_png("foo\xff", "<"), "<img alt=\"&lt;\" src=\"data:image/png;base64,Zm9v/w==\">\n");
}

TEST(Html, the_views_of_a_path_are_drawn_into_a_text) {
  PathRecorder path;
  for (const PictureView view : {PictureView::isometric, PictureView::flat}) {
    std::string svg;
    OutputFile file = OutputFile::into(svg);
    PictureOptions options;
    options.width = 500;
    options.height = 400;
    ASSERT_TRUE(draw_view(path, view, options, file));
    ASSERT_TRUE(file.commit());
    EXPECT_EQ(file.size(), svg.size());
    EXPECT_NE(inline_svg(svg, "a", "view").find("<svg role"), std::string::npos);
  }
}

}  // namespace
}  // namespace passo
