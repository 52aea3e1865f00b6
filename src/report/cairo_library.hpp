// The functions of cairo that are used, loaded with the first picture made of pixels (decision 0120). Private to
// report/.
#pragma once

#include <cairo.h>

#include "passo/base/late_library.hpp"

namespace passo {

struct CairoLibrary {
  LateLibrary library{PASSO_CAIRO_NAME};
  PASSO_FUNCTION(cairo_image_surface_create);
  PASSO_FUNCTION(cairo_image_surface_create_for_data);
  PASSO_FUNCTION(cairo_surface_set_device_scale);
  PASSO_FUNCTION(cairo_surface_write_to_png_stream);
  PASSO_FUNCTION(cairo_surface_finish);
  PASSO_FUNCTION(cairo_surface_destroy);
  PASSO_FUNCTION(cairo_create);
  PASSO_FUNCTION(cairo_destroy);
  PASSO_FUNCTION(cairo_status);
  PASSO_FUNCTION(cairo_status_to_string);
  PASSO_FUNCTION(cairo_save);
  PASSO_FUNCTION(cairo_restore);
  PASSO_FUNCTION(cairo_translate);
  PASSO_FUNCTION(cairo_scale);
  PASSO_FUNCTION(cairo_clip);
  PASSO_FUNCTION(cairo_new_path);
  PASSO_FUNCTION(cairo_new_sub_path);
  PASSO_FUNCTION(cairo_move_to);
  PASSO_FUNCTION(cairo_line_to);
  PASSO_FUNCTION(cairo_arc);
  PASSO_FUNCTION(cairo_rectangle);
  PASSO_FUNCTION(cairo_close_path);
  PASSO_FUNCTION(cairo_set_line_cap);
  PASSO_FUNCTION(cairo_set_line_join);
  PASSO_FUNCTION(cairo_set_line_width);
  PASSO_FUNCTION(cairo_set_dash);
  PASSO_FUNCTION(cairo_set_fill_rule);
  PASSO_FUNCTION(cairo_set_source);
  PASSO_FUNCTION(cairo_set_source_rgb);
  PASSO_FUNCTION(cairo_set_source_rgba);
  PASSO_FUNCTION(cairo_set_source_surface);
  PASSO_FUNCTION(cairo_get_source);
  PASSO_FUNCTION(cairo_pattern_create_linear);
  PASSO_FUNCTION(cairo_pattern_add_color_stop_rgb);
  PASSO_FUNCTION(cairo_pattern_set_filter);
  PASSO_FUNCTION(cairo_pattern_destroy);
  PASSO_FUNCTION(cairo_stroke);
  PASSO_FUNCTION(cairo_fill);
  PASSO_FUNCTION(cairo_paint);
  PASSO_FUNCTION(cairo_font_options_create);
  PASSO_FUNCTION(cairo_font_options_set_antialias);
  PASSO_FUNCTION(cairo_font_options_set_hint_style);
  PASSO_FUNCTION(cairo_font_options_set_hint_metrics);
  PASSO_FUNCTION(cairo_font_options_destroy);
  PASSO_FUNCTION(cairo_set_font_options);
  PASSO_FUNCTION(cairo_select_font_face);
  PASSO_FUNCTION(cairo_set_font_size);
  PASSO_FUNCTION(cairo_text_extents);
  PASSO_FUNCTION(cairo_show_text);
};

}  // namespace passo
