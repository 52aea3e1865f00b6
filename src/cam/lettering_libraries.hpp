// The functions of FreeType and HarfBuzz that are used, loaded with the first text in an outline font (decision 0120).
// Private to cam/.
#pragma once

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H
#include FT_TRUETYPE_TABLES_H
#include <harfbuzz/hb.h>

#include "passo/base/late_library.hpp"

namespace passo {

struct FreeTypeLibrary {
  LateLibrary library{PASSO_FREETYPE_NAME};
  PASSO_FUNCTION(FT_Init_FreeType);
  PASSO_FUNCTION(FT_Done_FreeType);
  PASSO_FUNCTION(FT_New_Memory_Face);
  PASSO_FUNCTION(FT_Done_Face);
  PASSO_FUNCTION(FT_Get_Sfnt_Table);
  PASSO_FUNCTION(FT_Get_Char_Index);
  PASSO_FUNCTION(FT_Load_Glyph);
  PASSO_FUNCTION(FT_Outline_Decompose);
};

struct HarfBuzzLibrary {
  LateLibrary library{PASSO_HARFBUZZ_NAME};
  PASSO_FUNCTION(hb_blob_create);
  PASSO_FUNCTION(hb_blob_destroy);
  PASSO_FUNCTION(hb_face_create);
  PASSO_FUNCTION(hb_face_destroy);
  PASSO_FUNCTION(hb_font_create);
  PASSO_FUNCTION(hb_font_destroy);
  PASSO_FUNCTION(hb_font_set_scale);
  PASSO_FUNCTION(hb_buffer_create);
  PASSO_FUNCTION(hb_buffer_destroy);
  PASSO_FUNCTION(hb_buffer_add_utf8);
  PASSO_FUNCTION(hb_buffer_guess_segment_properties);
  PASSO_FUNCTION(hb_buffer_get_glyph_infos);
  PASSO_FUNCTION(hb_buffer_get_glyph_positions);
  PASSO_FUNCTION(hb_shape);
};

}  // namespace passo
