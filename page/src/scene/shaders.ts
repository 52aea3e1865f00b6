// The scene's shaders. A line is a quad of as many pixels as it is wide: WebGL's own lines have one pixel, which nobody
// sees on a 4K screen. All lines are one draw of six vertices each, and no instances: a processor that draws takes as
// long for an instance as for thousand vertices.

// What both kinds of lines share: from the two ends to a corner of the quad. `corner.x` is 0 or 1 along the line,
// `corner.y` -1 or 1 across it.
const quad = `
const vec2 corners[6] = vec2[6](vec2(0, -1), vec2(1, -1), vec2(0, 1), vec2(0, 1), vec2(1, -1), vec2(1, 1));
uniform mat4 camera;
uniform vec2 window; // device pixels
uniform float soft;  // over so many device pixels a line's edge fades; 0: the samples of each pixel do that
out float along;     // device pixels from the line's start
out vec2 across;     // device pixels: from its middle, and from its middle to its edge
vec4 cornerOf(vec3 from, vec3 to, vec2 corner, float width) {
  vec4 a = camera * vec4(from, 1.0);
  vec4 b = camera * vec4(to, 1.0);
  vec2 way = (b.xy - a.xy) * window * 0.5;
  float far = length(way);
  vec2 ahead = far > 1e-4 ? way / far : vec2(1.0, 0.0);
  vec2 aside = vec2(-ahead.y, ahead.x) * corner.y + ahead * (corner.x * 2.0 - 1.0) * 0.5;
  vec4 place = corner.x < 0.5 ? a : b;
  place.xy += aside * (width + soft) / window;
  along = corner.x * far;
  across = vec2(corner.y, 1.0) * (width + soft) * 0.5;
  return place;
}`;

const edge = `
uniform float soft;
in vec2 across;
float shareOfLine() { return clamp((across.y - abs(across.x)) / max(soft, 1e-3), 0.0, 1.0); }`;

export const pointsARow = 1024; // of the texture

export const pathVertex = `#version 300 es
precision highp float;
precision highp int;
precision highp usampler2D;
uniform usampler2D points;  // three coordinates and flags, 0 to 65535
uniform vec3 origin;
uniform vec3 stepLength;
uniform int done;     // so many motions of this chunk are done
uniform vec3 cutColour;
uniform vec3 rapidColour;
uniform vec3 pastColour;
uniform float thickness;
uniform float showsRapids;
uniform int tells;        // what the colour of a cut tells: 0 nothing, 1 its speed, 2 its depth, 3 its torque
uniform vec2 range;       // of that: its value for the low and for the high colour
uniform vec3 lowColour;
uniform vec3 highColour;
out vec3 colour;
out float isRapid;
out float height;         // mm
${quad}
vec4 pointAt(int i) { return vec4(texelFetch(points, ivec2(i % ${pointsARow}, i / ${pointsARow}), 0)); }
void main() {
  int motion = gl_VertexID / 6;
  vec2 corner = corners[gl_VertexID % 6];
  vec4 start = pointAt(motion);
  vec4 end = pointAt(motion + 1);
  isRapid = mod(end.w, 2.0);
  bool past = motion < done;
  height = origin.z + stepLength.z * (corner.x < 0.5 ? start.z : end.z);
  float told = tells == 1 ? floor(end.w / 256.0) : tells == 3 ? floor(mod(end.w, 256.0) / 2.0) - 1.0 : height;
  float share = clamp((told - range.x) / max(range.y - range.x, 1e-6), 0.0, 1.0);
  vec3 ownColour = tells == 0 ? cutColour : mix(lowColour, highColour, share);
  colour = isRapid > 0.5 ? rapidColour : past ? pastColour : ownColour;
  float width = isRapid > 0.5 ? thickness * 0.7 * showsRapids : thickness;
  gl_Position = cornerOf(origin + stepLength * start.xyz, origin + stepLength * end.xyz, corner, width);
  if (isRapid > 0.5) gl_Position.z += 0.0005;
  if (isRapid > 0.5 && showsRapids < 0.5) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}`;

export const pathFragment = `#version 300 es
precision highp float;
in vec3 colour;
in float isRapid;
in float height;
in float along;
uniform float dash;
uniform float section;  // mm: nothing above it is drawn
out vec4 result;
${edge}
void main() {
  if (height > section) discard;
  if (isRapid > 0.5 && mod(along, dash) > dash * 0.55) discard;
  result = vec4(colour, shareOfLine());
}`;

// Lines of the scene's furniture: the grid, the travel, the zero, a line that was picked.
export const lineVertex = `#version 300 es
precision highp float;
precision highp int;
layout(location = 0) in vec3 start;
layout(location = 1) in vec3 end;
layout(location = 2) in vec4 tint;  // colour, thickness
uniform float density;
out vec3 colour;
${quad}
void main() {
  colour = tint.rgb;
  gl_Position = cornerOf(start, end, corners[gl_VertexID % 6], tint.a * density);
}`;

export const lineFragment = `#version 300 es
precision highp float;
in vec3 colour;
out vec4 result;
${edge}
void main() {
  result = vec4(colour, shareOfLine());
}`;

// The tool: a cone that stands on its tip.
export const toolVertex = `#version 300 es
precision highp float;
layout(location = 0) in vec3 corner;
layout(location = 1) in vec3 normal;
uniform mat4 camera;
uniform vec3 tip;
uniform float size;
uniform vec3 light;
out float shade;
void main() {
  shade = 0.55 + 0.45 * max(dot(normal, light), 0.0);
  gl_Position = camera * vec4(tip + corner * size, 1.0);
  gl_Position.z -= 0.001;
}`;

export const toolFragment = `#version 300 es
precision highp float;
in float shade;
uniform vec3 toolColour;
out vec4 result;
void main() {
  result = vec4(toolColour * shade, 1.0);
}`;

// The stock: each strip has the rows before and after it, and two vertices a column; its first and last vertex stand
// there twice, so that all strips are one. The first and the last column and row stand at the bottom: they make the walls.
export const stockVertex = `#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
uniform mat4 camera;
uniform vec3 low;
uniform vec3 high;
uniform float cell;
uniform int columns;
uniform int rows;
uniform sampler2D heights;  // below the top, mm
out vec3 place;
void main() {
  int strip = 2 * (columns + 2);
  int corner = clamp(gl_VertexID % (strip + 2) - 1, 0, strip - 1);
  ivec2 at = ivec2(corner / 2 - 1, gl_VertexID / (strip + 2) + (corner & 1) - 1);
  ivec2 inside = clamp(at, ivec2(0), ivec2(columns - 1, rows - 1));
  float height = at == inside ? high.z + texelFetch(heights, inside, 0).r : low.z;
  place = vec3(min(low.xy + (vec2(inside) + 0.5) * cell, high.xy), height);
  gl_Position = camera * vec4(place, 1.0);
  gl_Position.z += 0.0008;  // the path on a floor is seen
}`;

export const stockFragment = `#version 300 es
precision highp float;
in vec3 place;
uniform vec3 low;
uniform vec3 high;
uniform vec3 light;
uniform vec3 stockColour;
uniform vec3 cutColour;
uniform float section;
out vec4 result;
void main() {
  if (place.z > section) discard;
  vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
  float depth = clamp((high.z - place.z) / max(high.z - low.z, 1e-6), 0.0, 1.0);
  vec3 colour = place.z > high.z - 1e-3 ? stockColour : mix(stockColour, cutColour, 0.45 + 0.4 * depth);
  result = vec4(colour * (0.45 + 0.55 * abs(dot(normal, light))), 1.0);
}`;
